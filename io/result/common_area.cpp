// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/common_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/overlap.h"

namespace sunload {

namespace {

/// Planes that are so near are the same [m]: coordinates of results are rounded.
constexpr double same_plane_m = 1e-3;
/// … and so parallel: 0.06 degrees.
constexpr double least_cosine = 1 - 5e-7;
/// Less of a patch is rounding.
constexpr double rounding_share = 1e-3;

struct Triangle {
  std::array<Vec3, 3> corner;  ///< counter-clockwise from the patch's own side
  Vec3 normal;
};

struct Patches {
  std::vector<Triangle> triangle;
  std::vector<double> area;
  std::vector<std::string> object;  ///< name of each patch's object
};

Patches patches_of(const ResultReader& result) {
  const auto position = result.doubles("vertex_position");
  const auto vertices = result.integers("patch_vertices");
  const auto object = result.integers("patch_object");
  const auto names = result.strings("object_name");
  Patches patches;
  patches.area = result.doubles("patch_area");
  const Vec3 origin = result.origin();
  for (std::size_t p = 0; p < patches.area.size(); ++p) {
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(vertices[3 * p + k]);
      t.corner[k] = origin + Vec3{position[3 * v], position[3 * v + 1], position[3 * v + 2]};
    }
    t.normal = normalized(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]));
    patches.triangle.push_back(t);
    patches.object.push_back(names.at(static_cast<std::size_t>(object[p])));
  }
  return patches;
}

bool are_same_mesh(const ResultReader& base, const ResultReader& variant) {
  return base.origin() == variant.origin() &&
         base.doubles("vertex_position") == variant.doubles("vertex_position") &&
         base.integers("patch_vertices") == variant.integers("patch_vertices") &&
         base.integers("patch_object") == variant.integers("patch_object") &&
         base.strings("object_name") == variant.strings("object_name");
}

bool lie_in_one_plane(const Triangle& a, const Triangle& b) {
  if (dot(a.normal, b.normal) < least_cosine) return false;
  return std::all_of(b.corner.begin(), b.corner.end(), [&](Vec3 corner) {
    return std::abs(dot(a.normal, corner - a.corner[0])) <= same_plane_m;
  });
}

/// All of a patch or nothing of it where rounding alone is missing.
double without_rounding(double common, double area) {
  if (common >= (1 - rounding_share) * area) return area;
  return common <= rounding_share * area ? 0 : common;
}

}  // namespace

PatchOverlaps patch_overlaps(const ResultReader& base, const ResultReader& variant) {
  PatchOverlaps overlaps{{}, base.doubles("patch_area"), variant.doubles("patch_area")};
  overlaps.of_base.resize(overlaps.base_area.size());
  if (are_same_mesh(base, variant)) {
    for (std::size_t p = 0; p < overlaps.of_base.size(); ++p)
      overlaps.of_base[p] = {{p, overlaps.base_area[p]}};
    return overlaps;
  }
  const Patches own = patches_of(base), theirs = patches_of(variant);
  std::vector<Box> boxes;
  for (const Triangle& t : own.triangle)
    boxes.push_back(widened(box_around({t.corner[0], t.corner[1], t.corner[2]}), same_plane_m));
  const BoxTree tree(std::move(boxes));
  for (std::size_t v = 0; v < theirs.area.size(); ++v) {
    const Triangle& t = theirs.triangle[v];
    std::vector<std::size_t> near;
    tree.visit_meeting(box_around({t.corner[0], t.corner[1], t.corner[2]}), [&](std::size_t b) {
      if (own.object[b] == theirs.object[v] && lie_in_one_plane(own.triangle[b], t))
        near.push_back(b);
    });
    std::sort(near.begin(), near.end());  // sums have an order
    for (const std::size_t b : near)
      overlaps.of_base[b].push_back(
          {v, overlap_m2(own.triangle[b].corner, own.triangle[b].normal, t.corner)});
  }
  return overlaps;
}

namespace {

bool counts(const std::vector<char>& patches, std::size_t p) {
  return patches.empty() || patches[p] != 0;
}

}  // namespace

CommonArea common_area(const ResultReader& base, const ResultReader& variant,
                       const CountedPatches& counted) {
  const PatchOverlaps overlaps = patch_overlaps(base, variant);
  const auto &own = overlaps.base_area, &theirs = overlaps.variant_area;
  CommonArea common{std::vector<double>(own.size(), 0), std::vector<double>(theirs.size(), 0)};
  for (std::size_t b = 0; b < own.size(); ++b)
    for (const auto& [v, area] : overlaps.of_base[b]) {
      if (!counts(counted.base, b) || !counts(counted.variant, v)) continue;
      common.base[b] += area;
      common.variant[v] += area;
    }
  for (std::size_t b = 0; b < own.size(); ++b)
    common.base[b] = without_rounding(common.base[b], own[b]);
  for (std::size_t v = 0; v < theirs.size(); ++v)
    common.variant[v] = without_rounding(common.variant[v], theirs[v]);
  return common;
}

Tiles tiles_of(const PatchOverlaps& overlaps) {
  const std::size_t own = overlaps.base_area.size(), all = own + overlaps.variant_area.size();
  std::vector<std::size_t> parent(all);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  };
  for (std::size_t b = 0; b < own; ++b)
    for (const auto& [v, area] : overlaps.of_base[b])
      if (area > rounding_share * std::min(overlaps.base_area[b], overlaps.variant_area[v]))
        parent[root(own + v)] = root(b);
  Tiles tiles;
  std::vector<std::size_t> number(all);
  for (std::size_t p = 0; p < all; ++p)
    if (parent[p] == p) number[p] = tiles.count++;
  for (std::size_t p = 0; p < all; ++p)
    (p < own ? tiles.of_base : tiles.of_variant).push_back(number[root(p)]);
  return tiles;
}

