// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A small result file made up by hand, for tests of what reads results.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geo/base/vec.h"

namespace sunload::test {

/// A box that stands on the ground: an object with a roof and four facades
/// `<name>/north_1` … , walls and roof cut into `cells` × `cells` squares.
struct SmallHouse {
  std::string name;
  Vec3 low, high;
};

/// What the tests vary. Objects: `ground` (a 40 m × 40 m plate about the
/// origin), the houses, and `awning`, a two-sided square whose front looks up.
/// Three hours of sun from the south, the second the brightest.
struct SmallResult {
  std::string variant = "baseline";
  std::string pairing_id;
  std::size_t realizations = 8;
  int cells = 2;
  std::vector<SmallHouse> houses{{"house_1", {-12, 0, 0}, {-2, 8, 9}},
                                 {"house_2", {2, 0, 0}, {12, 8, 6}}};
  Vec3 origin{1000, 2000, 0};
  std::optional<double> north_deg = {};  ///< nothing: not stored
  /// Of all patches; nothing: not stored, nor what they send, as of earlier versions.
  std::optional<double> diffuse_reflectance = {};
  double emitted_exitance = 0;  ///< [W m-2], of all patches; 0: not stored
  double reflected_share = 0;   ///< of every load; 0: reflected light is not stored
  /// `facade_irradiance`, of what the means over patches are; nothing: not stored.
  std::optional<double> facade_share = {};
  /// `irradiance_mirror`, of the irradiance; nothing: not stored.
  std::optional<double> mirror_share = {};
  /// Hours of sun of a patch of that object and normal.
  std::function<double(const std::string& object, Vec3 normal)> hours = [](const std::string&,
                                                                           Vec3) { return 3.0; };
  /// A measure `sun` [h] of patches, NaN where it is not taken, with levels `low` from 1 h and
  /// `high` from 3 h on half of the area; nothing: no measure.
  std::function<double(const std::string& object, Vec3 normal)> measure = {};
  std::string measure_parameters = "{}";
  /// Light load [kWh m-2] of a patch of that object and normal, realization r.
  std::function<double(const std::string& object, Vec3 normal, std::size_t r)> load =
      [](const std::string&, Vec3 normal, std::size_t) { return 2 + normal.z - normal.y; };
};

/// Writes the file and returns its path: `<folder of the test>/<name>.h5`. The
/// light load is the mean of the realizations; the irradiance of interval k
/// (k = 0, 1, 2) is (100, 300, 200) times the light load.
std::string write_small_result(const SmallResult& result, const std::string& name);

}  // namespace sunload::test
