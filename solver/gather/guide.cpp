// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/guide.h"

#include <algorithm>

#include "geo/base/keys.h"
#include "solver/base/rng.h"
#include "solver/base/threads.h"
#include "solver/lines/patch_lines.h"

namespace sunload {

namespace {

constexpr int looks = 2;
/// Of the lines of the result, for each look; and what is spent on what sees what.
constexpr int lines_share = 8;
constexpr int fewest_lines = 32;
constexpr double least_rays = 1.6e7;  ///< some tenths of a second
/// Each costs a patch about a hundredth of a line.
constexpr int fewest_clusters = 256, most_clusters = 4096;

std::size_t clusters_for(int lines_per_patch) {
  return static_cast<std::size_t>(std::clamp(lines_per_patch, fewest_clusters, most_clusters));
}

std::vector<double> emission_of(const PatchOptics& optics) {
  return {optics.emission.begin(), optics.emission.end()};
}

LineRules rules_of_look(LineRules rules, int look) {
  rules.lines_per_patch = std::max(fewest_lines, rules.lines_per_patch / lines_share);
  rules.lines_of_patch.clear();
  rules.realizations = 1;
  rules.largest_link = 0;
  rules.seed = mixed(mixed(rules.seed, static_cast<std::uint64_t>(Purpose::bright_surfaces)),
                     static_cast<std::uint64_t>(look));
  return rules;
}

/// Exitance and what the patches reflect of the light that these lines bring from emitters.
std::vector<double> radiosity_by(const LineSet& lines, const Hierarchy& hierarchy,
                                 const PatchOptics& optics, int bounces) {
  const std::vector<double> no_ground(hierarchy.patch_count(), 0);
  const auto reflected = reflect(hierarchy, lines, optics, lines.lamps, no_ground, bounces);
  std::vector<double> radiosity = emission_of(optics);
  for (std::size_t i = 0; i < radiosity.size(); ++i)
    radiosity[i] +=
        static_cast<double>(optics.diffuse[i]) * (lines.lamps[i] + reflected.irradiance[i]);
  return radiosity;
}

/// Moments of what one line and one point bring, by estimated radiosity B' and share
/// s = g / (g + q); each is a mean over lines plus a mean over points.
struct Moments {
  double squares = 0;         ///< ∫ g V B'²        from s B'²
  double shared_squares = 0;  ///< ∫ g V s B'²      from s² B'²
  double by_lines = 0;        ///< ∫ g V s B'
  double by_points = 0;       ///< ∫ q V s B'
  void add(double radiosity, double share) {
    squares += share * radiosity * radiosity;
    shared_squares += share * share * radiosity * radiosity;
  }
  /// The β of least variance of β L + (1 - β) G, with the lines' estimate L and the shared one G:
  /// from Var L = ∫gVB'² - m², Var G = ∫gVsB'² - m_l² - m_p², Cov = ∫gVsB'² - m m_l, m = m_l + m_p.
  /// These are variances of independent lines. Low-discrepancy lines spread far better over what
  /// fills a good part of the view, and of a closed room they lose no light: they keep all where
  /// the view is no less even than one that is half bright and half dark.
  float best_share_of_lines() const {
    const double m = by_lines + by_points;
    if (squares - m * m <= m * m) return 1;
    const double gain = by_points * (by_lines - by_points);
    const double spread = squares - shared_squares - 2 * by_points * by_points;
    constexpr double all_but_one = 0.98;
    if (gain <= 0) return 0;
    if (gain >= all_but_one * spread) return 1;
    return static_cast<float>(gain / spread);
  }
};

/// What `count` lines and points of a patch tell of the two estimates.
Moments moments_of(const Hierarchy& hierarchy, const RayCaster& caster, const Guide& guide,
                   const BrightView& view, std::size_t patch, std::size_t count,
                   std::uint64_t seed) {
  const PatchLines lines(hierarchy, patch, caster.offset_m(),
                         line_seeds(hierarchy, patch, 0, seed));
  const Vec3 normal = hierarchy.normal(patch);
  const auto radiosity = [&](std::int32_t seen) {
    const BrightSource* source =
        seen < 0 ? nullptr : guide.surfaces.source_of(static_cast<std::size_t>(seen));
    return source ? source->radiosity : 0.0;
  };
  Moments sum;
  for (std::size_t first = 0; first < count; first += packet_size) {
    const LinePacket packet(lines, first, count);
    const auto hits = packet.first_hits(caster);
    for (std::size_t l = 0; l < packet.count; ++l) {
      const Hit hit = hits[l];
      if (hit.left_scene()) continue;
      const Vec3 w = packet.line[l].w;
      const double B = radiosity(hierarchy.patch_at(hit.triangle, hit.u, hit.v, hit.front));
      const double share = view.share_of_line(hierarchy, hit, w, dot(w, normal));
      sum.add(B, share);
      sum.by_lines += share * B;
    }
  }
  const auto seeds = random_words(
      {.seed = seed, .purpose = Purpose::bright_surfaces, .element = hierarchy.key()[patch]});
  view.see_points(caster, seeds, count, [&](const BrightView::SeenPoint& point) {
    const double B = radiosity(static_cast<std::int32_t>(point.patch));
    sum.add(B, point.share);
    sum.by_points += point.share * B;
  });
  const auto n = static_cast<double>(count);
  return {sum.squares / n, sum.shared_squares / n, sum.by_lines / n, sum.by_points / n};
}

std::vector<float> shares_of_lines(const Hierarchy& hierarchy, const RayCaster& caster,
                                   const Guide& guide, const LineRules& rules) {
  std::vector<float> shares(hierarchy.patch_count());
  constexpr std::size_t patches_per_task = 256;
  parallel_chunks(shares.size(), patches_per_task, [&](std::size_t begin, std::size_t end) {
    BrightView view(guide);
    for (std::size_t i = begin; i < end; ++i) {
      view.look_from(hierarchy, i);
      shares[i] = moments_of(hierarchy, caster, guide, view, i,
                             static_cast<std::size_t>(rules.lines_per_patch), rules.seed)
                      .best_share_of_lines();
    }
  });
  return shares;
}

}  // namespace

Guide emitting_surfaces(const Scene& scene, const Hierarchy& hierarchy, const PatchOptics& optics) {
  return {{scene, hierarchy, emission_of(optics), fewest_clusters}, {}, {}};
}

Guide lit_surfaces(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                   const SkyGrid& grid, const PatchOptics& optics, const LineRules& rules,
                   int bounces) {
  Watch silent;
  const double rays = std::max(least_rays, static_cast<double>(hierarchy.patch_count()) *
                                               rules.lines_per_patch / lines_share);
  const auto guide_to = [&](std::span<const double> radiosity) {
    BrightSurfaces bright(scene, hierarchy, radiosity, clusters_for(rules.lines_per_patch));
    ClusterSight sight(scene, hierarchy, caster, bright, rays, rules.seed);
    return Guide{std::move(bright), std::move(sight), {}};
  };
  Guide guide = guide_to(emission_of(optics));
  for (int look = 0; look < looks && guide.any(); ++look) {
    const Lines lines =
        trace_lines(scene, hierarchy, caster, grid, guide, rules_of_look(rules, look), silent);
    guide = guide_to(radiosity_by(lines.pooled, hierarchy, optics, bounces));
  }
  if (guide.any())
    guide.lines_alone = shares_of_lines(hierarchy, caster, guide, rules_of_look(rules, looks));
  return guide;
}

}  // namespace sunload
