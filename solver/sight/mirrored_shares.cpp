// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/mirrored_shares.h"

#include <algorithm>
#include <array>
#include <optional>

#include "geo/mesh/box_tree.h"
#include "solver/base/threads.h"
#include "solver/sight/view_cut.h"

namespace sunload {

namespace {

/// Mirrors of one plane lie within this share of the offset before which nothing shades.
constexpr double flat_mirrors = 0.25;
/// Cosine below which light that grazes a patch brings none.
constexpr double least_cosine = 1e-6;
/// Of a patch's area: less is rounding.
constexpr double least_seen = 1e-9;
/// Groups that are asked together whether light comes near, such neighbours for a task of a thread,
/// and mirrored suns for which there is memory at a time.
constexpr std::size_t groups_together = 8, neighbours_per_task = 2, fewest_at_once = 16;

/// Planes of mirrors whose light may come near a place and what lies about it.
void find_near(const LitMirrors& mirrors, Vec3 centre, double radius_m,
               std::vector<const LitPlane*>& near) {
  near.clear();
  ViewBox point;
  point.include({dot(centre, mirrors.frame().x), dot(centre, mirrors.frame().y)});
  if (mirrors.box().is_apart_from(point, radius_m, radius_m)) return;
  for (const LitPlane& plane : mirrors.planes())
    if (plane.before().above(centre) > -radius_m &&
        !plane.box().is_apart_from(point, radius_m, radius_m))
      near.push_back(&plane);
}

}  // namespace

/// The patches of one group, which lie in a plane, in the light of one mirrored sun after the
/// other.
class MirroredShares::GroupWork {
 public:
  GroupWork(const MirroredShares& mirrored, Columns& out) : m_(mirrored), out_(out) {}

  /// `planes`: of the mirrors, those whose light may come near. Of sun k.
  void tell(const PlaneGroups::Group& group, const ViewFrame& frame,
            std::span<const LitPlane* const> planes, std::size_t k) {
    const double cos_theta = dot(group.normal, frame.to_sun);
    if (cos_theta <= least_cosine) return;
    const Vec3 lift = group.normal * m_.shares().offset_m();
    corners_.clear();
    ViewBox box;
    for (const Vec3& corner : m_.shares().groups().corners_of(group)) {
      const Vec3 p = corners_.emplace_back(corner + lift);
      box.include({dot(p, frame.x), dot(p, frame.y)});
    }
    group_ = &group;
    frame_ = &frame;
    patches_.clear();
    for (const LitPlane* plane : planes)
      if (!box.is_apart_from(plane->box(), 0, 0)) look_into(*plane);
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      float& of_patch = out_[m_.shares().groups().patches_of(group)[i] * block_width + k];
      const auto& [polygon, patch_box, area, light, is_told] = patches_[i];
      if (!is_told)
        of_patch = by_rays;
      else if (of_patch >= 0 && light > 0)
        of_patch += static_cast<float>(cos_theta * light / area);
    }
  }

 private:
  struct Patch {
    ViewPolygon polygon;
    ViewBox box;
    double area;
    double light;  ///< area that is lit, times reflectance
    bool is_told;
  };

  /// Light of a part of a mirror, as far as it meets the group.
  struct Falling {
    ViewPolygon polygon;
    ViewBox box;
    const LitPart* part;
  };

