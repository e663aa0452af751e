#include "solver/mirror_sun.h"

#include <algorithm>
#include <bit>

#include "geo/check.h"
#include "solver/beam_raster.h"
#include "solver/parallel.h"

namespace sunload {

namespace {

constexpr std::size_t patches_per_task = 1024;

// Mirrors whose normals differ by less than this share their image directions:
// a fifth of the sun's radius, well above what rounding of large coordinates
// does to the normals of coplanar panes.
constexpr double same_orientation = 0.05 * radians_per_degree;

Vec3 unit_normal(const Mesh& mesh, std::size_t triangle) {
  return normalized(mesh.area_vector2(triangle));
}

}  // namespace

MirroredSun& MirroredSun::operator+=(const MirroredSun& other) {
  for (std::size_t k = 0; k < block_width; ++k) {
    escaped[k] += other.escaped[k];
    backs[k] += other.backs[k];
    cut[k] += other.cut[k];
  }
  return *this;
}

/// One sun by way of the mirrors of one orientation.
struct MirrorSun::Beam {
  std::size_t k;  ///< of the block
  const SunLight& sun;
  std::int32_t group;
  Vec3 image;     ///< direction in which receivers see the sun
  BeamRaster raster;
};

MirrorSun::MirrorSun(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                     const SunSampler& sampler, const PatchOptics& optics, int mirror_depth)
    : scene_(scene),
      hierarchy_(hierarchy),
      caster_(caster),
      sampler_(sampler),
      optics_(optics),
      mirror_depth_(mirror_depth),
      group_of_side_(2 * scene.mesh.triangle_count(), -1) {
  const double least_cosine = std::cos(same_orientation);
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    if (scene.materials[scene.material[t].index()].mirror <= 0) continue;
    const Vec3 front = unit_normal(scene.mesh, t);
    for (std::size_t side = 0; side < (scene.mesh.triangle_sides[t] == Sides::two ? 2 : 1); ++side) {
      const Vec3 n = side == 0 ? front : -front;
      auto group = std::find_if(groups_.begin(), groups_.end(), [&](const MirrorGroup& g) {
        return dot(g.normal, n) >= least_cosine;
      });
      if (group == groups_.end()) group = groups_.insert(groups_.end(), MirrorGroup{n, {}});
      group_of_side_[2 * t + side] = static_cast<std::int32_t>(group - groups_.begin());
      group->triangles.push_back(static_cast<std::int32_t>(t));
    }
  }
}

/// The work of patches in one task: mirrored sun that arrives, or is sent on.
class MirrorSun::PatchWork {
 public:
  PatchWork(const MirrorSun& mirror, std::size_t realizations)
      : m_(mirror), per_realization_(realizations) {}

  /// Irradiance of a patch by the mirrors of a beam.
  void receive(const Beam& beam, std::size_t patch, Columns& irradiance,
               std::vector<std::vector<double>>& exposure,
               std::vector<Columns>* of_realizations) {
    const auto geometry = m_.sampler_.geometry(patch);
    const double cos_theta = dot(geometry.normal, beam.image);
    if (cos_theta <= 0) return;
    std::fill(per_realization_.begin(), per_realization_.end(), 0);
    for_each_packet(geometry, patch, beam.sun.number,
                    [&](std::size_t first, const Packet& origins, std::uint32_t active) {
                      add_reflectances(beam, first, origins, active);
                    });
    const auto R = static_cast<double>(per_realization_.size());
    const double samples_each = static_cast<double>(m_.sampler_.samples()) / R;
    const std::size_t at = patch * block_width + beam.k;
    double pooled = 0;
    for (std::size_t r = 0; r < per_realization_.size(); ++r) {
      const double E = beam.sun.dni * cos_theta * per_realization_[r] / samples_each;
      pooled += E / R;
      exposure[r][patch] += E * beam.sun.length_s;
      if (of_realizations) (*of_realizations)[r][at] += static_cast<float>(E);
    }
    irradiance[at] += static_cast<float>(pooled);
  }

  /// Direct sun that a mirror patch receives, followed to its end.
  void send_on(const LineFollower& follower, const SunLight& sun, std::size_t k, std::size_t patch,
               std::vector<MirroredSun>& fates) {
    const auto geometry = m_.sampler_.geometry(patch);
    const double cos_theta = dot(geometry.normal, sun.direction);
    if (cos_theta <= 0) return;
    const double samples_each =
        static_cast<double>(m_.sampler_.samples()) / static_cast<double>(fates.size());
    const double power_per_sample =
        m_.hierarchy_.area()[patch] * sun.dni * cos_theta / samples_each;
    const Vec3 away = mirrored(sun.direction, geometry.normal);
    const double weight = mirror_reflectance(
        m_.material_of(m_.hierarchy_.patches()[patch].triangle), cos_theta);
    for_each_packet(geometry, patch, sun.number,
                    [&](std::size_t first, const Packet& origins, std::uint32_t active) {
                      const auto lit = m_.caster_.unoccluded(origins, sun.direction, active);
                      rays += count(active) + count(lit);
                      const auto hits = m_.caster_.first_hits(origins, away, lit);
                      for (auto bits = lit; bits != 0; bits &= bits - 1) {
                        const auto l = static_cast<std::size_t>(std::countr_zero(bits));
                        const auto fate = follower.sent_on(away, weight, hits[l]);
                        rays += fate.rays;
                        auto& book = fates[m_.sampler_.realization(first + l)];
                        book.escaped[k] += power_per_sample * fate.escaped;
                        book.backs[k] += power_per_sample * fate.backs;
                        book.cut[k] += power_per_sample * fate.cut;
                      }
                    });
  }

