// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/mesh_files/obj_write.h"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <utility>

#include "io/base/file_aside.h"

namespace sunload {
namespace {

/// Blanks end a name in some readers, and `#` begins a comment.
std::string one_word(std::string name) {
  for (char& c : name)
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '#') c = '_';
  return name.empty() ? "unnamed" : name;
}

std::string library_text(const std::vector<FileMaterial>& materials) {
  std::string text;
  auto out = std::back_inserter(text);
  for (const auto& material : materials) {
    fmt::format_to(out, "newmtl {}\n", one_word(material.name));
    if (material.diffuse) fmt::format_to(out, "Kd {0} {0} {0}\n", *material.diffuse);
    const double mirror = material.mirror.value_or(0);
    if (mirror > 0) fmt::format_to(out, "Ks {0} {0} {0}\nillum 3\n", mirror);
    if (material.emitted_power_w > 0)
      fmt::format_to(out, "# emits {} W\nKe 1 1 1\n", material.emitted_power_w);
    text += '\n';
  }
  return text;
}

std::string scene_text(const Mesh& mesh, const std::string& library) {
  std::string text = fmt::format("# metres, z up\nmtllib {}\n", library);
  auto out = std::back_inserter(text);
  for (const auto& vertex : mesh.vertices) {
    const Vec3 p = mesh.origin + vertex;
    fmt::format_to(out, "v {} {} {}\n", p.x, p.y, p.z);
  }
  ObjectId object;
  MaterialId material;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (t == 0 || mesh.triangle_object[t] != object) {
      object = mesh.triangle_object[t];
      material = MaterialId::none();
      fmt::format_to(out, "o {}\n", one_word(mesh.object_names[object.index()]));
    }
    if (mesh.triangle_material[t] != material) {
      material = mesh.triangle_material[t];
      const bool has_name = material.exists();
      fmt::format_to(
          out, "usemtl {}\n",
          has_name ? one_word(mesh.file_materials[material.index()].name) : "unassigned");
    }
    const auto& corners = mesh.triangles[t];  // OBJ counts from 1
    fmt::format_to(out, "f {} {} {}\n", corners[0] + 1, corners[1] + 1, corners[2] + 1);
  }
  return text;
}

}  // namespace

std::string obj_library(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".mtl").string();
}

void write_obj(const Mesh& mesh, const std::string& path) {
  const std::string library = obj_library(path);
  write_file(library, library_text(mesh.file_materials));
  write_file(path, scene_text(mesh, std::filesystem::path(library).filename().string()));
}

std::vector<std::string> write_obj(const PolygonModel& model, const std::string& path,
                                   Repair repair) {
  PlainTriangles triangles = plain_triangles(model, repair);
  write_obj(triangles.mesh, path);
  return std::move(triangles.warnings);
}

}  // namespace sunload