  /// The group by mirrors of one plane.
  void look_into(const LitPlane& plane) {
    FlatPolygon before(corners_);
    if (before.keep_before(plane.before()) == FlatPolygon::Kept::none) return;
    const ViewPolygon group = before.seen(*frame_);
    if (!group.has_area()) return;
    // What light would fall on the group, were nothing between.
    falling_.clear();
    ViewBox all;
    plane.visit(box_of(group), [&](const LitPart& part) {
      ViewPolygon light = part.polygon;
      if (!keep_within(light, group)) return doubt(box_of(part.polygon));
      if (!light.has_area()) return;
      const ViewBox box = box_of(light);
      all.include_box(box);
      falling_.push_back({light, box, &part});
    });
    if (falling_.empty()) return;
    find_shades(plane, all);
    see_patches();
    for (const Falling& light : falling_) shine(light);
  }
  void find_shades(const LitPlane& plane, const ViewBox& box) {
    const HalfSpace before{group_->normal, group_->plane_offset + m_.shares().offset_m()};
    shades_.clear();
    std::size_t count = 0;
    plane.shades().visit(box, [&](const FaceOutline& shade) {
      if (count == made_.size()) made_.emplace_back();
      const auto is_before = plane.shades().part_before(before, shade, made_[count]);
      if (is_before == MirrorShades::Before::all) shades_.push_back(&shade);
      if (is_before == MirrorShades::Before::part) ++count;
    });
    for (std::size_t i = 0; i < count; ++i) shades_.push_back(&made_[i]);
    std::sort(shades_.begin(), shades_.end(), LargestFirst());
  }
  void shine(const Falling& light) {
    cover_.clear();
    screens_.clear();
    for (const FaceOutline* shade : shades_)
      if (!shade->box.is_apart_from(light.box, 0, 0))
        (shade->is_solid ? cover_ : screens_).push_back(&shade->polygon);
    if (!area_.parts(light.polygon, cover_, lit_)) return doubt(light.box);
    for (const ViewPolygon& lit : lit_) {
      const ViewBox lit_box = box_of(lit);
      if (!light.part->is_certain || any_reaches_into(screens_, lit))
        doubt(lit_box);
      else
        for (Patch& patch : patches_)
          if (!patch.box.is_apart_from(lit_box, 0, 0)) add(lit, light.part->reflectance, patch);
    }
  }
  static void add(const ViewPolygon& lit, double reflectance, Patch& patch) {
    ViewPolygon common = lit;
    if (!keep_within(common, patch.polygon)) {
      patch.is_told = false;
      return;
    }
    const double area = common.area();
    if (area > least_seen * patch.area) patch.light += reflectance * area;
  }
  /// Rays must tell of the patches that may lie there.
  void doubt(const ViewBox& box) {
    see_patches();
    for (Patch& patch : patches_)
      if (!patch.box.is_apart_from(box, 0, 0)) patch.is_told = false;
  }
  void see_patches() {
    if (!patches_.empty()) return;
    const Hierarchy& mesh = m_.shares().hierarchy();
    const Vec3 lift = group_->normal * m_.shares().offset_m();
    for (const auto i : m_.shares().groups().patches_of(*group_)) {
      const std::array corners{mesh.corner(i, 0) + lift, mesh.corner(i, 1) + lift,
                               mesh.corner(i, 2) + lift};
      const ViewPolygon polygon = FlatPolygon(corners).seen(*frame_);
      patches_.push_back({polygon, box_of(polygon), polygon.area(), 0, true});
    }
  }

  const MirroredShares& m_;
  Columns& out_;
  LitArea area_;
  // The group and the mirrored sun at hand:
  const PlaneGroups::Group* group_ = nullptr;
  const ViewFrame* frame_ = nullptr;
  std::vector<Vec3> corners_;   ///< of the group, where rays of it start
  std::vector<Patch> patches_;  ///< once light comes near
  std::vector<Falling> falling_;
  std::vector<const FaceOutline*> shades_;
  std::vector<FaceOutline> made_;  ///< for some of them, and more room
  std::vector<const ViewPolygon*> cover_, screens_;
  std::vector<ViewPolygon> lit_;
};

MirroredShares::MirroredShares(const LitShares& shares, const MirrorGroups& groups)
    : shares_(shares),
      groups_(groups),
      planes_(groups, flat_mirrors * shares.offset_m()),
      tree_(shares.faces()) {
  find_neighbours();
}

void MirroredShares::find_neighbours() {
  const auto& groups = shares_.groups().all();
  for (std::size_t begin = 0; begin < groups.size(); begin += groups_together) {
    const std::size_t end = std::min(begin + groups_together, groups.size());
    Box box;
    for (std::size_t g = begin; g < end; ++g)
      for (const Vec3& corner : shares_.groups().corners_of(groups[g])) include(box, corner);
    neighbours_.push_back({begin, end, centre_of(box), norm(half_of(box)) + shares_.offset_m()});
  }
}

Columns MirroredShares::of(std::span<const IntervalLight> block,
                           std::span<const std::vector<MirroredSun>> by_mirrors) const {
  Columns light = columns(shares_.hierarchy().patch_count());
  struct Look {
    std::size_t k;
    const MirroredSun* sun;
  };
  std::vector<Look> all;
  for (std::size_t k = 0; k < by_mirrors.size(); ++k)
    for (const MirroredSun& sun : by_mirrors[k]) all.push_back({k, &sun});
  // What stands before mirrors takes memory: some of them at a time.
  const std::size_t at_once =
      std::max(fewest_at_once, 2 * static_cast<std::size_t>(thread_count()));
  for (std::size_t first = 0; first < all.size(); first += at_once) {
    std::vector<std::optional<LitMirrors>> lit(std::min(at_once, all.size() - first));
    parallel_for(lit.size(), [&](std::size_t i) {
      const auto [k, sun] = all[first + i];
      lit[i].emplace(groups_, planes_, tree_, shares_.offset_m(), *sun, block[k].direction);
    });
    parallel_chunks(
        neighbours_.size(), neighbours_per_task, [&](std::size_t begin, std::size_t end) {
          GroupWork work(*this, light);
          std::vector<const LitPlane*> near;
          for (std::size_t i = 0; i < lit.size(); ++i)
            for (std::size_t n = begin; n < end; ++n) {
              const Neighbours& of = neighbours_[n];
              find_near(*lit[i], of.centre, of.radius_m, near);
              if (near.empty()) continue;
              for (std::size_t g = of.begin; g < of.end; ++g)
                work.tell(shares_.groups().all()[g], lit[i]->frame(), near, all[first + i].k);
            }
        });
  }
  return light;
}

}  // namespace sunload
