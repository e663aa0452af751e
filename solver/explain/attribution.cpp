// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/explain/attribution.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "solver/base/threads.h"
#include "solver/first_light/beam_raster.h"
#include "solver/first_light/sun_beams.h"
#include "solver/light/sun_samples.h"
#include "solver/traced/light_iteration.h"

namespace sunload {

double Attribution::net(std::size_t object, std::size_t r) const {
  return flow(object, Flow::reflects, r) + flow(object, Flow::mirrors, r) +
         flow(object, Flow::shines, r) - flow(object, Flow::takes_sun, r) -
         flow(object, Flow::takes_sky, r) - flow(object, Flow::takes_far_ground, r);
}

double Attribution::total(std::size_t r) const {
  double sum = open(Open::sun, r) + open(Open::sky, r) + open(Open::far_ground, r);
  for (std::size_t o = 0; o < objects(); ++o) sum += net(o, r);
  return sum;
}

namespace {

/// Sums over a part of the place. Of patches a part meets few: those have rows, in the order in
/// which they are met.
class PartSums {
 public:
  explicit PartSums(std::size_t realizations)
      : realizations_(realizations), open_(Attribution::open_count * realizations, 0) {}
  std::size_t realizations() const { return realizations_; }

  void add_open(Attribution::Open source, std::size_t r, double value) {
    open_[static_cast<std::size_t>(source) * realizations_ + r] += value;
  }
  /// Of nobody: `body` below 0.
  void add_flow(std::int32_t body, Flow flow, std::size_t r, double value) {
    if (body < 0) return;
    flows_[(row_of(body) * flow_count + static_cast<std::size_t>(flow)) * realizations_ + r] +=
        value;
  }

  void add_to(Attribution& sums) const {
    for (std::size_t s = 0; s < Attribution::open_count; ++s)
      for (std::size_t r = 0; r < realizations_; ++r)
        sums.add_open(static_cast<Attribution::Open>(s), r, open_[s * realizations_ + r]);
    for (const auto& [body, row] : rows_)
      for (std::size_t f = 0; f < flow_count; ++f)
        for (std::size_t r = 0; r < realizations_; ++r)
          sums.add_flow(static_cast<std::size_t>(body), static_cast<Flow>(f), r,
                        flows_[(row * flow_count + f) * realizations_ + r]);
  }

 private:
  std::size_t row_of(std::int32_t body) {
    const auto [found, is_new] = rows_.try_emplace(body, rows_.size());
    if (is_new) flows_.resize(flows_.size() + flow_count * realizations_, 0);
    return found->second;
  }

  std::size_t realizations_;
  std::vector<double> open_, flows_;
  std::unordered_map<std::int32_t, std::size_t> rows_;
};

/// Receivers that one thread takes at a time.
constexpr std::size_t fewest_at_a_time = 16;
/// Each part has sums for all objects that it meets.
constexpr std::size_t most_parts = 64;

/// What shines on the scene from outside, over the whole period.
struct Outside {
  std::vector<double> sky;  ///< π · radiance of each cell [J m-2]
  double far_ground = 0;    ///< exitance [J m-2]
  double seconds = 0;
  std::vector<IntervalLight> suns;  ///< with power, without sky
};

Outside outside_of(const LitPeriod& period, const std::vector<double>& shares,
                   const SkyGrid& grid) {
  Outside outside;
  outside.sky.assign(static_cast<std::size_t>(grid.cell_count()), 0);
  for (std::size_t i = 0; i < period.intervals(); ++i) {
    const double share = shares.empty() ? 1 : shares[i];
    if (share == 0) continue;
    IntervalLight light = period.of(i);
    expect_valid({&light, 1}, outside.sky.size());
    light.length_s *= share;
    outside.seconds += light.length_s;
    if (period.is_dark(i)) continue;
    for (std::size_t c = 0; c < light.sky.size(); ++c)
      outside.sky[c] += pi * light.sky[c] * light.length_s;
    outside.far_ground += light.ground_exitance * light.length_s;
    for (const auto& of_sample : suns_one_by_one({&light, 1}))
      for (const IntervalLight& sun : of_sample)
        if (sun.has_sun() && sun.dni > 0) outside.suns.push_back(sun);
  }
  return outside;
}

/// The ways of one sun by mirrors.
struct Mirrored {
  SunBeams beams;
  std::vector<BeamRaster> rasters;  ///< of each beam
};

/// Coarse ones will do: what they do not exclude, rays do.
constexpr int raster_size = 64;

Mirrored mirrored(const TracedScene& traced, const IntervalLight& sun, bool is_for_sensors) {
  Mirrored by{beams_on_patches(traced, sun), {}};
  if (is_for_sensors) by.beams = beams_on_sensors(traced, sun, std::move(by.beams));
  for (std::size_t b = 0; b < by.beams.size(); ++b)
    by.rasters.emplace_back(by.beams[b].section, by.beams[b].image, by.beams.spread(), raster_size);
  return by;
}

/// Looks along the ways to some receivers of the place.
class Looks {
 public:
  Looks(const TracedScene& traced, const Outside& outside, const SentLight& sent,
        const Place& place, Among among, PartSums& into)
      : traced_(traced),
        outside_(outside),
        sent_(sent),
        place_(place),
        among_(among),
        lines_(traced),
        receivers_(place.is_of_sensors ? traced.sensors : traced.patches),
        follower_(traced.scene, *traced.mesh, traced.caster, traced.grid,
                  traced.rules.mirror_depth),
        into_(into) {}

