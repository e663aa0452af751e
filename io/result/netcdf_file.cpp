// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/netcdf_file.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geo/base/check.h"
#include "io/base/file_aside.h"
#include "io/result/schema.h"
#include "io/result/time.h"

namespace sunload {

void NetcdfFile::dimension(const std::string& name, std::size_t size) {
  // The words by which netCDF-4 knows a dimension without a variable.
  constexpr const char* no_variable = "This is a netCDF dimension but not a netCDF variable. ";
  constexpr std::size_t digits = 10;
  const auto number = std::to_string(size);
  sizes_[name] = size;
  auto scale = file_.create_dataset(name, {h5::Type::float32, {size}, {}, 0});
  scale.make_scale(no_variable + std::string(digits - std::min(digits, number.size()), ' ') +
                   number);
  scales_.emplace(name, scale);
}

void NetcdfFile::make_scale(const std::string& name, const std::string& long_name,
                            h5::Dataset scale) {
  scale.make_scale(name);
  scale.set("long_name", long_name);
  scales_.emplace(name, scale);
}

void NetcdfFile::labels(const std::string& name, const std::string& long_name,
                        const std::vector<std::string>& names) {
  sizes_[name] = names.size();
  auto scale = file_.create_dataset(name, {h5::Type::text, {names.size()}, {}, 0});
  make_scale(name, long_name, scale);
  scale.write(names);
}

void NetcdfFile::numbers(const std::string& name, const std::string& long_name, std::size_t size) {
  std::vector<std::int32_t> from_nought(size);
  std::iota(from_nought.begin(), from_nought.end(), 0);
  sizes_[name] = size;
  auto scale = file_.create_dataset(name, {h5::Type::int32, {size}, {}, 0});
  make_scale(name, long_name, scale);
  scale.write(from_nought);
}

void NetcdfFile::close() {
  scales_.clear();
  file_.close();
}

void write_netcdf(const std::string& path, const std::function<void(NetcdfFile&)>& put) {
  FileAside target(path);
  try {
    NetcdfFile file(target.aside());
    put(file);
    file.close();
  } catch (const h5::Error& error) {
    throw MachineError("cannot write " + path + ": " + error.what());
  }
  target.publish();
}

void put_mesh(NetcdfFile& file, const ResultReader& of) {
  constexpr std::size_t axes = 3;
  const auto label = [&](const char* name) {
    file.labels(name, std::string(find_result_variable(name)->long_name),
                of.strings(std::string(name) + "_name"));
  };
  file.dimension("xyz", axes);
  file.dimension("corner", axes);
  file.dimension("vertex", of.shape("vertex_position").front());
  file.dimension("patch", of.shape("patch_area").front());
  file.dimension("input_triangle", of.shape("input_triangle_vertices").front());
  label("object");
  label("material");
  for (const char* name :
       {"object_name", "material_name", "patch_material", "patch_input_triangle",
        "input_triangle_vertices", "vertex_position", "vertex_x", "vertex_y", "vertex_z",
        "patch_vertices", "patch_area", "patch_centroid", "patch_normal", "patch_object",
        "patch_facade", "patch_surface", "patch_side"}) {
    const auto* variable = find_result_variable(name);
    const auto dims = dimension_names(*variable);
    const std::string units(variable->units), what(variable->long_name);
    if (variable->type == h5::Type::text)
      file.put(name, dims, variable->type, units, what, of.strings(name));
    else if (variable->type == h5::Type::float64)
      file.put(name, dims, variable->type, units, what, of.doubles(name));
    else
      file.put(name, dims, variable->type, units, what, of.integers(name));
  }
  auto mesh = file.put("mesh", {}, h5::Type::int32, "", "topology of the patches",
                       std::vector<std::int32_t>{0});
  mesh.set("cf_role", "mesh_topology");
  mesh.set("topology_dimension", 2.0, h5::Type::int32);
  mesh.set("node_coordinates", "vertex_x vertex_y vertex_z");
  mesh.set("face_node_connectivity", "patch_vertices");
}

void put_of_patches(NetcdfFile& file, const std::string& name, const std::string& units,
                    const std::string& long_name, const std::vector<double>& values) {
  auto dataset = file.put(name, {"patch"}, h5::Type::float64, units, long_name, values);
  dataset.set("mesh", "mesh");
  dataset.set("location", "face");
}

void put_site(h5::File& file, const ResultReader& of) {
  const Vec3 origin = of.origin();
  for (const char* name : {"study", "timezone", "crs"})
    if (const auto text = of.text_attribute(name); !text.empty()) file.set(name, text);
  for (const char* name : {"latitude_deg", "longitude_deg", "elevation_m", "north_deg"})
    if (const double number = of.number_attribute(name); std::isfinite(number))
      file.set(name, number, h5::Type::float64);
  file.set("period", period_in_words(of));
  file.set("origin", {origin.x, origin.y, origin.z}, h5::Type::float64);
}

}  // namespace sunload