namespace {

/// Sums of area in common by patch and name.
std::vector<PatchMember> summed(std::vector<PatchMember> parts,
                                const std::vector<double>& area_of_patch) {
  std::stable_sort(parts.begin(), parts.end(), [](const PatchMember& a, const PatchMember& b) {
    return std::pair(a.patch, a.name) < std::pair(b.patch, b.name);
  });
  std::vector<PatchMember> sums;
  for (const PatchMember& part : parts)
    if (!sums.empty() && sums.back().patch == part.patch && sums.back().name == part.name)
      sums.back().area_m2 += part.area_m2;
    else
      sums.push_back(part);
  for (PatchMember& sum : sums)
    sum.area_m2 = without_rounding(sum.area_m2, area_of_patch[sum.patch]);
  std::erase_if(sums, [](const PatchMember& sum) { return !(sum.area_m2 > 0); });
  return sums;
}

/// Of each tile by how many patches more the base cuts it.
std::vector<std::ptrdiff_t> more_in_base(const Tiles& tiles) {
  std::vector<std::ptrdiff_t> more(tiles.count, 0);
  for (const auto tile : tiles.of_base) ++more[tile];
  for (const auto tile : tiles.of_variant) --more[tile];
  return more;
}

/// Names of the variant's division as those of the base's; -1: unknown there.
std::vector<std::int32_t> as_of_base(const PatchDivision& of_base,
                                     const PatchDivision& of_variant) {
  std::unordered_map<std::string, std::int32_t> number;
  for (std::size_t e = 0; e < of_base.names.size(); ++e)
    number.emplace(of_base.names[e], static_cast<std::int32_t>(e));
  std::vector<std::int32_t> of_patch;
  of_patch.reserve(of_variant.of_patch.size());
  std::vector<std::int32_t> in_base;
  for (const auto& name : of_variant.names) {
    const auto found = number.find(name);
    in_base.push_back(found == number.end() ? -1 : found->second);
  }
  for (const auto entry : of_variant.of_patch)
    of_patch.push_back(entry < 0 ? -1 : in_base[static_cast<std::size_t>(entry)]);
  return of_patch;
}

/// Whether any patch of the other result on one is of the same name: [patch] of base and variant.
struct Agreed {
  std::vector<char> base, variant;
};

Agreed agreed(const PatchOverlaps& overlaps, const std::vector<std::int32_t>& own,
              const std::vector<std::int32_t>& theirs) {
  Agreed any{std::vector<char>(own.size(), 0), std::vector<char>(theirs.size(), 0)};
  for (std::size_t b = 0; b < own.size(); ++b)
    for (const auto& [v, area] : overlaps.of_base[b])
      if (own[b] == theirs[v] &&
          area > rounding_share * std::min(overlaps.base_area[b], overlaps.variant_area[v]))
        any.base[b] = any.variant[v] = 1;
  return any;
}

}  // namespace

CommonMembers common_members(const PatchOverlaps& overlaps, const Tiles& tiles,
                             const CountedPatches& counted, const PatchDivision& of_base,
                             const PatchDivision& of_variant) {
  CommonMembers common{{of_base.kind, of_base.names, {}}, {of_base.kind, of_base.names, {}}};
  const std::vector<std::int32_t>& own = of_base.of_patch;
  const std::vector<std::int32_t> theirs = as_of_base(of_base, of_variant);
  const bool is_by_middle = of_base.kind == "selection" || of_base.kind == "storey";
  const auto more = more_in_base(tiles);
  const Agreed any = agreed(overlaps, own, theirs);
  const auto name_of = [&](std::size_t b, std::size_t v) {
    const std::ptrdiff_t finer_base = more[tiles.of_base[b]];
    if (!is_by_middle || finer_base == 0) return own[b] == theirs[v] ? own[b] : -1;
    if (finer_base > 0) return any.variant[v] != 0 ? theirs[v] : -1;
    return any.base[b] != 0 ? own[b] : -1;
  };
  std::vector<PatchMember> base, variant;
  for (std::size_t b = 0; b < overlaps.of_base.size(); ++b)
    for (const auto& [v, area] : overlaps.of_base[b]) {
      if (!counts(counted.base, b) || !counts(counted.variant, v)) continue;
      const std::int32_t name = name_of(b, v);
      if (name < 0) continue;
      base.push_back({b, static_cast<std::size_t>(name), area});
      variant.push_back({v, static_cast<std::size_t>(name), area});
    }
  common.base.members = summed(std::move(base), overlaps.base_area);
  common.variant.members = summed(std::move(variant), overlaps.variant_area);
  return common;
}

std::vector<double> means_on_base(const PatchOverlaps& overlaps,
                                  const std::vector<double>& of_variant) {
  std::vector<double> means(overlaps.of_base.size(), std::nan(""));
  for (std::size_t b = 0; b < means.size(); ++b) {
    const bool is_one = overlaps.of_base[b].size() == 1;  // whose value it is, without rounding
    double sum = 0, area = 0;
    for (const auto& [v, common] : overlaps.of_base[b]) {
      sum += common * of_variant[v];
      area += common;
    }
    if (area >= (1 - rounding_share) * overlaps.base_area[b])
      means[b] = is_one ? of_variant[overlaps.of_base[b].front().patch] : sum / area;
  }
  return means;
}

}  // namespace sunload
