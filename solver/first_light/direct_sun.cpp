// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/direct_sun.h"

#include <algorithm>
#include <bit>

#include "geo/base/check.h"
#include "geo/base/vector_code.h"
#include "solver/base/chunks.h"
#include "solver/base/sampling.h"
#include "solver/base/threads.h"
#include "solver/light/sun_samples.h"
#include "solver/sight/lit_shares.h"

namespace sunload {

namespace {

constexpr std::size_t lanes = 16;

/// Origins of 16 samples: the map of sample_triangle on Owen-scrambled points,
/// without branches, in the shape that compilers turn into vector code.
SUNLOAD_VECTOR_CODE void place(const SunSampler::Geometry& g, const std::uint32_t* point_u,
                               const std::uint32_t* point_v, const std::uint32_t* seed_u,
                               const std::uint32_t* seed_v, Packet& out) {
  for (std::size_t s = 0; s < packet_size; ++s) {
    const float u = uniform(owen_scrambled(point_u[s], seed_u[s]));
    const float v = uniform(owen_scrambled(point_v[s], seed_v[s]));
    const float smaller = 0.5f * (u < v ? u : v);
    const float w1 = v > u ? smaller : u - smaller;
    const float w2 = v > u ? v - smaller : smaller;
    out.x[s] = g.a[0] + w1 * g.ab[0] + w2 * g.ac[0];
    out.y[s] = g.a[1] + w1 * g.ab[1] + w2 * g.ac[1];
    out.z[s] = g.a[2] + w1 * g.ab[2] + w2 * g.ac[2];
  }
}

SUNLOAD_VECTOR_CODE void scramble(const ScrambledPoints& seeds, ScrambledPoints& points) {
  for (std::size_t s = 0; s < packet_size; ++s) {
    points.u[s] = owen_scrambled(points.u[s], seeds.u[s]);
    points.v[s] = owen_scrambled(points.v[s], seeds.v[s]);
  }
}

void to_float(Vec3 v, float (&out)[3]) {
  out[0] = static_cast<float>(v.x);
  out[1] = static_cast<float>(v.y);
  out[2] = static_cast<float>(v.z);
}

}  // namespace

SunSampler::SunSampler(const Hierarchy& hierarchy, const RayCaster& caster,
                       const DirectRules& rules)
    : SunSampler(&hierarchy, nullptr, caster.offset_m(), rules) {}

SunSampler::SunSampler(const std::vector<Sensor>& sensors, const RayCaster& caster,
                       const DirectRules& rules)
    : SunSampler(nullptr, &sensors, caster.offset_m(), rules) {}

SunSampler::SunSampler(const Hierarchy* hierarchy, const std::vector<Sensor>* sensors,
                       double offset_m, const DirectRules& rules)
    : hierarchy_(hierarchy), sensors_(sensors), offset_m_(offset_m), rules_(rules) {
  SUNLOAD_EXPECT(rules.realizations >= 1 && rules.samples >= rules.realizations &&
                     rules.samples % rules.realizations == 0,
                 "direct samples are shared equally by the realizations");
  const int each = rules.samples / rules.realizations;
  for (int s = 0; s < rules.samples; ++s) {
    realization_.push_back(static_cast<std::uint32_t>(s / each));
    point_u_.push_back(sobol(static_cast<std::uint32_t>(s % each), 0));
    point_v_.push_back(sobol(static_cast<std::uint32_t>(s % each), 1));
    disk_u_.push_back(sobol(static_cast<std::uint32_t>(s % each), 2));
    disk_v_.push_back(sobol(static_cast<std::uint32_t>(s % each), 3));
  }
  const auto points = static_cast<std::uint32_t>(net_size(rules.samples, rules.realizations));
  for (std::uint32_t s = 0; s < points; ++s)
    net_.push_back({sobol(s, 0), sobol(s, 1), sobol(s, 2), sobol(s, 3)});
}

SunSampler SunSampler::with_samples(std::size_t factor) const {
  DirectRules rules = rules_;
  rules.samples *= static_cast<int>(factor);
  return {hierarchy_, sensors_, offset_m_, rules};
}

std::size_t SunSampler::receivers() const {
  return sensors_ ? sensors_->size() : hierarchy_->patch_count();
}

std::array<Vec3, 3> SunSampler::corners(std::size_t receiver) const {
  if (sensors_) {
    const Vec3 point = (*sensors_)[receiver].position;
    return {point, point, point};
  }
  return {hierarchy_->corner(receiver, 0), hierarchy_->corner(receiver, 1),
          hierarchy_->corner(receiver, 2)};
}

Vec3 SunSampler::normal(std::size_t receiver) const {
  return sensors_ ? (*sensors_)[receiver].normal : hierarchy_->normal(receiver);
}

SunSampler::Geometry SunSampler::geometry(std::size_t receiver) const {
  Geometry g;
  auto [a, b, c] = corners(receiver);
  g.normal = sensors_ ? normal(receiver) : normalized(cross(b - a, c - a));
  if (sensors_) {
    // Screens let equal rays pass or none of them: those of a sensor differ by a rounding or two.
    const Tangents axes = tangents(g.normal);
    a = a - (axes.tangent + axes.bitangent) * (offset_m_ / 3);
    b = a + axes.tangent * offset_m_;
    c = a + axes.bitangent * offset_m_;
  }
  const Vec3 ab = b - a, ac = c - a;
  to_float(a + g.normal * offset_m_, g.a);
  to_float(ab, g.ab);
  to_float(ac, g.ac);
  return g;
}

std::uint64_t SunSampler::key(std::size_t receiver) const {
  return sensors_ ? (*sensors_)[receiver].key : hierarchy_->key()[receiver];
}

void SunSampler::seed(std::size_t receiver, std::uint32_t sun, Seeds& seeds,
                      Purpose purpose) const {
  const std::uint64_t element = key(receiver);
  const auto count = static_cast<std::size_t>(rules_.realizations);
  const std::size_t groups = (count + lanes - 1) / lanes;
  seeds.u.resize(groups * lanes);
  seeds.v.resize(groups * lanes);
  seeds.disk_u.resize(groups * lanes);
  seeds.disk_v.resize(groups * lanes);
  for (std::size_t g = 0; g < groups; ++g) {
    const auto words = random_lanes({.seed = rules_.seed,
                                     .purpose = purpose,
                                     .realization = static_cast<std::uint32_t>(g * lanes),
                                     .element = element,
                                     .sun = sun});
    std::copy_n(words.word[0], lanes, seeds.u.begin() + static_cast<std::ptrdiff_t>(g * lanes));
    std::copy_n(words.word[1], lanes, seeds.v.begin() + static_cast<std::ptrdiff_t>(g * lanes));
    std::copy_n(words.word[2], lanes,
                seeds.disk_u.begin() + static_cast<std::ptrdiff_t>(g * lanes));
    std::copy_n(words.word[3], lanes,
                seeds.disk_v.begin() + static_cast<std::ptrdiff_t>(g * lanes));
  }
}

Packet SunSampler::origins(const Geometry& g, const Seeds& seeds, std::size_t packet) const {
  alignas(64) std::uint32_t u[packet_size], v[packet_size], seed_u[packet_size],
      seed_v[packet_size];
  for (std::size_t l = 0; l < packet_size; ++l) {
    const std::size_t s = std::min(packet * packet_size + l, samples() - 1);
    u[l] = point_u_[s];
    v[l] = point_v_[s];
    seed_u[l] = seeds.u[realization_[s]];
    seed_v[l] = seeds.v[realization_[s]];
  }
  Packet origins;
  place(g, u, v, seed_u, seed_v, origins);
  return origins;
}

ScrambledPoints SunSampler::points(const Seeds& seeds, std::size_t packet) const {
  ScrambledPoints scrambled, seed;
  for (std::size_t l = 0; l < packet_size; ++l) {
    const std::size_t s = std::min(packet * packet_size + l, samples() - 1);
    scrambled.u[l] = disk_u_[s];
    scrambled.v[l] = disk_v_[s];
    seed.u[l] = seeds.disk_u[realization_[s]];
    seed.v[l] = seeds.disk_v[realization_[s]];
  }
  scramble(seed, scrambled);
  return scrambled;
}

ScrambledPoints SunSampler::origin_points(const Seeds& seeds, std::size_t packet) const {
  ScrambledPoints scrambled, seed;
  for (std::size_t l = 0; l < packet_size; ++l) {
    const std::size_t s = std::min(packet * packet_size + l, samples() - 1);
    scrambled.u[l] = point_u_[s];
    scrambled.v[l] = point_v_[s];
    seed.u[l] = seeds.u[realization_[s]];
    seed.v[l] = seeds.v[realization_[s]];
  }
  scramble(seed, scrambled);
  return scrambled;
}

namespace {

PacketDirections to_points(const IntervalLight& sun, const ScrambledPoints& on_disk) {
  const SunPoints points(sun);
  PacketDirections directions;
  for (std::size_t l = 0; l < packet_size; ++l)
    put(directions, l,
        points.at(static_cast<double>(uniform(on_disk.u[l])),
                  static_cast<double>(uniform(on_disk.v[l]))));
  return directions;
}

}  // namespace

PacketDirections SunSampler::directions(const IntervalLight& sun, const Seeds& seeds,
                                        std::size_t packet) const {
  if (sun.disk_half_angle <= 0) return same_for_all(sun.direction);
  return to_points(sun, points(seeds, packet));
}

PacketDirections SunSampler::directions_by_origins(const IntervalLight& sun, const Seeds& seeds,
                                                   std::size_t packet) const {
  if (sun.disk_half_angle <= 0) return same_for_all(sun.direction);
  return to_points(sun, origin_points(seeds, packet));
}

std::uint32_t SunSampler::active(std::size_t packet) const {
  const std::size_t count = std::min(packet_size, samples() - packet * packet_size);
  return static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
}

SunSampler::NetRays SunSampler::net_rays(std::size_t receiver, const Geometry& g,
                                         const IntervalLight& sun, std::size_t first) const {
  const RandomWords words = random_words({.seed = rules_.seed,
                                          .purpose = Purpose::clouded_sun,
                                          .element = key(receiver),
                                          .sun = sun.number});
  ScrambledPoints on_receiver, on_disk, seeds, disk_seeds;
  for (std::size_t l = 0; l < packet_size; ++l) {
    const auto& point = net_[std::min(first + l, net_.size() - 1)];
    on_receiver.u[l] = point[0];
    on_receiver.v[l] = point[1];
    on_disk.u[l] = point[2];
    on_disk.v[l] = point[3];
    seeds.u[l] = words[0];
    seeds.v[l] = words[1];
    disk_seeds.u[l] = words[2];
    disk_seeds.v[l] = words[3];
  }
  NetRays rays;
  place(g, on_receiver.u, on_receiver.v, seeds.u, seeds.v, rays.origins);
  if (sun.disk_half_angle <= 0) {
    rays.to_sun = same_for_all(sun.direction);
  } else {
    scramble(disk_seeds, on_disk);
    rays.to_sun = to_points(sun, on_disk);
  }
  return rays;
}

LitSamples lit_samples(const SunSampler& sampler, const RayCaster& caster, const IntervalLight& sun,
                       const SunSampler::Geometry& geometry, const SunSampler::Seeds& seeds,
                       std::size_t packet) {
  return lit_samples(caster, sampler.origins(geometry, seeds, packet),
                     sampler.directions(sun, seeds, packet), sampler.active(packet));
}

LitSamples lit_samples(const RayCaster& caster, const Packet& origins,
                       const PacketDirections& to_sun, std::uint32_t active) {
  const auto share = caster.passed_each(origins, to_sun, active);
  return {origins, to_sun, active, any_passed(share), share};
}

namespace {

bool is_clouded(const IntervalLight& sun) { return sun.has_sun() && sun.dni <= 0; }

/// Shares of receivers that see the suns, [N][block], or nothing.
class Known {
 public:
  explicit Known(const Columns& shares) : shares_(shares) {}
  /// Below 0: rays must tell.
  float share(std::size_t receiver, std::size_t k) const {
    return shares_.empty() ? LitShares::by_rays : shares_[receiver * block_width + k];
  }

