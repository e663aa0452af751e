// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The place that is explained, of a result.
#pragma once

#include <string>
#include <vector>

#include "io/result/named_parts.h"
#include "io/result/reader.h"
#include "solver/explain/attribution.h"

namespace sunload {

/// Facades and objects by their area, or sensors alike. Throws InputError where nothing or things
/// of two kinds are named, or nothing of it receives light.
Place place_named(const ResultReader& result, const NamedParts& parts);
/// The names, one after the other.
std::string words_of(const NamedParts& parts);
/// "388.22 m2" or "3 sensors".
std::string extent_of(const ResultReader& result, const Place& place);
/// What to tell of a place that is not the same in two results: areas, sensors that stand
/// elsewhere, a scene that is turned.
std::vector<std::string> notes_on_places(const ResultReader& base, const ResultReader& variant,
                                         const NamedParts& parts);
/// Mean over the place of one row of values per receiver.
double mean_over(const Place& place, const std::vector<double>& values);

}  // namespace sunload
