// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/mirror_sun.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <optional>

#include "geo/base/vector_code.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// Consecutive receivers, which lie close together, in their common box.
struct Cluster {
  std::size_t begin, end;
  std::array<Vec3, 8> corners;
};

std::vector<Cluster> clusters_of(const SunSampler& receivers) {
  constexpr std::size_t patches_per_cluster = TriangleColumns::most;
  const std::size_t patches = receivers.receivers();
  std::vector<Cluster> clusters(chunk_count(patches, patches_per_cluster));
  parallel_for(
      clusters.size(),
      [&](std::size_t c) {
        clusters[c].begin = c * patches_per_cluster;
        clusters[c].end = std::min(patches, clusters[c].begin + patches_per_cluster);
        constexpr double infinite = std::numeric_limits<double>::infinity();
        Vec3 low{infinite, infinite, infinite}, high{-infinite, -infinite, -infinite};
        for (std::size_t i = clusters[c].begin; i < clusters[c].end; ++i)
          for (const Vec3 p : receivers.corners(i)) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
          }
        for (std::size_t k = 0; k < 8; ++k)
          clusters[c].corners[k] = {k & 1 ? high.x : low.x, k & 2 ? high.y : low.y,
                                    k & 4 ? high.z : low.z};
      },
      64);
  return clusters;
}

/// The receivers of a cluster side by side.
struct ClusterColumns {
  TriangleColumns corners;
  alignas(64) double normal[3][TriangleColumns::most]{};
  ClusterColumns(const SunSampler& receivers, const Cluster& cluster) {
    for (std::size_t i = cluster.begin; i < cluster.end; ++i) {
      const Vec3 n = receivers.normal(i);
      normal[0][corners.count] = n.x;
      normal[1][corners.count] = n.y;
      normal[2][corners.count] = n.z;
      corners.add(receivers.corners(i));
    }
  }
};

SUNLOAD_VECTOR_CODE void cosines_to(const double (&normal)[3][TriangleColumns::most], Vec3 w,
                                    double (&__restrict cosine)[TriangleColumns::most]) {
  for (std::size_t l = 0; l < TriangleColumns::most; ++l)
    cosine[l] = normal[0][l] * w.x + normal[1][l] * w.y + normal[2][l] * w.z;
}

/// Those that face a direction, a bit each.
std::uint64_t facing(const ClusterColumns& cluster, Vec3 w) {
  alignas(64) double cosine[TriangleColumns::most];
  cosines_to(cluster.normal, w, cosine);
  std::uint64_t bits = 0;
  for (std::size_t l = 0; l < cluster.corners.count; ++l) bits |= std::uint64_t{cosine[l] > 0} << l;
  return bits;
}

/// Cells along an edge of the rasters of one sun's beams.
int raster_size(std::size_t beams) {
  constexpr std::size_t cells_of_sun = std::size_t{1} << 23;
  constexpr int coarsest = 16;
  int size = BeamRaster::finest;
  while (size > coarsest && beams * static_cast<std::size_t>(size * size) > cells_of_sun) size /= 2;
  return size;
}

/// Of each column, from that value on.
SUNLOAD_VECTOR_CODE void take_least(const float* __restrict values, std::size_t rows,
                                    float* __restrict least) {
  for (std::size_t i = 0; i < rows; ++i, values += block_width)
#pragma GCC unroll 1  // else the compiler makes it scalar
    for (std::size_t k = 0; k < block_width; ++k)
      least[k] = values[k] < least[k] ? values[k] : least[k];
}