 private:
  const Columns& shares_;
};

/// Suns behind clouds, and consecutive receivers whose shares are not known: rays of neighbours
/// fill a packet together.
class CloudedSuns {
 public:
  CloudedSuns(const RayCaster& caster, const SunSampler& sampler,
              std::span<const IntervalLight> block, Known known)
      : caster_(caster), sampler_(sampler), block_(block), known_(known) {}

  /// Returns the rays cast.
  std::uint64_t run(std::size_t begin, std::size_t end, const RaySink& into, Columns& sunlit) {
    rays_ = 0;
    begin_ = begin;
    end_ = end;
    for (std::size_t k = 0; k < block_.size(); ++k)
      if (is_clouded(block_[k])) add(k, into.whole_of(k), sunlit);
    return rays_;
  }

 private:
  void add(std::size_t k, std::size_t column, Columns& sunlit) {
    const IntervalLight& sun = block_[k];
    seen_.assign(end_ - begin_, 0);
    for (std::size_t g = 0; g < seen_.size(); ++g)
      if (known_.share(begin_ + g, k) < 0 && dot(sampler_.normal(begin_ + g), sun.direction) > 0)
        ask(g, sun);
    cast();
    const auto n = static_cast<double>(sampler_.net_points());
    for (std::size_t g = 0; g < seen_.size(); ++g)
      if (seen_[g] > 0)
        sunlit[(begin_ + g) * block_width + column] +=
            static_cast<float>(sun.sun_share * seen_[g] / n);
  }
  void ask(std::size_t g, const IntervalLight& sun) {
    const auto geometry = sampler_.geometry(begin_ + g);
    for (std::size_t first = 0; first < sampler_.net_points(); first += packet_size) {
      const auto of_net = sampler_.net_rays(begin_ + g, geometry, sun, first);
      const std::size_t count = std::min(packet_size, sampler_.net_points() - first);
      for (std::size_t l = 0; l < count; ++l) {
        if (waiting_ == packet_size) cast();
        copy(of_net.origins, l, origins_);
        copy(of_net.to_sun, l, to_sun_);
        receiver_[waiting_++] = g;
      }
    }
  }
  void copy(const Packet& from, std::size_t ray, Packet& to) const {
    to.x[waiting_] = from.x[ray];
    to.y[waiting_] = from.y[ray];
    to.z[waiting_] = from.z[ray];
  }
  /// All rays that wait.
  void cast() {
    if (waiting_ == 0) return;
    const auto active = static_cast<std::uint32_t>((std::uint64_t{1} << waiting_) - 1);
    rays_ += waiting_;
    const auto shares = caster_.passed_each(origins_, to_sun_, active);
    for (std::size_t l = 0; l < waiting_; ++l)
      seen_[receiver_[l]] += static_cast<double>(shares[l]);
    waiting_ = 0;
  }

