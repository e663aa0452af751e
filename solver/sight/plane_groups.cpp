// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/plane_groups.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geo/base/check.h"

namespace sunload {

namespace {

/// Patches that are looked at together, at most.
constexpr std::size_t most_patches = 32;
/// They lie in one plane, and within the outline, but for that: well below the offset before which
/// nothing shades [m]; and so much their normals, and the cosine that light is told by, differ.
constexpr double rounding_m = 1e-6, same_normal = 1e-6;

using Corners = std::array<std::int32_t, 3>;

/// The triangle whose halves these are: two corners are common, one of them in the middle.
Corners whole_of(const Hierarchy& h, const Corners& a, const Corners& b) {
  const auto in = [](const Corners& corners, std::int32_t vertex) {
    return std::find(corners.begin(), corners.end(), vertex) != corners.end();
  };
  const auto at = [&](std::int32_t vertex) {
    return h.vertices()[static_cast<std::size_t>(vertex)];
  };
  std::int32_t end_a = -1, end_b = -1;
  std::array<std::int32_t, 3> common{-1, -1, -1};
  std::size_t commons = 0;
  for (const auto vertex : a) in(b, vertex) ? common[commons++] = vertex : end_a = vertex;
  for (const auto vertex : b)
    if (!in(a, vertex)) end_b = vertex;
  SUNLOAD_EXPECT(commons == 2 && end_a >= 0 && end_b >= 0, "halves of a triangle share an edge");
  const Vec3 middle = (at(end_a) + at(end_b)) * 0.5;
  const bool first = norm(at(common[0]) - middle) <= norm(at(common[1]) - middle);
  return {end_a, end_b, common[first ? 1 : 0]};
}

/// An element of the mesh whose patches are looked at together, alone or with others of its face.
struct SmallElement {
  std::uint32_t element;
  std::uint32_t a_patch;  ///< of it
  std::uint32_t face;     ///< of SunFaces; none: it is of no opaque one
  bool is_before;         ///< on the side to which the face's normal points
  bool sends_on;

  auto kind() const { return std::tuple(face, is_before, sends_on); }
};

/// The elements of a mesh, and what is known of all of them.
class Elements {
 public:
  explicit Elements(const Hierarchy& hierarchy)
      : h_(hierarchy),
        patches_in_(h_.element_count(), 1),
        triangle_(h_.element_count()),
        corners_(h_.element_count()) {
    const std::size_t patches = h_.patch_count();
    for (std::size_t e = 0; e < patches; ++e) {
      corners_[e] = h_.patches()[e].vertices;
      triangle_[e] = h_.patches()[e].triangle;
    }
    for (std::size_t e = patches; e < h_.element_count(); ++e) {
      const auto [a, b] = h_.halves_of(e - patches);
      patches_in_[e] = patches_in_[a] + patches_in_[b];
      triangle_[e] = triangle_[a];
      corners_[e] = whole_of(h_, corners_[a], corners_[b]);
    }
  }
  std::size_t patches_in(std::size_t element) const { return patches_in_[element]; }
  Vec3 corner(std::size_t element, std::size_t k) const {
    return h_.vertices()[static_cast<std::size_t>(corners_[element][k])];
  }
  Vec3 normal(const SmallElement& small) const { return h_.normal(small.a_patch); }

  /// The largest that have no more patches than a group may have.
  std::vector<SmallElement> small_ones(const Scene& scene, const SunFaces& faces) const {
    std::vector<SmallElement> small;
    for (std::size_t e = 0; e < h_.element_count(); ++e) {
      const auto parent = h_.parent(e);
      const bool is_part =
          parent >= 0 && patches_in_[static_cast<std::size_t>(parent)] <= most_patches;
      if (patches_in_[e] > most_patches || is_part) continue;
      std::size_t patch = e;
      while (patch >= h_.patch_count()) patch = h_.halves_of(patch - h_.patch_count())[0];
      const std::uint32_t face = faces.of_triangle(static_cast<std::size_t>(triangle_[e]));
      small.push_back({static_cast<std::uint32_t>(e), static_cast<std::uint32_t>(patch), face,
                       face != SunFaces::none && dot(h_.normal(patch), faces.normal(face)) > 0,
                       sends_on(scene.material_of(triangle_[e]))});
    }
    return small;
  }
  void append_patches(std::uint32_t element, std::vector<std::uint32_t>& patches) const {
    if (element < h_.patch_count()) return patches.push_back(element);
    for (const auto half : h_.halves_of(element - h_.patch_count())) append_patches(half, patches);
  }

