// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Maps that show lengths at another scale than heights.
#pragma once

#include <string>

#include "geo/base/check.h"
#include "geo/base/vec.h"
#include "geo/sun/site.h"

namespace sunload {

/// What lengths at a point of a map are off by, where that is more than half a percent: a warning,
/// else empty. Throws InputError beyond five percent, unless the point lies outside of where the
/// map is used: coordinates that do not belong to the map may be right all the same. `why` that
/// matters; `hint`: what to do, before the name of a map that keeps lengths at the site.
std::string true_lengths_warning(const std::string& crs, Vec3 point, const Site& site,
                                 const Where& where, const std::string& why,
                                 const std::string& hint);

}  // namespace sunload
