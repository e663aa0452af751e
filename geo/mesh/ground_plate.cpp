// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/ground_plate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geo/base/check.h"

namespace sunload {

namespace {

std::string unused_name(const std::vector<std::string>& names) {
  const auto is_taken = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::string name = "ground";
  for (int n = 2; is_taken(name); ++n) name = "ground_" + std::to_string(n);
  return name;
}

MaterialId ground_material(std::vector<FileMaterial>& materials) {
  const auto it = std::find_if(materials.begin(), materials.end(),
                               [](const FileMaterial& m) { return m.name == "ground"; });
  const auto index = static_cast<std::size_t>(it - materials.begin());
  if (it == materials.end()) {
    FileMaterial material;
    material.name = "ground";
    materials.push_back(material);
  }
  return make_id<MaterialId>(index);
}

}  // namespace

void add_ground_plate(Mesh& mesh, double margin_m) {
  const Box box = bounding_box(mesh.vertices);
  const double x0 = box.low.x - margin_m, x1 = box.high.x + margin_m;
  const double y0 = box.low.y - margin_m, y1 = box.high.y + margin_m, z = box.low.z;
  if (!(margin_m >= 0) || !std::isfinite(margin_m) || !(x1 > x0) || !(y1 > y0)) {
    throw InputError({}, "scene.ground.margin_m = " + std::to_string(margin_m),
                     "the ground plate needs a margin >= 0 and an area", "use 50");
  }
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (const Vec3 corner : {Vec3{x0, y0, z}, Vec3{x1, y0, z}, Vec3{x1, y1, z}, Vec3{x0, y1, z}}) {
    mesh.vertices.push_back(corner);
  }
  const auto object = make_id<ObjectId>(mesh.object_names.size());
  mesh.object_names.push_back(unused_name(mesh.object_names));
  mesh.object_kinds.emplace_back();
  const MaterialId material = ground_material(mesh.file_materials);
  for (const auto& t :
       {std::array{first, first + 1, first + 2}, std::array{first, first + 2, first + 3}}) {
    mesh.triangles.push_back(t);
    mesh.triangle_object.push_back(object);
    mesh.triangle_material.push_back(material);
    mesh.triangle_facade.push_back(FacadeId::none());
    mesh.triangle_surface.push_back(Surface::ground);
    mesh.triangle_sides.push_back(Sides::one);
  }
}

}  // namespace sunload