 private:
  const Hierarchy& h_;
  std::vector<std::size_t> patches_in_;
  std::vector<std::int32_t> triangle_;
  std::vector<Corners> corners_;
};

/// Whether a point lies in a polygon whose corners turn about the normal.
bool is_within(std::span<const Vec3> corners, Vec3 normal, Vec3 p) {
  if (std::abs(dot(normal, p - corners[0])) > rounding_m) return false;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 from = corners[k], along = corners[(k + 1) % corners.size()] - from;
    if (dot(cross(along, p - from), normal) < -rounding_m * norm(along)) return false;
  }
  return true;
}

/// Whether elements of one face and side may be looked at together, within its outline.
bool may_be_together(std::span<const SmallElement> alike, const Elements& elements,
                     const SunFaces& faces) {
  const std::uint32_t face = alike.front().face;
  if (alike.size() == 1 || face == SunFaces::none ||
      faces.corners(face).size() > PlaneGroups::most_corners)
    return false;
  std::size_t patches = 0;
  for (const SmallElement& small : alike) patches += elements.patches_in(small.element);
  if (patches > most_patches) return false;
  const Vec3 normal = elements.normal(alike.front());
  return std::all_of(alike.begin(), alike.end(), [&](const SmallElement& small) {
    if (norm(elements.normal(small) - normal) > same_normal) return false;
    for (std::size_t k = 0; k < 3; ++k)
      if (!is_within(faces.corners(face), faces.normal(face), elements.corner(small.element, k)))
        return false;
    return true;
  });
}

}  // namespace

PlaneGroups::PlaneGroups(const Scene& scene, const Hierarchy& hierarchy, const SunFaces& faces) {
  const Elements elements(hierarchy);
  const auto add_group = [&](std::span<const SmallElement> of, std::span<const Vec3> corners) {
    const std::size_t first = patch_.size();
    for (const SmallElement& small : of) elements.append_patches(small.element, patch_);
    const Vec3 normal = elements.normal(of.front());
    groups_.push_back({first, patch_.size() - first, static_cast<std::uint32_t>(corner_.size()),
                       static_cast<std::uint32_t>(corners.size()), of.front().sends_on, normal,
                       dot(normal, hierarchy.corner(patch_[first], 0))});
    corner_.insert(corner_.end(), corners.begin(), corners.end());
  };
  std::vector<SmallElement> all = elements.small_ones(scene, faces);
  std::stable_sort(all.begin(), all.end(), [](const SmallElement& a, const SmallElement& b) {
    return a.kind() < b.kind();
  });
  for (std::span<const SmallElement> left = all; !left.empty();) {
    const auto is_other = [&](const SmallElement& small) {
      return small.kind() != left.front().kind();
    };
    const auto end = std::find_if(left.begin(), left.end(), is_other);
    const auto alike = left.first(static_cast<std::size_t>(end - left.begin()));
    if (may_be_together(alike, elements, faces))
      add_group(alike, faces.corners(alike.front().face));
    else
      for (const SmallElement& small : alike)
        add_group(std::span(&small, 1),
                  std::array{elements.corner(small.element, 0), elements.corner(small.element, 1),
                             elements.corner(small.element, 2)});
    left = left.subspan(alike.size());
  }
  std::sort(groups_.begin(), groups_.end(),
            [&](const Group& a, const Group& b) { return patch_[a.first] < patch_[b.first]; });
}

}  // namespace sunload
