// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/parallel_light.h"

#include <algorithm>
#include <array>
#include <bit>

#include "solver/base/chunks.h"
#include "solver/base/threads.h"
#include "solver/lines/line_follower.h"

namespace sunload {

namespace {

// Triangles whose normals differ by less than this make one beam: what rounding does to the
// normals of a flat sheet.
constexpr double same_direction = 1e-6;

/// A place of the plane across a beam.
struct Flat {
  double x, y;
};

double twice_area(Flat a, Flat b, Flat c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Sources of one direction.
class Beam {
 public:
  Beam(const ParallelSources& sources, Vec3 along, const std::vector<std::int32_t>& triangles)
      : to_source_(-along), axes_(tangents(along)) {
    for (const auto t : triangles) {
      const auto i = static_cast<std::size_t>(t);
      Source source{{}, dot(sources.mesh.corner(i, 0), to_source_), sources.exitance[i]};
      for (int k = 0; k < 3; ++k)
        source.corner[static_cast<std::size_t>(k)] = flat(sources.mesh.corner(i, k));
      sources_.push_back(source);
    }
  }

  Vec3 to_source() const { return to_source_; }

  /// Sources that a triangle of the scene may have before it: `chosen` receives their numbers.
  void choose(Vec3 a, Vec3 b, Vec3 c, std::vector<std::size_t>& chosen) const {
    chosen.clear();
    const Flat p[3] = {flat(a), flat(b), flat(c)};
    const double nearest = std::min({dot(a, to_source_), dot(b, to_source_), dot(c, to_source_)});
    for (std::size_t s = 0; s < sources_.size(); ++s)
      if (sources_[s].depth > nearest && overlap(p, sources_[s].corner)) chosen.push_back(s);
  }

  /// Way from x to source s along the beam, or 0 where x is not in its light.
  double way(std::size_t s, Vec3 x) const {
    const Source& source = sources_[s];
    const double way = source.depth - dot(x, to_source_);
    const Flat p = flat(x);
    const auto& [a, b, c] = source.corner;
    const bool inside =
        twice_area(a, b, p) >= 0 && twice_area(b, c, p) >= 0 && twice_area(c, a, p) >= 0;
    return way > 0 && inside ? way : 0;
  }
  double exitance(std::size_t s) const { return sources_[s].exitance; }

 private:
  struct Source {
    std::array<Flat, 3> corner;  ///< counter-clockwise against the light
    double depth;                ///< along to_source
    double exitance;
  };
  Flat flat(Vec3 p) const { return {dot(p, axes_.tangent), dot(p, axes_.bitangent)}; }

  /// Of the boxes about two triangles.
  static bool overlap(const Flat (&p)[3], const std::array<Flat, 3>& q) {
    const auto apart = [&](double Flat::*axis) {
      const auto [p0, p1] = std::minmax({p[0].*axis, p[1].*axis, p[2].*axis});
      const auto [q0, q1] = std::minmax({q[0].*axis, q[1].*axis, q[2].*axis});
      return p1 < q0 || q1 < p0;
    };
    return !apart(&Flat::x) && !apart(&Flat::y);
  }

  Vec3 to_source_;
  Tangents axes_;
  std::vector<Source> sources_;
};

std::vector<Beam> beams_of(const ParallelSources& sources) {
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
  std::vector<Beam> beams;
  for (std::size_t g = 0; g < directions.size(); ++g)
    beams.emplace_back(sources, directions[g], triangles[g]);
  return beams;
}

/// Light that mirrors left on a patch in one realization [W].
struct Left {
  std::size_t realization;
  std::uint32_t patch;
  double power;
};

/// What one task finds out.
struct Found {
  std::vector<Ledger> ledger;
  std::vector<Left> left;
  std::uint64_t rays = 0;
};

class PatchBeams {
 public:
  /// Surfaces of the scene; null for sensors, which send nothing on and are in no ledger.
  struct Surfaces {
    const Hierarchy& hierarchy;
    const PatchOptics& optics;
    const LineFollower& follower;
  };
  PatchBeams(const RayCaster& caster, const SunSampler& sampler, const Surfaces* surfaces,
             std::vector<std::vector<double>>& irradiance)
      : caster_(caster), sampler_(sampler), surfaces_(surfaces), irradiance_(irradiance) {
    found_.ledger.resize(irradiance.size());
  }

  void receive(const std::vector<Beam>& beams, std::size_t patch) {
    const auto geometry = sampler_.geometry(patch);
    for (std::size_t g = 0; g < beams.size(); ++g) {
      const double cos_theta = dot(geometry.normal, beams[g].to_source());
      if (cos_theta <= 0) continue;
      const auto [a, b, c] = sampler_.corners(patch);
      beams[g].choose(a, b, c, chosen_);
      if (chosen_.empty()) continue;
      sampler_.seed(patch, static_cast<std::uint32_t>(g), seeds_, Purpose::parallel_light);
      for (std::size_t p = 0; p < sampler_.packets(); ++p)
        for (const auto s : chosen_)
          receive(beams[g], s, patch, cos_theta, p, sampler_.origins(geometry, seeds_, p));
    }
  }
  Found& found() { return found_; }

 private:
  void receive(const Beam& beam, std::size_t source, std::size_t patch, double cos_theta,
               std::size_t packet, const Packet& origins) {
    Packet ways{};
    std::uint32_t active = 0;
    for (std::size_t l = 0; l < packet_size; ++l) {
      if ((sampler_.active(packet) >> l & 1u) == 0) continue;
      const double way = beam.way(source, at(origins, l));
      if (way <= 0) continue;
      active |= 1u << l;
      // The lamp that bears the source may lie in its plane.
      put(ways, l, beam.to_source() * std::max(0.0, way - caster_.offset_m()));
    }
    if (active == 0) return;
    found_.rays += static_cast<std::uint64_t>(std::popcount(active));
    const auto each =
        static_cast<double>(sampler_.samples()) / static_cast<double>(irradiance_.size());
    const double E = beam.exitance(source) * cos_theta / each;
    auto lit = caster_.unoccluded_up_to(origins, ways, active);
    for (; lit != 0; lit &= lit - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(lit));
      const std::size_t r = sampler_.realization(packet * packet_size + l);
      irradiance_[r][patch] += E;
      if (!surfaces_) continue;
      const auto& [hierarchy, optics, follower] = *surfaces_;
      // What passes a screen is met further on.
      const double power =
          E * hierarchy.area()[patch] * (1 - static_cast<double>(optics.passed[patch]));
      found_.ledger[r][Term::emitted] += power;
      if (sends_on(follower.material_of_patch(patch)))
        send_on(patch, r, packet * packet_size + l, beam.to_source(), at(origins, l),
                E * hierarchy.area()[patch]);
    }
  }

  /// What a mirror patch got from the direction w by one sample.
  void send_on(std::size_t patch, std::size_t r, std::size_t sample, Vec3 w, Vec3 origin,
               double power) {
    met_.clear();
    const RandomKey key{.seed = sampler_.study_seed(),
                        .purpose = Purpose::parallel_light,
                        .realization = static_cast<std::uint32_t>(r),
                        .element = surfaces_->hierarchy.key()[patch],
                        .sun = static_cast<std::uint32_t>(sample)};
    const auto sent = surfaces_->follower.mirrored_on(origin, w, patch, key, &met_);
    found_.rays += sent.rays;
    found_.ledger[r] += scaled(booked(sent.fate), power);
    for (const auto& met : met_)
      found_.left.push_back({r, met.target, power * static_cast<double>(met.weight)});
  }

  const RayCaster& caster_;
  const SunSampler& sampler_;
  const Surfaces* surfaces_;
  std::vector<std::vector<double>>& irradiance_;
  SunSampler::Seeds seeds_;
  std::vector<std::size_t> chosen_;
  std::vector<LinkTable::Link> met_;
  Found found_;
};

/// Means of the realizations.
void pool(ParallelLight& light, std::size_t receivers) {
  light.pooled.assign(receivers, 0);
  for (const auto& E : light.irradiance)
    for (std::size_t i = 0; i < receivers; ++i)
      light.pooled[i] += E[i] / static_cast<double>(light.irradiance.size());
}

}  // namespace

ParallelLight parallel_light(const Scene& scene, const Hierarchy& hierarchy,
                             const RayCaster& caster, const SunSampler& sampler,
                             const PatchOptics& optics, std::size_t realizations,
                             int mirror_depth) {
  ParallelLight light;
  if (scene.parallel_sources.exitance.empty()) return light;
  const std::size_t patches = hierarchy.patch_count();
  light.irradiance.assign(realizations, std::vector<double>(patches, 0));
  light.ledger.resize(realizations);
  const auto beams = beams_of(scene.parallel_sources);
  const SkyGrid smallest_grid(2);  // where the light leaves is not asked
  const LineFollower follower(scene, hierarchy, caster, smallest_grid, mirror_depth);
  const PatchBeams::Surfaces surfaces{hierarchy, optics, follower};

  std::vector<Found> parts(chunk_count(patches, receivers_per_chunk));
  parallel_chunks(patches, receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    PatchBeams work(caster, sampler, &surfaces, light.irradiance);
    for (std::size_t i = begin; i < end; ++i) work.receive(beams, i);
    parts[begin / receivers_per_chunk] = std::move(work.found());
  });
  // After the loop: patches of other tasks are met.
  for (const auto& part : parts) {
    light.rays += part.rays;
    for (std::size_t r = 0; r < realizations; ++r) light.ledger[r] += part.ledger[r];
    for (const auto& [r, patch, power] : part.left)
      light.irradiance[r][patch] += power / hierarchy.area()[patch];
  }
  pool(light, patches);
  return light;
}

ParallelLight parallel_light_on_sensors(const Scene& scene, const RayCaster& caster,
                                        const SunSampler& sensors, std::size_t realizations) {
  ParallelLight light;
  if (scene.parallel_sources.exitance.empty()) return light;
  light.irradiance.assign(realizations, std::vector<double>(sensors.receivers(), 0));
  const auto beams = beams_of(scene.parallel_sources);
  PatchBeams work(caster, sensors, nullptr, light.irradiance);
  for (std::size_t s = 0; s < sensors.receivers(); ++s) work.receive(beams, s);
  light.rays = work.found().rays;
  pool(light, sensors.receivers());
  return light;
}

}  // namespace sunload