  Packet origins_{};  ///< of rays that wait
  PacketDirections to_sun_{};
  const RayCaster& caster_;
  const SunSampler& sampler_;
  std::span<const IntervalLight> block_;
  Known known_;
  std::size_t begin_ = 0, end_ = 0;
  std::vector<double> seen_;  ///< points of each receiver's net that see the sun, by their shares
  std::array<std::size_t, packet_size> receiver_{};
  std::size_t waiting_ = 0;
  std::uint64_t rays_ = 0;
};

/// The work of one receiver for all suns of a block: those that shine, and all whose shares are
/// known.
class ReceiverSuns {
 public:
  ReceiverSuns(const RayCaster& caster, const SunSampler& sampler,
               std::span<const IntervalLight> block, Known known, std::size_t realizations)
      : caster_(caster), sampler_(sampler), block_(block), known_(known), seen_(realizations) {}

  void run(std::size_t receiver, const RaySink& into, Columns& sunlit) {
    const Vec3 normal = sampler_.normal(receiver);
    std::array<double, block_width> alike{};  // that all realizations have [W m-2]
    bool any = false;
    for (std::size_t k = 0; k < block_.size(); ++k) {
      const IntervalLight& sun = block_[k];
      const double cos_theta = dot(normal, sun.direction);
      if (!sun.has_sun() || cos_theta <= 0) continue;
      const auto share = static_cast<double>(known_.share(receiver, k));
      if (share < 0) {
        if (sun.dni > 0) add_by_rays(receiver, k, into, sunlit);
        continue;
      }
      sunlit[receiver * block_width + into.whole_of(k)] +=
          static_cast<float>(sun.sun_share * share);
      alike[k] = sun.dni * cos_theta * share;
      any = any || alike[k] > 0;
    }
    if (any) into.add_alike(receiver, alike);
  }
  std::uint64_t rays = 0;