/// What is known of light that is reflected once, of receivers and suns, [N][block], or of none.
class OnceReflected {
 public:
  explicit OnceReflected(Columns light) : light_(std::move(light)) {}
  bool of_any() const { return !light_.empty(); }
  /// Irradiance per DNI; below 0: rays must tell.
  float light(std::size_t receiver, std::size_t k) const {
    return of_any() ? light_[receiver * block_width + k] : MirroredShares::by_rays;
  }
  /// Receivers of which rays must tell, a bit each.
  std::uint64_t by_rays(const Cluster& cluster, std::size_t k) const {
    std::uint64_t bits = 0;
    for (std::size_t i = cluster.begin; i < cluster.end; ++i)
      bits |= std::uint64_t{light(i, k) < 0} << (i - cluster.begin);
    return bits;
  }
  /// Suns of which rays must tell some receiver, a bit each.
  std::uint32_t suns_by_rays() const {
    static_assert(block_width <= 32);
    if (!of_any()) return ~std::uint32_t{0};
    std::array<float, block_width> least{};
    take_least(light_.data(), light_.size() / block_width, least.data());
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < block_width; ++k) bits |= std::uint32_t{least[k] < 0} << k;
    return bits;
  }
  /// Adds it to what receivers have.
  void add_to(const RaySink& into, std::span<const IntervalLight> block) const {
    constexpr std::size_t receivers_per_chunk = 1024;
    parallel_chunks(light_.size() / block_width, receivers_per_chunk,
                    [&](std::size_t begin, std::size_t end) {
                      for (std::size_t i = begin; i < end; ++i) {
                        std::array<double, block_width> E{};
                        bool any = false;
                        for (std::size_t k = 0; k < block.size(); ++k) {
                          if (!(light(i, k) > 0)) continue;
                          E[k] = block[k].dni * static_cast<double>(light(i, k));
                          any = true;
                        }
                        if (any) into.add_alike(i, E);
                      }
                    });
  }

 private:
  Columns light_;
};

/// Suns whose beams are looked at together: threads wait for each other once for all of them.
class RastersOfSuns {
 public:
  /// Of suns from `first` on, as many as have room; of beams that rays must ask for.
  RastersOfSuns(std::span<const SunBeams> beams, std::size_t first, std::uint32_t suns_by_rays)
      : first_(first) {
    constexpr std::size_t cells_at_a_time = std::size_t{1} << 21;
    struct Beam {
      std::size_t sun, beam;
      int size;
    };
    std::vector<Beam> all;
    for (std::size_t cells = 0; end() < beams.size();) {
      const SunBeams& of = beams[end()];
      const int size = raster_size(of.size());
      cells += of.size() * static_cast<std::size_t>(size * size);
      if (cells > cells_at_a_time && !all.empty()) break;
      for (std::size_t b = 0; b < of.size(); ++b)
        if (of[b].before >= 0 || (suns_by_rays >> end() & 1u) != 0)
          all.push_back({of_sun_.size(), b, size});
      of_sun_.emplace_back(of.size());
    }
    parallel_for(all.size(), [&](std::size_t i) {
      const auto [sun, b, size] = all[i];
      const SunBeams& of = beams[first_ + sun];
      of_sun_[sun][b].emplace(of[b].section, of[b].image, of.spread(), size);
    });
  }
  std::size_t suns() const { return of_sun_.size(); }
  std::size_t end() const { return first_ + suns(); }
  /// Of sun number first + i.
  std::span<const std::optional<BeamRaster>> of_sun(std::size_t i) const { return of_sun_[i]; }

 private:
  std::size_t first_;
  std::vector<std::vector<std::optional<BeamRaster>>> of_sun_;
};

/// Where receivers see the points of the sun that lie in these directions.
PacketDirections seen(const SunBeam& beam, const PacketDirections& sun) {
  float m[3][3];
  for (std::size_t row = 0; row < 3; ++row) {
    const Vec3 v = beam.image_of.rows[row];
    m[row][0] = static_cast<float>(v.x);
    m[row][1] = static_cast<float>(v.y);
    m[row][2] = static_cast<float>(v.z);
  }
  PacketDirections w;
  for (std::size_t l = 0; l < packet_size; ++l) {
    w.x[l] = m[0][0] * sun.x[l] + m[0][1] * sun.y[l] + m[0][2] * sun.z[l];
    w.y[l] = m[1][0] * sun.x[l] + m[1][1] * sun.y[l] + m[1][2] * sun.z[l];
    w.z[l] = m[2][0] * sun.x[l] + m[2][1] * sun.y[l] + m[2][2] * sun.z[l];
  }
  return w;
}

}  // namespace