  /// To the sun of an interval, and to its images.
  void to_sun(std::size_t which, const IntervalLight& sun, const Mirrored* mirrors) {
    const std::size_t receiver = place_.receivers[which];
    const SunSampler& sampler = receivers_.sampler;
    const auto geometry = sampler.geometry(receiver);
    find_beams(receiver, geometry.normal, mirrors);
    const double cos_theta = dot(geometry.normal, sun.direction);
    if (cos_theta <= 0 && by_beams_.empty()) return;
    const double samples_each =
        static_cast<double>(sampler.samples()) / static_cast<double>(into_.realizations());
    const double energy = place_.weight[which] * sun.dni * sun.length_s / samples_each;
    sampler.seed(receiver, sun.number, seeds_);
    for (std::size_t p = 0; p < sampler.packets(); ++p) {
      const Packet origins = sampler.origins(geometry, seeds_, p);
      const PacketDirections suns = sampler.directions(sun, seeds_, p);
      const std::uint32_t active = sampler.active(p);
      if (cos_theta > 0) see_sun(origins, suns, active, p, energy * cos_theta);
      if (mirrors == nullptr) continue;
      for (const std::size_t b : by_beams_)
        for (std::size_t l = 0; l < packet_size; ++l)
          if (active >> l & 1U)
            see_image(mirrors->beams, b, at(origins, l), at(suns, l),
                      sampler.realization(p * packet_size + l),
                      energy * dot(geometry.normal, mirrors->beams[b].image));
    }
  }

  /// Along the lines.
  void along_lines(std::size_t which) {
    const std::size_t receiver = place_.receivers[which];
    const auto kind = place_.is_of_sensors ? Receiver::sensor : Receiver::patch;
    const double share = place_.weight[which] / static_cast<double>(lines_.count(receiver, kind));
    for (std::size_t r = 0; r < lines_.realizations(); ++r)
      lines_.cast(receiver, kind, r, [&](const CastLine& line) { along_line(line, r, share); });
  }

 private:
  /// The object or patch that is met; below 0: none.
  std::int32_t body_of(const Hit& hit) const {
    if (among_ == Among::patches)
      return traced_.mesh->patch_at(hit.triangle, hit.u, hit.v, hit.front);
    return traced_.scene.mesh.triangle_object[static_cast<std::size_t>(hit.triangle)].value;
  }

  void find_beams(std::size_t receiver, Vec3 normal, const Mirrored* mirrors) {
    by_beams_.clear();
    if (mirrors == nullptr) return;
    const auto corners = receivers_.sampler.corners(receiver);
    for (std::size_t b = 0; b < mirrors->rasters.size(); ++b)
      if (dot(normal, mirrors->beams[b].image) > 0 && mirrors->rasters[b].may_meet(corners))
        by_beams_.push_back(b);
  }

  /// What crowns and screens let through is no chance (solver/first_light/direct_sun.h).
  void see_sun(const Packet& origins, const PacketDirections& suns, std::uint32_t active,
               std::size_t packet, double energy) {
    const auto realization = [&](std::size_t ray) {
      return receivers_.sampler.realization(packet * packet_size + ray);
    };
    for (std::size_t l = 0; l < packet_size; ++l)
      if (active >> l & 1U) into_.add_open(Attribution::Open::sun, realization(l), energy);
    for (const auto& [hit, share, ray] : traced_.caster.takers_each(origins, suns, active))
      into_.add_flow(body_of(hit), Flow::takes_sun, realization(ray), energy * share);
  }

  /// Back from the mirror that is seen to the one that the sun shines on (MirrorSun).
  void see_image(const SunBeams& beams, std::size_t last, Vec3 from, Vec3 sun, std::size_t r,
                 double energy) {
    std::optional<std::int32_t> seen;
    for (auto b = static_cast<std::int32_t>(last); b >= 0;
         b = beams[static_cast<std::size_t>(b)].before) {
      const SunBeam& beam = beams[static_cast<std::size_t>(b)];
      const Vec3 w = beam.image_of(sun);
      const Hit hit = traced_.caster.first_hit(from, w);
      if (hit.left_scene() ||
          traced_.mirrors.of_side(hit.triangle, hit.front) != static_cast<std::int32_t>(beam.group))
        return;
      if (!seen) seen = body_of(hit);
      const Vec3 n = traced_.mirrors[beam.group].normal;
      energy *= traced_.mirrors.weight_of_hit(hit.triangle, -dot(n, w));
      from = lifted_point(traced_.scene.mesh, hit, n, traced_.caster.offset_m());
    }
    into_.add_flow(*seen, Flow::mirrors, r, energy * share_of_sun(from, sun));
  }