 private:
  void add_by_rays(std::size_t receiver, std::size_t k, const RaySink& into, Columns& sunlit) {
    const IntervalLight& sun = block_[k];
    const auto geometry = sampler_.geometry(receiver);
    const double cos_theta = dot(geometry.normal, sun.direction);
    const double visible = count_visible(geometry, receiver, sun);
    if (visible <= 0 || cos_theta <= 0) return;
    const auto n = static_cast<double>(sampler_.samples());
    sunlit[receiver * block_width + into.whole_of(k)] +=
        static_cast<float>(sun.sun_share * visible / n);
    into.add_pooled(receiver, k, sun.dni * cos_theta * visible / n);
    const double n_each = n / static_cast<double>(seen_.size());
    for (std::size_t r = 0; r < seen_.size(); ++r)
      into.add(r, receiver, k, sun.dni * cos_theta * seen_[r] / n_each);
  }
  /// Samples that see the sun, by their shares, in all, and per realization in seen_.
  double count_visible(const SunSampler::Geometry& geometry, std::size_t receiver,
                       const IntervalLight& sun) {
    std::fill(seen_.begin(), seen_.end(), 0);
    sampler_.seed(receiver, sun.number, seeds_);
    double visible = 0;
    for (std::size_t p = 0; p < sampler_.packets(); ++p) {
      const LitSamples samples = lit_samples(sampler_, caster_, sun, geometry, seeds_, p);
      rays += static_cast<std::uint64_t>(std::popcount(samples.active));
      for (auto bits = samples.lit; bits != 0; bits &= bits - 1) {
        const auto l = static_cast<std::size_t>(std::countr_zero(bits));
        const auto share = static_cast<double>(samples.share[l]);
        visible += share;
        seen_[sampler_.realization(p * packet_size + l)] += share;
      }
    }
    return visible;
  }

  const RayCaster& caster_;
  const SunSampler& sampler_;
  std::span<const IntervalLight> block_;
  Known known_;
  SunSampler::Seeds seeds_;
  std::vector<double> seen_;
};

}  // namespace

std::uint64_t direct_sun(const RayCaster& caster, const SunSampler& sampler,
                         std::span<const IntervalLight> block, const RaySink& into, Columns& sunlit,
                         const Columns& shares) {
  const Known known(shares);
  return ordered_sum(sampler.receivers(), receivers_per_chunk, std::uint64_t{0},
                     [&](std::size_t begin, std::size_t end) {
                       ReceiverSuns suns(caster, sampler, block, known, into.realizations());
                       for (std::size_t i = begin; i < end; ++i) suns.run(i, into, sunlit);
                       CloudedSuns clouded(caster, sampler, block, known);
                       return suns.rays + clouded.run(begin, end, into, sunlit);
                     });
}

}  // namespace sunload