std::vector<std::vector<MirroredSun>> once_reflected(std::span<const SunBeams> beams) {
  std::vector<std::vector<MirroredSun>> all(beams.size());
  for (std::size_t k = 0; k < beams.size(); ++k)
    for (std::size_t b = 0; b < beams[k].size() && beams[k][b].before < 0; ++b)
      all[k].push_back({beams[k][b].group, beams[k][b].triangles, beams[k][b].image});
  return all;
}

MirrorSun::MirrorSun(const RayCaster& caster, const MirrorGroups& groups, const LitShares& shares)
    : caster_(caster), groups_(groups), shares_(shares, groups) {}

/// The mirrored sun that the receivers of one cluster get, from one sun after the other.
class MirrorSun::PatchWork {
 public:
  PatchWork(const MirrorSun& mirror, const SunSampler& sampler, const Cluster& cluster,
            const OnceReflected& known, const RaySink& into)
      : m_(mirror),
        sampler_(sampler),
        cluster_(cluster),
        known_(known),
        into_(into),
        of_realization_(into.realizations()) {}

  /// Of sun k; by receivers that may lie in one of its beams.
  void receive(const IntervalLight& sun, std::size_t k, const SunBeams& beams,
               std::span<const std::optional<BeamRaster>> rasters) {
    near_.clear();
    std::uint64_t any = 0;
    const std::uint64_t all = ~std::uint64_t{0}, by_rays = known_.by_rays(cluster_, k);
    for (std::size_t b = 0; b < rasters.size(); ++b) {
      const std::uint64_t asked = beams[b].before < 0 ? by_rays : all;
      if (!rasters[b] || asked == 0 || !rasters[b]->may_meet(cluster_.corners)) continue;
      if (!columns_) columns_.emplace(sampler_, cluster_);
      const std::uint64_t which =
          rasters[b]->may_meet_each(columns_->corners, asked & facing(*columns_, beams[b].image));
      if (which == 0) continue;
      near_.push_back({b, which});
      any |= which;
    }
    sun_ = &sun;
    k_ = k;
    beams_ = &beams;
    for (; any != 0; any &= any - 1) {
      const auto place = static_cast<std::size_t>(std::countr_zero(any));
      by_beams_.clear();
      for (const auto& [b, which] : near_)
        if ((which >> place & 1) != 0) by_beams_.push_back(b);
      receive(cluster_.begin + place);
    }
  }

  std::uint64_t rays = 0;

 private:
  void receive(std::size_t patch) {
    const auto geometry = sampler_.geometry(patch);
    sampler_.seed(patch, sun_->number, seeds_);
    std::fill(of_realization_.begin(), of_realization_.end(), 0);
    for (std::size_t p = 0; p < sampler_.packets(); ++p) {
      const Packet origins = sampler_.origins(geometry, seeds_, p);
      const PacketDirections sun = sampler_.directions(*sun_, seeds_, p);
      for (const auto b : by_beams_) {
        const SunBeam& beam = (*beams_)[b];
        add_reflectances(beam, dot(geometry.normal, beam.image), p, origins, sun);
      }
    }
    const auto R = static_cast<double>(of_realization_.size());
    const double samples_each = static_cast<double>(sampler_.samples()) / R;
    into_.add_all(patch, k_,
                  [&](std::size_t r) { return sun_->dni * of_realization_[r] / samples_each; });
  }

