// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What patches send into every direction, of what leaves them diffusely.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/result/reader.h"

namespace sunload {

/// L = (rho E + M) / π of every patch: of reflected and emitted light, without what mirrors, gloss,
/// panes and crowns send on. It is no dataset of results but made of them. Of a result in bands it
/// is that of the chosen band, or the mean of the bands'.
std::string radiance_name(Quantity quantity);   ///< radiance, or luminance
std::string radiance_units(Quantity quantity);  ///< W m-2 sr-1, or cd m-2

/// In an interval. Throws InputError where the result lacks the series of all light or what
/// surfaces reflect: it is of an earlier version, or of a scene that seasons change.
std::vector<double> radiance_at(const ResultReader& result, std::size_t interval);

/// Mean over the intervals of the period, or of its part that is chosen; by night, too, where the
/// period has nights. Throws InputError where a part is chosen and what surfaces reflect is
/// unknown.
std::vector<double> mean_radiance(const ResultReader& result);

}  // namespace sunload
