// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/bright_view.h"

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "solver/base/sampling.h"
#include "solver/mesh/point_pairs.h"

namespace sunload {

namespace {

/// Of points: to what the patch's own group sees, and the groups around; the others go to what
/// faces the patch.
constexpr double share_to_seen = 0.7, share_to_seen_around = 0.2;

}  // namespace

BrightView::BrightView(const Guide& guide)
    : surfaces_(guide.surfaces),
      sight_(guide.sight),
      lines_alone_(guide.lines_alone),
      chance_(guide.surfaces.clusters().size()),
      up_to_(chance_.size()) {}

/// Not normalised; 0 where no point of the patch and none of the cluster see each other's front.
double BrightView::chance(const BrightCluster& cluster) const {
  const Vec3 way = cluster.centre - centroid_;
  if (dot(normal_, way) + cluster.reach(normal_) <= 0) return 0;
  const double cosine = dot(normal_, cluster.normal);
  const double own_reach = radius_ * std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const bool faces_one_way = dot(cluster.normal, cluster.normal) > 0;
  if (faces_one_way && dot(cluster.normal, way) - own_reach - cluster.thickness >= 0) return 0;
  const double radii = radius_ + cluster.radius;
  return cluster.power / (dot(way, way) + radii * radii);
}

void BrightView::look_from(const Hierarchy& hierarchy, std::size_t patch) {
  a_ = hierarchy.corner(patch, 0);
  ab_ = hierarchy.corner(patch, 1) - a_;
  ac_ = hierarchy.corner(patch, 2) - a_;
  normal_ = hierarchy.normal(patch);
  centroid_ = hierarchy.centroid(patch);
  radius_ = 0;
  for (std::size_t k = 0; k < 3; ++k)
    radius_ = std::max(radius_, norm(hierarchy.corner(patch, k) - centroid_));
  alone_ = lines_alone_.empty() ? 0 : static_cast<double>(lines_alone_[patch]);
  if (alone_ < 1) choose_clusters(sight_.row(patch));
}

void BrightView::look_from(Vec3 position, Vec3 normal) {
  a_ = centroid_ = position;
  ab_ = ac_ = {0, 0, 0};
  normal_ = normal;
  radius_ = alone_ = 0;
  choose_clusters(nullptr);
}

void BrightView::choose_clusters(const ClusterSight::Share* shares) {
  constexpr ClusterSight::Share unknown{0, 0, 1};
  const auto share = [&](std::size_t c) { return shares ? shares[c] : unknown; };
  double seen = 0, around = 0, facing = 0;
  for (std::size_t c = 0; c < chance_.size(); ++c) {
    chance_[c] = chance(surfaces_.clusters()[c]);
    seen += chance_[c] * static_cast<double>(share(c).seen);
    around += chance_[c] * static_cast<double>(share(c).around);
    facing += chance_[c] * static_cast<double>(share(c).facing);
  }
  const double by_seen = seen > 0 ? share_to_seen / seen : 0;
  const double by_around = around > 0 ? share_to_seen_around / around : 0;
  const double by_facing = facing > 0 ? (1 - by_seen * seen - by_around * around) / facing : 0;
  double sum = 0;
  for (std::size_t c = 0; c < chance_.size(); ++c) {
    chance_[c] *= by_seen * static_cast<double>(share(c).seen) +
                  by_around * static_cast<double>(share(c).around) +
                  by_facing * static_cast<double>(share(c).facing);
    sum += chance_[c];
    up_to_[c] = sum;
  }
}

/// Of points drawn on a source [m-2].
double BrightView::density(const BrightSource& source) const {
  return chance_[source.cluster] * source.radiosity / surfaces_.clusters()[source.cluster].power;
}

BrightSurfaces::Point BrightView::point(double u, double v) const {
  const auto c = std::min(
      static_cast<std::size_t>(std::upper_bound(up_to_.begin(), up_to_.end(), u) - up_to_.begin()),
      up_to_.size() - 1);
  constexpr double below_one = 1 - 0x1p-53;
  const double rest = std::clamp((u - (up_to_[c] - chance_[c])) / chance_[c], 0.0, below_one);
  return surfaces_.point(c, rest, v);
}

double BrightView::share_of_line(const Hierarchy& hierarchy, const Hit& hit, Vec3 w,
                                 double cos_theta) const {
  if (!any() || alone_ >= 1 || hit.left_scene()) return 1;
  const auto patch = hierarchy.patch_at(hit.triangle, hit.u, hit.v, hit.front);
  if (patch < 0) return 1;
  const BrightSource* source = surfaces_.source_of(static_cast<std::size_t>(patch));
  if (!source) return 1;
  // g / (g + q) without dividing by the distance, which may be all but 0.
  const double g = cos_theta * std::max(0.0, -dot(w, source->normal));
  const double q = pi * hit.distance_m * hit.distance_m * density(*source);
  return g + q > 0 ? alone_ + (1 - alone_) * g / (g + q) : 1;
}

std::uint64_t BrightView::see_points(const RayCaster& caster, const RandomWords& seeds,
                                     std::size_t count,
                                     const std::function<void(const SeenPoint&)>& visit) const {
  if (alone_ >= 1 || up_to_.empty() || up_to_.back() <= 0) return 0;
  std::uint64_t rays = 0;
  const Vec3 lift = normal_ * caster.offset_m();
  for (std::size_t first = 0; first < count; first += packet_size) {
    PointPairs pairs(caster);
    SeenPoint point_of_pair[packet_size];
    for (std::size_t l = 0; l < std::min(packet_size, count - first); ++l) {
      const auto index = static_cast<std::uint32_t>(first + l);
      const Barycentric at =
          sample_triangle(scrambled_sobol(index, 0, seeds), scrambled_sobol(index, 1, seeds));
      const Vec3 x = a_ + at.w1 * ab_ + at.w2 * ac_ + lift;
      const auto y = point(scrambled_sobol(index, 2, seeds), scrambled_sobol(index, 3, seeds));
      const auto facing = pairs.take(l, {x, normal_}, {y.position, y.normal});
      if (!facing) continue;
      const double g = facing->cosines_m2 / (pi * facing->distance_2 * facing->distance_2);
      point_of_pair[l] = {y.source->patch, y.position, std::sqrt(facing->distance_2),
                          (1 - alone_) * g / (g + density(*y.source)), y.source->exitance};
    }
    rays += pairs.count();
    pairs.for_each_seen([&](std::size_t l) { visit(point_of_pair[l]); });
  }
  return rays;
}

}  // namespace sunload
