// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Levels of detail of city models: which geometries of an object are read, so that none are
/// stacked.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "io/base/file_text.h"

namespace sunload {

/// Level of detail "major.minor"; a geometry that names none is below all others.
struct Lod {
  int major = -1;
  int minor = 0;

  friend bool operator==(const Lod&, const Lod&) = default;
  friend bool operator<(const Lod& a, const Lod& b) {
    return a.major != b.major ? a.major < b.major : a.minor < b.minor;
  }
};

/// Of "2" or "2.2"; none where it is anything else.
Lod lod_of(std::string_view text);

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

/// Whose geometry is read of a whole and its parts.
enum class WholeOrParts { both, whole, parts };

/// A whole and its parts at different levels would lie inside each other: the side with the better
/// one is read, and noted. With equal levels they complete each other. `parts` are not empty.
WholeOrParts unstacked(const LodRank& whole, std::span<const LodRank> parts, NoteCounter& notes);

}  // namespace sunload
