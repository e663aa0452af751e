// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/vrml/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace sunload {

VrmlModel::VrmlModel(const std::string& path, const SceneFileRules& rules)
    : rules_(rules),
      scene_from_file_(rules, 'y', path),
      stem_(std::filesystem::path(path).stem().string()) {
  if (lower_case(stem_).ends_with(".wrl")) stem_.resize(stem_.size() - 4);  // of .wrl.gz
  model_.source = path;
}

int VrmlModel::enter(int parent, const std::string& name) {
  const std::string prefix = parent < 0 ? "" : places_[static_cast<std::size_t>(parent)].name + "/";
  places_.push_back({prefix + name});
  return static_cast<int>(places_.size()) - 1;
}

double VrmlModel::strength(const std::array<double, 3>& colour) const {
  const auto [r, g, b] = colour;
  return rules_.vrml_colour == VrmlColour::norm ? std::sqrt(r * r + g * g + b * b)
                                                : (r + g + b) / 3;
}

namespace {

/// The colour in bands whose mean is its strength, unless it is grey, or one of them were above 1.
std::optional<std::array<double, 3>> bands_of(const std::array<double, 3>& colour,
                                              double strength) {
  FileMaterial mean, scaled;
  if (!mean.set_diffuse(colour) || !mean.diffuse_rgb) return std::nullopt;
  const double factor = strength / *mean.diffuse;
  scaled.set_diffuse({colour[0] * factor, colour[1] * factor, colour[2] * factor});
  return scaled.diffuse_rgb;
}

}  // namespace

MaterialId VrmlModel::material(const void* node, int index, const VrmlMaterial& colours) {
  const auto [entry, is_new] =
      materials_.try_emplace({node, index}, make_id<MaterialId>(model_.materials.size()));
  if (!is_new) return entry->second;
  FileMaterial material;
  material.name = material_names_(colours.name.empty() ? "material" : colours.name);
  material.diffuse = strength(colours.diffuse);
  material.diffuse_rgb = bands_of(colours.diffuse, *material.diffuse);
  material.mirror = strength(colours.specular);
  material.emitted_power_w = strength(colours.emissive) * rules_.emission_scale_w;
  material.source = file_;
  material.may_be_scaled = true;
  if (material.emitted_power_w > 0) {
    notes_.say(
        fmt::format("material '{}' emits {:.6g} W in all (emissiveColor × "
                    "scene.emission_scale_w)",
                    material.name, material.emitted_power_w));
  }
  if (colours.transparency > 0) transparent_.add(entry->second);
  model_.materials.push_back(std::move(material));
  return entry->second;
}

/// Objects enter the table with their first face.
ObjectId VrmlModel::object_of(int place) {
  ObjectId& object = place < 0 ? nameless_ : places_[static_cast<std::size_t>(place)].object;
  if (!object.exists()) {
    const auto& name = place < 0 ? stem_ : places_[static_cast<std::size_t>(place)].name;
    object = make_id<ObjectId>(model_.object_names.size());
    model_.object_names.push_back(object_names_(name));
    model_.object_kinds.emplace_back();
  }
  return object;
}

void VrmlModel::add(const ShapeFaces& shape, const Affine& file_from_shape, int place,
                    const std::vector<MaterialId>& materials) {
  std::size_t corners = model_.ring_vertex.size();
  for (const auto& face : shape.faces) corners += face.size();
  if (corners > most_corners_of(file_bytes_)) {
    throw InputError({model_.source}, "has too many faces",
                     "with every USE in its place they are too many for its size");
  }
  // A mirrored shape keeps its front: its corners run the other way around.
  const bool is_mirrored = file_from_shape.determinant() < 0;
  std::vector<std::int32_t> place_of(shape.points.size(), -1);
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    auto ring = shape.faces[f];
    for (auto& corner : ring) {
      auto& target = place_of[static_cast<std::size_t>(corner)];
      if (target < 0) {
        const Vec3 in_file = file_from_shape(shape.points[static_cast<std::size_t>(corner)]);
        const Vec3 position = scene_from_file_(in_file);
        if (!is_usable(position)) {
          throw InputError({model_.source}, "has a vertex beyond all coordinates on Earth",
                           "in object '" + model_.object_names[object_of(place).index()] + "'",
                           "is unit_m right?");
        }
        largest_ =
            std::max({largest_, std::abs(position.x), std::abs(position.y), std::abs(position.z)});
        target = static_cast<std::int32_t>(model_.vertices.size());
        model_.vertices.push_back(position);
      }
      corner = target;
    }
    if (is_mirrored) std::reverse(ring.begin(), ring.end());
    const auto own = shape.face_material.empty()
                         ? 0
                         : static_cast<std::size_t>(shape.face_material[f]) % materials.size();
    model_.add_polygon({ring}, {.object = object_of(place),
                                .material = materials[own],
                                .sides = shape.is_two_sided ? Sides::two : Sides::one});
  }
}

PolygonModel VrmlModel::finish() {
  constexpr double telling_m = 1e-3;  // steps that a user would want to know of
  // Floats of this size are spaced by at most 2⁻²³ of it.
  const double step = largest_ * std::numeric_limits<float>::epsilon();
  if (step > telling_m) {
    notes_.say(fmt::format(
        "coordinates are read in single precision: steps of {:.2g} m at {:.0f} m", step, largest_));
  }
  transparent_.count_used(model_, notes_);
  put_notes(notes_, model_);
  return std::move(model_);
}

}  // namespace sunload
