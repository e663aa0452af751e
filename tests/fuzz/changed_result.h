// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Results whose values somebody has changed: what can be wrong in a file that HDF5 reads.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/result_change.h"

namespace sunload::fuzz {

/// A result as `run` makes it, of a study that has everything in it: broadband with errors of
/// every instant, or in bands of a scene from CityJSON. Computed when first asked for.
enum class Valid { broadband, bands };
const std::string& valid_result(Valid which);
/// Where it can be changed: datasets, their units, attributes of the root.
const std::vector<test::ResultPlace>& places_of(Valid which);
/// The CityJSON model of `Valid::bands`.
const std::string& valid_model();

enum class ResultChange : std::uint8_t { one_value, all_values, size, rank, type, removal };
inline constexpr std::size_t result_changes = 6;

/// What is done at a place: `element` says where in it, `value` what becomes of it, each modulo
/// what there is.
struct ChangeAt {
  ResultChange change = ResultChange::one_value;
  std::size_t place = 0, element = 0, value = 0;
};
/// How many values a place can be given; that many differ.
std::size_t changed_values(const test::ResultPlace& place);

/// A copy of the valid result with these changes; returns its path.
std::string changed_result(Valid which, const std::vector<ChangeAt>& changes);

/// Everything that commands read of a result, and what they make of it. Throws InputError where
/// the file is refused; what a single command refuses keeps none of the others from reading.
/// Returns how many commands did not refuse.
std::size_t read_by_all(const std::string& result, Valid which);

}  // namespace sunload::fuzz
