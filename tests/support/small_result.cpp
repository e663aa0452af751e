// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/small_result.h"

#include <filesystem>

#include "geo/base/units.h"
#include "geo/mesh/mesh.h"
#include "io/base/statistics.h"
#include "io/batch/facade_means.h"
#include "io/result/writer.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

constexpr double first_hour = 1782032400;  // 2026-06-21T09:00:00Z
constexpr std::array<double, 3> interval_share{100, 300, 200};

/// Collects rectangles as patches, object by object.
class Patches {
 public:
  ResultGeometry geometry;

  void begin_object(const std::string& name) { geometry.object_name.push_back(name); }

  std::int32_t facade(const std::string& name, double area, double azimuth_deg) {
    geometry.facade_name.push_back(name);
    geometry.facade_area.push_back(area);
    geometry.facade_azimuth_deg.push_back(azimuth_deg);
    return static_cast<std::int32_t>(geometry.facade_name.size()) - 1;
  }

  /// The parallelogram corner + s·u + t·v, front along u × v.
  void rectangle(Vec3 corner, Vec3 u, Vec3 v, int cells, Surface surface, std::int32_t facade,
                 Sides sides = Sides::one) {
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < cells; ++k) {
        const Vec3 a = corner + u * (1.0 * i / cells) + v * (1.0 * k / cells);
        const Vec3 b = a + u / cells, c = b + v / cells, d = a + v / cells;
        triangle({a, b, c}, surface, facade, sides);
        triangle({a, c, d}, surface, facade, sides);
      }
  }

 private:
  void triangle(std::array<Vec3, 3> p, Surface surface, std::int32_t facade, Sides sides) {
    const auto first = static_cast<std::int32_t>(geometry.vertices.size());
    geometry.vertices.insert(geometry.vertices.end(), p.begin(), p.end());
    const auto input = static_cast<std::int32_t>(geometry.input_triangle_vertices.size());
    geometry.input_triangle_vertices.push_back({first, first + 1, first + 2});
    const Vec3 area_vector = cross(p[1] - p[0], p[2] - p[0]) / 2;
    for (std::uint8_t side = 0; side <= (sides == Sides::two ? 1 : 0); ++side) {
      const bool is_front = side == 0;
      geometry.patch_vertices.push_back(
          {first, is_front ? first + 1 : first + 2, is_front ? first + 2 : first + 1});
      geometry.patch_area.push_back(norm(area_vector));
      geometry.patch_centroid.push_back((p[0] + p[1] + p[2]) / 3);
      geometry.patch_normal.push_back(normalized(area_vector) * (is_front ? 1 : -1));
      geometry.patch_object.push_back(static_cast<std::int32_t>(geometry.object_name.size()) - 1);
      geometry.patch_facade.push_back(facade);
      geometry.patch_material.push_back(0);
      geometry.patch_input_triangle.push_back(input);
      geometry.patch_surface.push_back(static_cast<std::uint8_t>(surface));
      geometry.patch_side.push_back(side);
    }
  }
};

void add_house(Patches& patches, const SmallHouse& house, int cells) {
  const Vec3 size = house.high - house.low, low = house.low;
  const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  patches.begin_object(house.name);
  const auto wall = [&](const char* side, double azimuth_deg, Vec3 corner, Vec3 along) {
    const auto facade =
        patches.facade(house.name + "/" + side + "_1", norm(along) * size.z, azimuth_deg);
    patches.rectangle(corner, along, z, cells, Surface::wall, facade);
  };
  wall("north", 0, low + x + y, -x);
  wall("east", 90, low + x, y);
  wall("south", 180, low, x);
  wall("west", 270, low + y, -y);
  patches.rectangle(low + z, x, y, cells, Surface::roof, -1);
}

