// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/scene_models.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "geo/base/unused_name.h"
#include "geo/sun/map_axes.h"
#include "io/scene/blocks.h"
#include "io/scene/builtin.h"
#include "io/scene/file.h"

namespace sunload {

namespace {

std::string short_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// Names that the scene has already get a number; they are noted.
void add_object_names(PolygonModel& into, const PolygonModel& from) {
  std::set<std::string> taken(into.object_names.begin(), into.object_names.end());
  std::size_t renamed = 0;
  std::string first;
  for (const auto& base : from.object_names) {
    const std::string name = unused_name(base, taken);
    if (name != base && renamed++ == 0) first = fmt::format("'{}' is '{}'", base, name);
    into.object_names.push_back(name);
  }
  if (renamed > 0)
    into.notes.push_back(fmt::format(
        "{}: {} object{} named as in an earlier file, kept apart: {}{}", short_name(from.source),
        renamed, renamed == 1 ? " is" : "s are", first, renamed == 1 ? "" : ", …"));
}

/// Numbers of `from` count behind those that `into` has; names of bare objects that are taken get a
/// number.
void add_families(PolygonModel& into, const Families& from, std::size_t objects_before) {
  Families& families = into.families;
  const std::size_t bare_before = families.bare.size();
  const auto behind = [&](Owner owner) {
    if (owner.object.exists())
      owner.object = make_id<ObjectId>(owner.object.index() + objects_before);
    if (owner.bare.exists()) owner.bare = make_id<BareId>(owner.bare.index() + bare_before);
    return owner;
  };
  if (!from.of_object.empty()) families.of_object.resize(objects_before);
  for (const Owner& owner : from.of_object) families.of_object.push_back(behind(owner));
  if (from.bare.empty()) return;
  std::set<std::string> taken(into.object_names.begin(), into.object_names.end());
  for (const BareObject& bare : families.bare) taken.insert(bare.name);
  for (BareObject bare : from.bare) {
    bare.name = unused_name(bare.name, taken);
    bare.owner = behind(bare.owner);
    families.bare.push_back(std::move(bare));
  }
}

}  // namespace

void append(PolygonModel& into, const PolygonModel& from) {
  const auto vertex_base = static_cast<std::int32_t>(into.vertices.size());
  const auto ring_base = static_cast<std::int64_t>(into.ring_begin.size()) - 1;
  const auto corner_base = static_cast<std::int64_t>(into.ring_vertex.size());
  const auto object_base = static_cast<std::int32_t>(into.object_names.size());
  const auto material_base = static_cast<std::int32_t>(into.materials.size());
  into.vertices.insert(into.vertices.end(), from.vertices.begin(), from.vertices.end());
  for (const auto v : from.ring_vertex) into.ring_vertex.push_back(v + vertex_base);
  for (std::size_t r = 1; r < from.ring_begin.size(); ++r)
    into.ring_begin.push_back(from.ring_begin[r] + corner_base);
  for (std::size_t p = 1; p < from.polygon_ring.size(); ++p)
    into.polygon_ring.push_back(from.polygon_ring[p] + ring_base);
  for (auto facts : from.facts) {
    facts.object.value += object_base;
    if (facts.material.exists()) facts.material.value += material_base;
    into.facts.push_back(facts);
  }
  add_object_names(into, from);
  into.object_kinds.resize(into.object_names.size() - from.object_names.size());
  into.object_kinds.insert(into.object_kinds.end(), from.object_kinds.begin(),
                           from.object_kinds.end());
  into.object_kinds.resize(into.object_names.size());
  add_families(into, from.families, static_cast<std::size_t>(object_base));
  into.materials.insert(into.materials.end(), from.materials.begin(), from.materials.end());
  into.notes.insert(into.notes.end(), from.notes.begin(), from.notes.end());
  into.warnings.insert(into.warnings.end(), from.warnings.begin(), from.warnings.end());
  into.files.insert(into.files.end(), from.files.begin(), from.files.end());
  into.is_city_format = into.is_city_format || from.is_city_format;
  if (into.crs.empty()) into.crs = from.crs;
  into.source += (into.source.empty() ? "" : ", ") + from.source;
}

namespace {

PolygonModel built_in(const BuiltinStudy& builtin) {
  try {
    return builtin_scene({builtin.name, builtin.parameters});
  } catch (const InputError& error) {
    Problems problems;
    for (const auto& problem : error.problems()) problems.add(builtin.where, problem);
    problems.throw_if_any();
    throw;
  }
}

/// All faces get one material, which the study or the table defines; crowns keep theirs.
void give_material(PolygonModel& model, const std::string& name) {
  FileMaterial material;
  material.name = name;
  material.is_reference = true;
  const auto given = make_id<MaterialId>(model.materials.size());
  model.materials.push_back(material);
  for (auto& facts : model.facts)
    if (!facts.material.exists() || !model.materials[facts.material.index()].is_reference)
      facts.material = given;
}

}  // namespace

PolygonModel read_part(const SceneFileStudy& file, const SceneStudy& scene,
                       const std::string& crs) {
  auto rules = rules_of(file, scene);
  if (!file.is_placed()) rules.map_of_degrees = crs;
  PolygonModel part = file.terrain.empty() || is_of_footprints(file.path)
                          ? read_scene_file(file.path, rules)
                          : read_scene_blocks({.surface = file.path,
                                               .terrain = file.terrain,
                                               .canopy = file.canopy,
                                               .least_height_m = file.least_height_m,
                                               .trunk_share = file.trunk_share},
                                              rules);
  if (!file.material.empty()) give_material(part, file.material);
  return part;
}

namespace {

/// Heights that the CRS has in another unit than its map, such as feet over metres, become those of
/// the map: `unit_m` is of both. Rasters have done so, and say no more of heights.
void convert_heights(double unit_m, PolygonModel& part) {
  if (part.crs.empty()) return;
  const MapAxes axes(part.crs);
  if (!axes.is_known() || axes.is_in_degrees() || axes.is_geocentric()) return;
  const double ratio = axes.height_unit_m() / axes.unit_m();
  constexpr double alike = 1e-5;  // feet, and feet of surveys
  if (std::abs(ratio - 1) < alike) return;
  const std::string text = fmt::format("{}: heights of '{}' are in units of {:.6g} m",
                                       short_name(part.source), part.crs, axes.height_unit_m());
  // The study's word against the file's about the coordinates: it holds for heights as well.
  if (axes.unit_m() == 1 && unit_m != 1) {
    part.notes.push_back(fmt::format("{}, taken for units of {:g} m by unit_m", text, unit_m));
    return;
  }
  for (Vec3& p : part.vertices) p.z *= ratio;
  part.notes.push_back(text + ", converted to " +
                       (axes.unit_m() == 1
                            ? std::string("metres")
                            : fmt::format("units of {:.6g} m, as its coordinates", axes.unit_m())));
  part.crs = axes.name();
}

/// Reads, places and appends file by file; the CRS is that of the first file that stays in place.
class SceneJoin {
 public:
  explicit SceneJoin(const Study& study) : study_(study) {}