  /// That arrives (see_sun).
  double share_of_sun(Vec3 from, Vec3 sun) const {
    double left = 1;
    for (const auto& taker : traced_.caster.takers(from, sun)) left -= taker.share;
    return left;
  }

  void along_line(const CastLine& line, std::size_t r, double share) {
    const auto& [origin, w, hit, key] = line;
    const bool is_up = w.z > 0;
    const double behind =
        share * (is_up ? outside_.sky[follower_.sky_cell(w)] : outside_.far_ground);
    into_.add_open(is_up ? Attribution::Open::sky : Attribution::Open::far_ground, r, behind);
    if (hit.left_scene()) return;
    const std::int32_t object = body_of(hit);
    into_.add_flow(object, is_up ? Flow::takes_sky : Flow::takes_far_ground, r, behind);
    met_.clear();
    follower_.follow(origin, w, hit, key, met_);
    const auto first = traced_.mesh->patch_at(hit.triangle, hit.u, hit.v, hit.front);
    for (std::size_t k = 0; k < met_.patches.size(); ++k) {
      const auto& [patch, weight] = met_.patches[k];
      const double seen = share * static_cast<double>(weight);
      if (k > 0 || static_cast<std::int32_t>(patch) != first) {
        into_.add_flow(object, Flow::mirrors, r, seen * sent_[patch]);
        continue;
      }
      const double shines = follower_.material_of_patch(patch).emission_w_m2 * outside_.seconds;
      into_.add_flow(object, Flow::shines, r, seen * shines);
      into_.add_flow(object, Flow::reflects, r, seen * (sent_[patch] - shines));
    }
    double mirrored = static_cast<double>(met_.ends.ground_by_mirror) * outside_.far_ground;
    for (const auto& [cell, weight] : met_.sky_by_mirror)
      mirrored += static_cast<double>(weight) * outside_.sky[cell];
    into_.add_flow(object, Flow::mirrors, r, share * mirrored);
  }

  const TracedScene& traced_;
  const Outside& outside_;
  const SentLight& sent_;
  const Place& place_;
  Among among_;
  PlaceLines lines_;
  const Receivers& receivers_;
  LineFollower follower_;
  PartSums& into_;
  SunSampler::Seeds seeds_;
  std::vector<std::size_t> by_beams_;
  LineCollector met_;
};

/// Ways of so many suns are in memory at a time.
constexpr std::size_t suns_at_a_time = 64;

}  // namespace

Attribution attribute_light(const TracedScene& traced, const LitPeriod& period,
                            const SentLight& sent, const Place& place,
                            const std::vector<double>& shares, Among among) {
  SUNLOAD_EXPECT(sent.size() == traced.mesh->patch_count(), "light of every patch");
  SUNLOAD_EXPECT(place.receivers.size() == place.weight.size(), "a weight of every receiver");
  SUNLOAD_EXPECT(shares.empty() || shares.size() == period.intervals(), "a share of intervals");
  const Outside outside = outside_of(period, shares, traced.grid);
  const std::size_t count = place.receivers.size();
  const std::size_t each = std::max(fewest_at_a_time, (count + most_parts - 1) / most_parts);
  const auto realizations = static_cast<std::size_t>(traced.rules.realizations);
  std::vector<PartSums> parts((count + each - 1) / each, PartSums(realizations));
  const auto look = [&](const auto& at) {
    parallel_chunks(count, each, [&](std::size_t begin, std::size_t end) {
      Looks looks(traced, outside, sent, place, among, parts[begin / each]);
      for (std::size_t i = begin; i < end; ++i) at(looks, i);
    });
  };
  look([](Looks& looks, std::size_t i) { looks.along_lines(i); });
  const bool has_mirrors = traced.mirrors.reflecting() > 0;
  for (std::size_t first = 0; first < outside.suns.size(); first += suns_at_a_time) {
    const std::size_t suns = std::min(suns_at_a_time, outside.suns.size() - first);
    std::vector<std::optional<Mirrored>> ways(suns);
    if (has_mirrors)
      parallel_for(suns, [&](std::size_t k) {
        ways[k] = mirrored(traced, outside.suns[first + k], place.is_of_sensors);
      });
    look([&](Looks& looks, std::size_t i) {
      for (std::size_t k = 0; k < suns; ++k)
        looks.to_sun(i, outside.suns[first + k], ways[k] ? &*ways[k] : nullptr);
    });
  }
  const std::size_t bodies =
      among == Among::patches ? traced.mesh->patch_count() : traced.scene.mesh.object_names.size();
  Attribution sum(bodies, realizations);
  for (const PartSums& part : parts) part.add_to(sum);
  return sum;
}

}  // namespace sunload
