// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Levels of detail: which geometries of an object are read, so that none are stacked.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>

namespace sunload {

/// Level of detail "major.minor"; a geometry that names none is below all others.
struct Lod {
  int major = -1;
  int minor = 0;

  friend auto operator<=>(const Lod&, const Lod&) = default;
};

/// `null` for none; CityJSON 1.0 has numbers, later versions text.
Lod lod_of(const nlohmann::json* value);

/// How well a level meets what is asked for; greater is better, lexicographically.
using LodRank = std::array<int, 3>;

/// What the study asks for.
class LodWish {
 public:
  /// "highest", "2" (any 2.x) or "2.2"; throws InputError otherwise.
  LodWish(const std::string& text, const std::string& file);
  LodRank rank(Lod lod) const;
  /// True where the level is what was asked for ("highest" is met by any).
  bool is_met_by(const LodRank& rank) const;
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool highest_ = false;
  bool any_minor_ = false;
  Lod lod_;
};

}  // namespace sunload