ResultGeometry geometry_of(const SmallResult& result) {
  Patches patches;
  patches.geometry.material_name = {"brick, old"};
  patches.geometry.origin = result.origin;
  patches.begin_object("ground");
  patches.rectangle({-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, 4 * result.cells, Surface::ground, -1);
  for (const auto& house : result.houses) add_house(patches, house, result.cells);
  patches.begin_object("awning");
  patches.rectangle({-2, -6, 3}, {4, 0, 0}, {0, 4, 0}, result.cells, Surface::other, -1,
                    Sides::two);
  return patches.geometry;
}

ResultTimes times() {
  ResultTimes t;
  for (std::size_t k = 0; k < interval_share.size(); ++k) {
    const double begin = first_hour + static_cast<double>(k) * seconds_per_hour;
    const Horizontal sun{150 + 15.0 * static_cast<double>(k), 60};
    t.time.push_back(begin + seconds_per_hour / 2);
    t.bounds.push_back({begin, begin + seconds_per_hour});
    t.sun_azimuth_deg.push_back(sun.azimuth_deg);
    t.sun_elevation_deg.push_back(sun.elevation_deg);
    t.sun_direction.push_back(enu_direction(sun));
    t.dni.push_back(2 * interval_share[k]);
    t.dhi.push_back(interval_share[k]);
    t.ghi.push_back(3 * interval_share[k]);
  }
  return t;
}

/// One batch with the series and the ledger of all intervals.
void append_series(ResultWriter& writer, const std::vector<double>& load,
                   const ResultGeometry& geometry, std::optional<double> facade_share,
                   std::optional<double> mirror_share, const std::string& path,
                   std::size_t chunk_intervals) {
  BatchHeader header;
  header.content_hash = "none";
  header.isa = "none";
  header.interval_count = interval_share.size();
  header.chunk_intervals = chunk_intervals;
  BatchWriter batch(header);
  std::vector<float> irradiance;
  for (const double share : interval_share)
    for (const double value : load) irradiance.push_back(static_cast<float>(share * value));
  batch.add(
      {"irradiance", MergeRule::append, ArrayType::float32, {interval_share.size(), load.size()}},
      irradiance.data());
  if (mirror_share) {
    std::vector<float> mirrored;
    for (const float value : irradiance)
      mirrored.push_back(static_cast<float>(*mirror_share * value));
    batch.add({"irradiance_mirror",
               MergeRule::append,
               ArrayType::float32,
               {interval_share.size(), load.size()}},
              mirrored.data());
  }
  if (facade_share) {
    const std::size_t facades = geometry.facade_name.size();
    const FacadeMeans means(geometry.patch_facade, geometry.patch_area, facades);
    std::vector<float> of_facades;
    for (const double mean : means.of(irradiance, Divided::sums))
      of_facades.push_back(static_cast<float>(*facade_share * mean));
    batch.add({"facade_irradiance",
               MergeRule::append,
               ArrayType::float32,
               {interval_share.size(), facades}},
              of_facades.data());
  }
  const std::vector<double> in(interval_share.size(), 5000), out(interval_share.size(), 4990),
      residual(interval_share.size(), 10);
  const auto ledger = [&](const char* name, const std::vector<double>& power) {
    batch.add({name, MergeRule::append, ArrayType::float64, {power.size()}}, power.data());
  };
  ledger("power_sun", in);
  ledger("power_absorbed", out);
  ledger("power_residual", residual);
  batch.write(path);
  writer.append(BatchReader(path));
  std::filesystem::remove(path);
}

/// A value for each patch by its object and normal.
template <class Get>
std::vector<double> of_patches(const ResultGeometry& geometry, const Get& get) {
  std::vector<double> values;
  for (std::size_t i = 0; i < geometry.patch_area.size(); ++i)
    values.push_back(get(geometry.object_name[static_cast<std::size_t>(geometry.patch_object[i])],
                         geometry.patch_normal[i]));
  return values;
}

void write_measure(ResultWriter& writer, const SmallResult& result,
                   const ResultGeometry& geometry) {
  MeasureAttributes attributes;
  attributes.text = {{"rule", "sun_hours"},       {"definition", "hours"},
                     {"source", "a test"},        {"parameters", result.measure_parameters},
                     {"level_words", "low high"}, {"better", "more"}};
  attributes.level_values = {1, 3};
  attributes.area_percent = 50;
  writer.write_measure({"measure_sun", "h", of_patches(geometry, result.measure)}, attributes);
}

}  // namespace

std::string write_small_result(const SmallResult& result, const std::string& name) {
  const auto geometry = geometry_of(result);
  const std::filesystem::path path(folder_of_test() / (name + ".h5"));
  ResultWriter::Options options;
  options.realizations = result.realizations;
  ResultWriter writer(path.string(), geometry, times(), options);

  const std::size_t patches = geometry.patch_area.size();
  std::vector<double> realization, load(patches), se(patches);
  for (std::size_t r = 0; r < result.realizations; ++r)
    for (const double value : of_patches(geometry, [&](const std::string&object, Vec3 normal) {
           return result.load(object, normal, r);
         }))
      realization.push_back(value);
  for (std::size_t i = 0; i < patches; ++i) {
    std::vector<double> samples;
    for (std::size_t r = 0; r < result.realizations; ++r)
      samples.push_back(realization[r * patches + i]);
    load[i] = sample_mean(samples).mean;
    se[i] = sample_mean(samples).se;
  }
  append_series(writer, load, geometry, result.facade_share, result.mirror_share,
                path.string() + ".batch", options.chunk_intervals);
  writer.write({"light_load", load});
  writer.write({"light_load_se", se});
  if (result.reflected_share > 0) {
    std::vector<double> reflected(load);
    for (double& value : reflected) value *= result.reflected_share;
    writer.write({"light_load_reflected", reflected});
  }
  writer.write({"light_load_realization", realization});
  writer.write({"sun_hours", of_patches(geometry, result.hours)});
  if (result.measure) write_measure(writer, result, geometry);
  if (result.diffuse_reflectance) {
    writer.write(
        {"diffuse_reflectance", std::vector<double>(patches, *result.diffuse_reflectance)});
    if (result.emitted_exitance > 0)
      writer.write({"emitted_exitance", std::vector<double>(patches, result.emitted_exitance)});
  }
  ResultAttributes attributes;
  attributes.text = {{"title", "small"},
                     {"variant", result.variant},
                     {"source", "a test"},
                     {"timezone", "Europe/Prague"},
                     {"pairing_id", result.pairing_id}};
  if (result.measure) attributes.text.emplace_back("measures", "sun");
  if (result.north_deg) attributes.numbers.emplace_back("north_deg", *result.north_deg);
  writer.finish(attributes, "name: small\n");
  return path.string();
}

}  // namespace sunload::test