  /// Adds Π rho_s · cosθ of the mirrors by which each sample sees the sun: back from
  /// the mirror that it looks at to the one that the sun shines on.
  void add_reflectances(const SunBeam& last, double cos_theta, std::size_t packet,
                        const Packet& origins, const PacketDirections& sun) {
    Packet points = origins;
    double weight[packet_size];
    std::fill_n(weight, packet_size, cos_theta);
    auto active = sampler_.active(packet);
    for (const SunBeam* beam = &last; active != 0;
         beam = &(*beams_)[static_cast<std::size_t>(beam->before)]) {
      active = step_back(*beam, seen(*beam, sun), active, points, weight);
      if (beam->before < 0) break;
    }
    if (active == 0) return;
    rays += static_cast<std::uint64_t>(std::popcount(active));
    const auto shares = m_.caster_.passed_each(points, sun, active);
    for (; active != 0; active &= active - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(active));
      of_realization_[sampler_.realization(packet * packet_size + l)] +=
          weight[l] * static_cast<double>(shares[l]);
    }
  }

  /// Moves points to the mirrors that they see along w; returns which see one of the beam.
  std::uint32_t step_back(const SunBeam& beam, const PacketDirections& w, std::uint32_t active,
                          Packet& points, double (&weight)[packet_size]) {
    rays += static_cast<std::uint64_t>(std::popcount(active));
    const auto hits = m_.caster_.first_hits(points, w, active, RayCaster::Coherence::parallel);
    const Vec3 n = m_.groups_[beam.group].normal;
    std::uint32_t on_mirror = 0;
    for (; active != 0; active &= active - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(active));
      const auto hit = hits[l];
      if (hit.left_scene() ||
          m_.groups_.of_side(hit.triangle, hit.front) != static_cast<std::int32_t>(beam.group))
        continue;
      on_mirror |= 1u << l;
      const double cos_theta = -dot(n, {w.x[l], w.y[l], w.z[l]});
      weight[l] *= m_.groups_.weight_of_hit(hit.triangle, cos_theta);
      put(points, l, lifted_point(m_.groups_.scene().mesh, hit, n, m_.caster_.offset_m()));
    }
    return on_mirror;
  }

  const MirrorSun& m_;
  const SunSampler& sampler_;
  const Cluster& cluster_;
  const OnceReflected& known_;
  const RaySink& into_;
  std::optional<ClusterColumns> columns_;  ///< once a beam comes near
  const IntervalLight* sun_ = nullptr;
  std::size_t k_ = 0;
  const SunBeams* beams_ = nullptr;
  struct NearBeam {
    std::size_t beam;
    std::uint64_t receivers;  ///< of the cluster that may lie in it, a bit each
  };
  std::vector<NearBeam> near_;
  std::vector<std::size_t> by_beams_;  ///< of the receiver at hand
  std::vector<double> of_realization_;
  SunSampler::Seeds seeds_;
};

/// Of patches, by suns that are points; nothing where rays tell all.
Columns MirrorSun::known_of(std::span<const IntervalLight> block,
                            std::span<const SunBeams> beams) const {
  const auto is_disk = [](const IntervalLight& sun) { return sun.disk_half_angle > 0; };
  if (std::any_of(block.begin(), block.end(), is_disk)) return {};
  return shares_.of(block, once_reflected(beams.first(block.size())));
}

std::uint64_t MirrorSun::add_light(const SunSampler& receivers,
                                   std::span<const IntervalLight> block,
                                   std::span<const SunBeams> beams, const RaySink& into) const {
  const bool any = std::any_of(beams.begin(), beams.end(),
                               [](const SunBeams& of_sun) { return of_sun.size() > 0; });
  if (!any) return 0;
  const OnceReflected known(receivers.are_points() ? Columns() : known_of(block, beams));
  known.add_to(into, block);
  const std::uint32_t suns_by_rays = known.suns_by_rays();
  const auto clusters = clusters_of(receivers);
  std::uint64_t rays = 0;
  for (std::size_t first = 0; first < block.size();) {
    const RastersOfSuns rasters(beams.first(block.size()), first, suns_by_rays);
    // A thread takes receivers with all suns, whose light is added up in their order.
    rays += ordered_sum(clusters.size(), 1, std::uint64_t{0}, [&](std::size_t c, std::size_t) {
      PatchWork work(*this, receivers, clusters[c], known, into);
      for (std::size_t i = 0; i < rasters.suns(); ++i) {
        const std::size_t k = first + i;
        work.receive(block[k], k, beams[k], rasters.of_sun(i));
      }
      return work.rays;
    });
    first = rasters.end();
  }
  return rays;
}

}  // namespace sunload
