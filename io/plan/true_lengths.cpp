// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/true_lengths.h"

#include <fmt/format.h>

#include <cmath>

#include "geo/sun/map_axes.h"

namespace sunload {

std::string true_lengths_warning(const std::string& crs, Vec3 point, const Site& site,
                                 const Where& where, const std::string& why,
                                 const std::string& hint) {
  constexpr double doubtful = 0.005, refused = 0.05;  // UTM has up to 0.001 in its zone
  const double stretch = map_stretch(crs, point);
  if (std::abs(stretch) <= doubtful) return {};
  const std::string what =
      fmt::format("lengths on the map of '{}' are {:.2g} % {} than on the ground there", crs,
                  100 * std::abs(stretch), stretch > 0 ? "longer" : "shorter");
  const std::string way = hint + " " + utm_at(site.latitude_deg, site.longitude_deg);
  if (std::abs(stretch) > refused && area_of_use_warning(crs, point).empty())
    throw InputError(where, what, why, way);
  return message({}, what, why, way);
}

}  // namespace sunload
