// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/base/indexed_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

namespace sunload {

IndexedFaces::IndexedFaces(const std::string& path, const SceneFileRules& rules, char default_up)
    : scene_from_file_(rules, default_up, path) {
  model_.source = path;
  use_object(std::filesystem::path(path).stem().string());
}

void IndexedFaces::use_object(const std::string& name, const std::string& kind) {
  object_name_ = name;
  object_kind_ = kind;
  facts_.object = ObjectId::none();
}

void IndexedFaces::use_material(MaterialId material, Sides sides) {
  facts_.material = material;
  facts_.sides = sides;
}

MaterialId IndexedFaces::add_material(FileMaterial material) {
  model_.materials.push_back(std::move(material));
  return make_id<MaterialId>(model_.materials.size() - 1);
}

void IndexedFaces::expect(std::size_t vertices, std::size_t faces) {
  constexpr std::size_t usual_corners = 3;
  vertices_.reserve(vertices);
  model_.ring_vertex.reserve(usual_corners * faces);
  model_.ring_begin.reserve(faces + 1);
  model_.polygon_ring.reserve(faces + 1);
  model_.facts.reserve(faces);
}

bool IndexedFaces::add_vertex(Vec3 in_file) {
  const Vec3 position = scene_from_file_(in_file);
  vertices_.push_back(position);
  return is_usable(position);
}

void IndexedFaces::end_face() {
  const auto begin = static_cast<std::size_t>(model_.ring_begin.back());
  if (model_.ring_vertex.size() < begin + 3) {
    model_.ring_vertex.resize(begin);
    notes_.count("faces of fewer than 3 corners left out");
    return;
  }
  model_.ring_begin.push_back(static_cast<std::int64_t>(model_.ring_vertex.size()));
  model_.polygon_ring.push_back(static_cast<std::int64_t>(model_.ring_begin.size()) - 1);
  if (!facts_.object.exists()) {  // objects enter the table with their first face
    const auto [entry, is_new] =
        objects_.try_emplace(object_name_, make_id<ObjectId>(model_.object_names.size()));
    if (is_new) {
      model_.object_names.push_back(object_name_);
      model_.object_kinds.push_back(object_kind_);
    }
    facts_.object = entry->second;
  }
  model_.facts.push_back(facts_);
}

void IndexedFaces::note_single_precision(Vec3 as_read) {
  for (const double x : {as_read.x, as_read.y, as_read.z})
    largest_single_ = std::max(largest_single_, std::abs(x));
}

void IndexedFaces::tell_coarse_steps() {
  constexpr double coarse_m = 0.002, far_off_m = 0.1, largest_of_maps = 1e9;
  if (!(largest_single_ < largest_of_maps)) return;
  const auto largest = static_cast<float>(largest_single_);
  const double step = static_cast<double>(
      std::nextafter(largest, std::numeric_limits<float>::infinity()) - largest);
  const double step_m = step * scene_from_file_.unit_m();
  if (!(step_m > coarse_m)) return;
  const std::string what = fmt::format(
      "coordinates as large as {:.0f} are in single precision: places are "
      "rounded to {:.2g} m; move the model to its origin before it is written",
      largest_single_, step_m);
  if (step_m > far_off_m)
    model_.warnings.push_back(model_.source + ": " + what);
  else
    notes_.say(what);
}

PolygonModel IndexedFaces::finish() {
  tell_coarse_steps();
  std::vector<std::int32_t> place(vertices_.size(), -1);
  for (const auto vertex : model_.ring_vertex) place[static_cast<std::size_t>(vertex)] = 0;
  std::int32_t used = 0;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (place[v] < 0) continue;
    place[v] = used++;
    vertices_[static_cast<std::size_t>(place[v])] = vertices_[v];
  }
  const auto unused = vertices_.size() - static_cast<std::size_t>(used);
  vertices_.resize(static_cast<std::size_t>(used));
  if (unused > 0) {
    for (auto& vertex : model_.ring_vertex) vertex = place[static_cast<std::size_t>(vertex)];
    notes_.count("vertices used by no face left out", unused);
  }
  model_.vertices = std::move(vertices_);
  transparent_.count_used(model_, notes_);
  put_notes(notes_, model_);
  return std::move(model_);
}

}  // namespace sunload
