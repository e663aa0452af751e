// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/parallel_beams.h"

#include <algorithm>

namespace sunload {

namespace {

// Triangles whose normals differ by less than this make one beam: what rounding does to the
// normals of a flat sheet.
constexpr double same_direction = 1e-6;

}  // namespace

ParallelBeams::Beam::Beam(const ParallelSources& sources, Vec3 along,
                          const std::vector<std::int32_t>& triangles)
    : to_source_(-along), axes_(tangents(along)) {
  for (const auto t : triangles) {
    const auto i = static_cast<std::size_t>(t);
    Source source{{}, dot(sources.mesh.corner(i, 0), to_source_), sources.exitance[i]};
    for (int k = 0; k < 3; ++k)
      source.corner[static_cast<std::size_t>(k)] = flat(sources.mesh.corner(i, k));
    sources_.push_back(source);
  }
}

std::vector<std::size_t> ParallelBeams::Beam::before(Vec3 a, Vec3 b, Vec3 c) const {
  std::vector<std::size_t> chosen;
  const std::array<Flat, 3> p{flat(a), flat(b), flat(c)};
  const double nearest = std::min({dot(a, to_source_), dot(b, to_source_), dot(c, to_source_)});
  for (std::size_t s = 0; s < sources_.size(); ++s)
    if (sources_[s].depth > nearest && may_overlap(p, sources_[s].corner)) chosen.push_back(s);
  return chosen;
}

double ParallelBeams::Beam::way(std::size_t s, Vec3 x) const {
  const Source& source = sources_[s];
  const double way = source.depth - dot(x, to_source_);
  const Flat p = flat(x);
  const auto& [a, b, c] = source.corner;
  const bool inside = is_left(a, b, p) && is_left(b, c, p) && is_left(c, a, p);
  return way > 0 && inside ? way : 0;
}

double ParallelBeams::Beam::twice_area(Flat a, Flat b, Flat c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Of two triangles that share an edge one has its points, the other none: both see the edge from
/// the same end.
bool ParallelBeams::Beam::is_left(Flat a, Flat b, Flat p) {
  const bool is_upward = a.y != b.y ? a.y < b.y : a.x > b.x;
  return is_upward ? twice_area(a, b, p) >= 0 : twice_area(b, a, p) < 0;
}

/// By the boxes about two triangles.
bool ParallelBeams::Beam::may_overlap(const std::array<Flat, 3>& p, const std::array<Flat, 3>& q) {
  const auto apart = [&](double Flat::*axis) {
    const auto [p0, p1] = std::minmax({p[0].*axis, p[1].*axis, p[2].*axis});
    const auto [q0, q1] = std::minmax({q[0].*axis, q[1].*axis, q[2].*axis});
    return p1 < q0 || q1 < p0;
  };
  return !apart(&Flat::x) && !apart(&Flat::y);
}

ParallelBeams::ParallelBeams(const ParallelSources& sources) {
  std::vector<Vec3> directions;
  std::vector<std::vector<std::int32_t>> triangles;
  for (std::size_t t = 0; t < sources.mesh.triangle_count(); ++t) {
    const Vec3 n = normalized(sources.mesh.area_vector2(t));
    std::size_t g = 0;
    while (g < directions.size() && norm(directions[g] - n) > same_direction) ++g;
    if (g == directions.size()) {
      directions.push_back(n);
      triangles.emplace_back();
    }
    triangles[g].push_back(static_cast<std::int32_t>(t));
  }
  for (std::size_t g = 0; g < directions.size(); ++g)
    beams_.emplace_back(sources, directions[g], triangles[g]);
}

void ParallelBeams::shine_on(std::size_t receiver, LampRays& rays) const {
  if (beams_.empty()) return;
  const SunSampler& sampler = rays.sampler();
  const auto geometry = sampler.geometry(receiver);
  const auto [a, b, c] = sampler.corners(receiver);
  SunSampler::Seeds seeds;
  for (std::size_t g = 0; g < beams_.size(); ++g) {
    const Beam& beam = beams_[g];
    const double cos_theta = dot(geometry.normal, beam.to_source());
    if (cos_theta <= 0) continue;
    const auto sources = beam.before(a, b, c);
    if (sources.empty()) continue;
    sampler.seed(receiver, static_cast<std::uint32_t>(g), seeds, Purpose::parallel_light);
    for (std::size_t p = 0; p < sampler.packets(); ++p)
      for (const auto s : sources) {
        LampRays::Look look{.origins = sampler.origins(geometry, seeds, p)};
        for (std::size_t l = 0; l < packet_size; ++l) {
          if ((sampler.active(p) >> l & 1u) == 0) continue;
          if (const double way = beam.way(s, at(look.origins, l)); way > 0)
            look.add(l, beam.to_source(), way, beam.exitance(s) * cos_theta);
        }
        rays.look(receiver, p, look, Purpose::parallel_light);
      }
  }
}

}  // namespace sunload
