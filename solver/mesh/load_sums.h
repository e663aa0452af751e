// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What refinement makes of a pilot's estimates: how far the light load on leaves of a kind is from
/// constant, and which leaves to split so that it comes nearer.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace sunload {

/// Kinds of surface whose light is resolved each for its own sake; glints on all of them.
enum class MeshKind { wall, roof, near_ground, ground, other, glints };
inline constexpr std::array<const char*, 6> mesh_kind_names{
    "walls", "roofs", "ground near walls", "ground beyond", "others", "glints"};
inline constexpr std::size_t mesh_kinds = mesh_kind_names.size();
inline constexpr auto mesh_kind_glints = static_cast<std::size_t>(MeshKind::glints);
/// Per kind, shares of its mean.
using KindErrors = std::array<double, mesh_kinds>;

/// Where a leaf is: what does not depend on light.
struct LeafPlace {
  std::size_t kind = 0;
  double weighted_m2 = 0;     ///< area of one side by its weight
  bool can_be_split = false;  ///< its area allows that
  double stands_for = 1;      ///< leaves: itself, and others that are not looked at
};

/// What a pilot says of one leaf, both sides together; squares, power and area by the leaf's
/// weight.
struct LoadEstimate {
  double squared_error = 0;        ///< ∫ (H - mean H)² dA [J2 m-2]
  double power = 0;                ///< ∫ H dA [J]
  double area_m2 = 0;              ///< of the sides that have patches
  double glint_squared_error = 0;  ///< of the light by mirrors alone
  double glint_squares = 0;        ///< ∫ H² dA of it
};

/// Sums over leaves of one pilot, by their kinds.
class LoadSums {
 public:
  /// `places` and `estimates`: per element; both must outlive it.
  LoadSums(std::span<const LeafPlace> places, std::span<const LoadEstimate> estimates,
           double light_tolerance)
      : places_(places), estimates_(estimates), tolerance_(light_tolerance) {}

  /// Root mean square of H - mean H over the leaves, as share of the mean of H; of glints a part
  /// of it, so that all have one tolerance.
  KindErrors errors(std::span<const std::size_t> leaves) const;

  /// Appends the fewest of the leaves that together make up half of what splitting can lower of a
  /// kind's error (Dörfler 1996, with θ² = 1/2); none where that is too little of the whole to be
  /// worth it.
  void mark(std::size_t kind, std::span<const std::size_t> leaves,
            std::vector<std::size_t>& marked) const;

 private:
  double visible_load(std::span<const std::size_t> leaves) const;

  std::span<const LeafPlace> places_;
  std::span<const LoadEstimate> estimates_;
  double tolerance_;
};

}  // namespace sunload