  std::uint64_t rays = 0;

 private:
  static std::uint64_t count(std::uint32_t bits) {
    return static_cast<std::uint64_t>(std::popcount(bits));
  }

  /// visit(number of the first sample, origins, active) for every packet of samples.
  template <class Visit>
  void for_each_packet(const SunSampler::Geometry& geometry, std::size_t patch, std::uint32_t sun,
                       Visit&& visit) {
    m_.sampler_.seed(patch, sun, seeds_);
    for (std::size_t p = 0; p < m_.sampler_.packets(); ++p)
      visit(p * packet_size, m_.sampler_.origins(geometry, seeds_, p), m_.sampler_.active(p));
  }

  /// Adds rho_s of the mirror by which each sample sees the sun.
  void add_reflectances(const Beam& beam, std::size_t first, const Packet& origins,
                        std::uint32_t active) {
    const auto hits = m_.caster_.first_hits(origins, beam.image, active);
    const Vec3 n = m_.groups_[static_cast<std::size_t>(beam.group)].normal;
    const Vec3 lift = n * m_.caster_.offset_m();
    Packet at_mirror{};
    std::uint32_t on_mirror = 0;
    for (auto bits = active; bits != 0; bits &= bits - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(bits));
      if (hits.triangle[l] < 0) continue;
      const auto side = 2 * static_cast<std::size_t>(hits.triangle[l]) + (hits.front[l] ? 0u : 1u);
      if (m_.group_of_side_[side] != beam.group) continue;
      on_mirror |= 1u << l;
      const Vec3 along = beam.image * static_cast<double>(hits.distance[l]) + lift;
      at_mirror.x[l] = static_cast<float>(static_cast<double>(origins.x[l]) + along.x);
      at_mirror.y[l] = static_cast<float>(static_cast<double>(origins.y[l]) + along.y);
      at_mirror.z[l] = static_cast<float>(static_cast<double>(origins.z[l]) + along.z);
    }
    rays += count(active) + count(on_mirror);
    if (on_mirror == 0) return;
    auto lit = m_.caster_.unoccluded(at_mirror, beam.sun.direction, on_mirror);
    for (; lit != 0; lit &= lit - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(lit));
      per_realization_[m_.sampler_.realization(first + l)] +=
          mirror_reflectance(m_.material_of(hits.triangle[l]), dot(n, beam.sun.direction));
    }
  }

  const MirrorSun& m_;
  std::vector<double> per_realization_;
  SunSampler::Seeds seeds_;
};

std::uint64_t MirrorSun::add_light(std::span<const SunLight> block, Columns& irradiance,
                                   std::vector<std::vector<double>>& exposure,
                                   std::vector<Columns>* of_realizations) const {
  std::uint64_t rays = 0;
  for (std::size_t k = 0; k < block.size(); ++k) {
    const SunLight& sun = block[k];
    if (!sun.has_sun() || sun.dni <= 0 || mirror_depth_ < 1) continue;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const double towards = dot(sun.direction, groups_[g].normal);
      if (towards <= 0) continue;
      const Vec3 image = sun.direction - 2 * towards * groups_[g].normal;
      const Beam beam{k, sun, static_cast<std::int32_t>(g), image,
                      BeamRaster(scene_.mesh, groups_[g].triangles, image)};
      rays += ordered_sum(
          hierarchy_.patch_count(), patches_per_task, std::uint64_t{0},
          [&](std::size_t begin, std::size_t end) {
            PatchWork work(*this, exposure.size());
            for (std::size_t i = begin; i < end; ++i)
              if (beam.raster.may_meet(hierarchy_.corner(i, 0), hierarchy_.corner(i, 1),
                                       hierarchy_.corner(i, 2)))
                work.receive(beam, i, irradiance, exposure, of_realizations);
            return work.rays;
          });
    }
  }
  return rays;
}

std::vector<MirroredSun> MirrorSun::follow_light(std::span<const SunLight> block,
                                                 std::size_t realizations) const {
  // The sun's light is received after one reflection at most; what would be
  // mirrored a second time is cut.
  constexpr int reflections_of_the_sun = 1;
  const SkyGrid smallest_grid(2);  // where the light leaves is not asked
  const LineFollower follower(scene_, hierarchy_, caster_, smallest_grid,
                              std::min(mirror_depth_, reflections_of_the_sun));
  std::vector<std::size_t> mirrors;
  for (std::size_t i = 0; i < hierarchy_.patch_count(); ++i)
    if (optics_.mirror[i] > 0) mirrors.push_back(i);

  constexpr std::size_t mirrors_per_task = 64;
  std::vector<std::vector<MirroredSun>> parts(
      (mirrors.size() + mirrors_per_task - 1) / mirrors_per_task,
      std::vector<MirroredSun>(realizations));
  parallel_chunks(mirrors.size(), mirrors_per_task, [&](std::size_t begin, std::size_t end) {
    PatchWork work(*this, realizations);
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < block.size(); ++k)
        if (block[k].has_sun() && block[k].dni > 0)
          work.send_on(follower, block[k], k, mirrors[i], parts[begin / mirrors_per_task]);
  });
  std::vector<MirroredSun> fates(realizations);
  for (const auto& part : parts)
    for (std::size_t r = 0; r < realizations; ++r) fates[r] += part[r];
  return fates;
}

}  // namespace sunload
