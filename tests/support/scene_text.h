// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Small scene files for the tests of readers.
#pragma once

#include <string>

#include "io/scene/file.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload::test {

/// Writes a file into the folder of the running test and returns its path.
inline std::string write_text(const std::string& name, const std::string& text) {
  return folder_of_test().write(name, text);
}

inline PolygonModel read_text(const std::string& name, const std::string& text,
                              const SceneFileRules& rules = {}) {
  return read_scene_file(write_text(name, text), rules);
}

/// The message that a wrong file is refused with, without its folder; empty if it is read.
inline std::string refusal(const std::string& name, const std::string& text,
                           const SceneFileRules& rules = {}) {
  const auto path = write_text(name, text);
  return from_name_on(refusal_of([&] { read_scene_file(path, rules); }), name);
}

inline bool has_note(const PolygonModel& model, const std::string& part) {
  for (const auto& note : model.notes) {
    if (note.find(part) != std::string::npos) return true;
  }
  return false;
}

/// Corner `k` of ring `r` of polygon `p`.
inline Vec3 corner(const PolygonModel& model, std::size_t p, std::int64_t r, std::int64_t k) {
  const auto ring = static_cast<std::size_t>(model.polygon_ring[p] + r);
  const auto at = static_cast<std::size_t>(model.ring_begin[ring] + k);
  return model.vertices[static_cast<std::size_t>(model.ring_vertex[at])];
}

inline std::int64_t ring_count(const PolygonModel& model, std::size_t p) {
  return model.polygon_ring[p + 1] - model.polygon_ring[p];
}

inline std::int64_t ring_size(const PolygonModel& model, std::size_t p, std::int64_t r) {
  const auto ring = static_cast<std::size_t>(model.polygon_ring[p] + r);
  return model.ring_begin[ring + 1] - model.ring_begin[ring];
}

/// Faults of the flat arrays of a model, empty if there are none.
inline std::string broken_arrays(const PolygonModel& model) {
  if (model.polygon_ring.size() != model.facts.size() + 1) return "polygon_ring has a wrong size";
  if (model.polygon_ring.back() + 1 != static_cast<std::int64_t>(model.ring_begin.size())) {
    return "rings without a polygon";
  }
  if (model.ring_begin.back() != static_cast<std::int64_t>(model.ring_vertex.size())) {
    return "corners without a ring";
  }
  for (const auto vertex : model.ring_vertex) {
    if (vertex < 0 || static_cast<std::size_t>(vertex) >= model.vertices.size()) return "vertex";
  }
  for (const auto& facts : model.facts) {
    if (!facts.object.exists() || facts.object.index() >= model.object_names.size()) {
      return "object";
    }
    if (facts.material.exists() && facts.material.index() >= model.materials.size()) {
      return "material";
    }
  }
  return {};
}

}  // namespace sunload::test
