// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/explain/place_map.h"

#include <map>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/base/statistics.h"
#include "io/explain/explanation.h"
#include "io/explain/light_of_part.h"
#include "io/explain/place.h"
#include "io/result/netcdf_file.h"
#include "io/result/schema.h"

namespace sunload {

namespace {

/// The columns of the file [kWh m-4, or klx h m-2] by dataset.
using MapColumns = std::map<std::string, std::vector<double>>;

/// Sum of flows of a patch, mean over the realizations with its error.
SampleMean sum_of(const Attribution& a, std::size_t patch, std::initializer_list<Flow> flows) {
  std::vector<double> sums;
  for (std::size_t r = 0; r < a.realizations(); ++r) {
    double sum = 0;
    for (const Flow flow : flows) sum += a.flow(patch, flow, r);
    sums.push_back(sum / joules_per_kwh);
  }
  return sample_mean(sums);
}

MapColumns columns_of(const Attribution& a, const std::vector<double>& area) {
  MapColumns columns;
  for (std::size_t i = 0; i < area.size(); ++i) {
    const auto put = [&](const char* name, std::initializer_list<Flow> flows) {
      columns[name].push_back(sum_of(a, i, flows).mean / area[i]);
    };
    put("light_given", {Flow::reflects, Flow::mirrors, Flow::shines});
    columns["light_given_se"].push_back(
        sum_of(a, i, {Flow::reflects, Flow::mirrors, Flow::shines}).se / area[i]);
    put("light_given_reflected", {Flow::reflects});
    put("light_given_mirror", {Flow::mirrors});
    put("light_given_lamps", {Flow::shines});
    put("light_taken", {Flow::takes_sun, Flow::takes_sky, Flow::takes_far_ground});
    put("light_taken_sun", {Flow::takes_sun});
    put("light_taken_sky", {Flow::takes_sky});
    put("light_taken_ground", {Flow::takes_far_ground});
  }
  return columns;
}

/// Share of the place that each patch is.
std::vector<double> weights_of(const Place& place, std::size_t patches) {
  std::vector<double> weights(patches, 0);
  if (!place.is_of_sensors)
    for (std::size_t k = 0; k < place.receivers.size(); ++k)
      weights[place.receivers[k]] = place.weight[k];
  return weights;
}

void put_facades(NetcdfFile& file, const ResultReader& result) {
  const auto names = result.strings("facade_name");
  if (names.empty()) return;
  file.labels("facade", std::string(find_result_variable("facade")->long_name), names);
  file.put("facade_name", {"facade"}, h5::Type::text, "",
           std::string(find_result_variable("facade_name")->long_name), names);
}

void put_attributes(h5::File& file, const ResultReader& result, const NamedParts& parts,
                    const Place& place) {
  const std::string words = words_of(parts);
  file.set("title", "Where the light of " + words + " comes from");
  file.set("Conventions", std::string(result_conventions));
  file.set("sunload_format", std::string(place_map_format));
  file.set("place", words);
  file.set("extent", extent_of(result, place));
  file.set("variant", result.text_attribute("variant"));
  file.set("study_sha256", result.text_attribute("study_sha256"));
  if (result.quantity() == Quantity::illuminance) file.set("quantity", "illuminance");
  put_site(file, result);
}

}  // namespace

void expect_map_name(const std::string& path) {
  if (!path.ends_with(".h5"))
    throw InputError({path}, "is no name of a map", "it is written as HDF5, which render draws",
                     "let it end in .h5");
}

void write_place_map(const ResultReader& result, const ResultScene& scene, const NamedParts& parts,
                     const std::string& path) {
  expect_explainable(result);
  scene.expect_one_season();
  const Place place = place_named(result, parts);
  const Attribution a = attribute_light(scene.traced(), scene.period(), sent_light(result, scene),
                                        place, chosen_part(result, scene.light()), Among::patches);
  const auto area = result.doubles("patch_area");
  MapColumns columns = columns_of(a, area);
  columns["place_weight"] = weights_of(place, area.size());
  write_netcdf(path, [&](NetcdfFile& file) {
    put_facades(file, result);
    put_mesh(file, result);
    for (const auto& variable : place_map_schema(result.quantity()))
      put_of_patches(file, std::string(variable.name), std::string(variable.units),
                     std::string(variable.long_name), columns.at(std::string(variable.name)));
    put_attributes(file.file(), result, parts, place);
  });
}

}  // namespace sunload
