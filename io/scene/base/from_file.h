// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the scene readers share: axes and units, limits, names.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>

#include "geo/base/check.h"
#include "geo/base/vec.h"
#include "geo/mesh/mesh.h"
#include "io/base/file_text.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Scene from file: turns the file's axes and units into metres with z up.
class SceneFromFile {
 public:
  /// `default_up` is that of the format. Throws InputError for rules that make no sense.
  SceneFromFile(const SceneFileRules& rules, char default_up, const std::string& file);
  Vec3 operator()(Vec3 p) const;
  double unit_m() const { return unit_m_; }

 private:
  char up_;
  double unit_m_;
};

/// True for coordinates that geometry can be computed with: finite, and no farther
/// from the origin than any map projection of the Earth puts a point.
bool is_usable(Vec3 scene_position);

/// Corners of faces that so many bytes may make, where a format names parts again and again
/// (instances, USE, shared nodes): no file of less than 1 MB shall take more than 1 GB.
constexpr std::size_t most_corners_of(std::size_t file_bytes) { return 8'000'000 + 4 * file_bytes; }

/// Hands what was counted over to the model, behind what it has been told before.
void put_notes(const NoteCounter& counted, PolygonModel& model);

/// Hands out `name`, or `name_2`, `name_3` … where it is taken.
class UniqueNames {
 public:
  /// Throws InputError where names that are repeated take too much memory.
  std::string operator()(const std::string& name);

 private:
  std::size_t bytes_ = 0;
  std::set<std::string> taken_;
  std::map<std::string, int> last_;
};

}  // namespace sunload