  PolygonModel run() {
    std::vector<const SceneFileStudy*> later;  // placed by a CRS that is not known yet
    for (const auto& file : study_.scene.files) {
      if (file.earth_position && crs().empty())
        later.push_back(&file);
      else
        add(file);
    }
    for (const auto* file : later) add(*file);
    problems_.throw_if_any();
    return std::move(model_);
  }

 private:
  const std::string& crs() const { return study_.site.crs.empty() ? model_.crs : study_.site.crs; }

  void add(const SceneFileStudy& file) {
    try {
      auto part = read_part(file, study_.scene, crs());
      if (file.is_placed()) {
        if (!part.crs.empty())
          part.notes.push_back(short_name(file.path) +
                               ": is placed by the study, so its own CRS is not used");
        place(part, place_of(file, crs()));
      }
      convert_heights(file.unit_m.value_or(study_.scene.unit_m), part);
      if (!model_.crs.empty() && !part.crs.empty() && !are_of_one_map(model_.crs, part.crs))
        tell_other_map(file.path, part);
      // Tens of millions of faces are not copied.
      if (model_.source.empty())
        model_ = std::move(part);
      else
        append(model_, part);
    } catch (const InputError& error) {
      problems_.add(error);
    }
  }

  /// The study's word on the CRS is of all files.
  void tell_other_map(const std::string& path, PolygonModel& part) {
    if (study_.site.crs.empty())
      problems_.add({path}, "coordinates in " + part.crs,
                    "an earlier file of the scene has " + model_.crs,
                    "bring all files of a scene into one CRS; site.crs says which one it is where "
                    "a file is wrong");
    else
      part.notes.push_back(
          fmt::format("{}: says its coordinates are in {}, taken for {} by site.crs",
                      short_name(path), part.crs, study_.site.crs));
  }

  const Study& study_;
  PolygonModel model_;
  Problems problems_;
};

}  // namespace

PolygonModel read_models(const Study& study) {
  return study.scene.builtin ? built_in(*study.scene.builtin) : SceneJoin(study).run();
}

void place(PolygonModel& model, const FilePlace& place) {
  for (Vec3& p : model.vertices) p = place(p);
  model.crs.clear();
}

}  // namespace sunload
