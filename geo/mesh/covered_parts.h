// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which parts of a triangle are covered, and which are where another one is (geo/mesh/covered.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geo/mesh/covers.h"

namespace sunload {

/// Corners of parts that are nearer to each other than a contact by this are one.
inline constexpr double roundings_per_contact = 100;

/// What is said of a part of a triangle: `taken` is where another triangle is instead.
enum class CoverState : std::uint8_t { open, covered, taken };

/// A triangle that is a part of another, and whether it is covered.
struct TrianglePart {
  std::array<std::array<double, 3>, 3> corners;  ///< of new ones; the old ones are told by `old`
  std::array<std::int32_t, 3> old;               ///< vertex of the mesh, or -1
  CoverState state;
};

/// No parts: the triangle is `state` as a whole.
struct CoveredParts {
  CoverState state = CoverState::open;
  std::vector<TrianglePart> parts;
  std::optional<std::size_t> taken_by;  ///< the first of the triangles that are there instead
};

/// Of triangle `t`. Where more lines meet on it than can be looked at together it is halved at its
/// longest edge, again and again; pieces of 1/65536 of it are told by their middles. Throws
/// InputError as `Covers::visit_near` does. Cost: the square of the lines on a piece, some
/// microseconds for single ones.
CoveredParts covered_parts(const Mesh& mesh, const Covers& covers, std::size_t t);

}  // namespace sunload
