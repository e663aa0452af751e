#include "solver/lamps.h"

#include <algorithm>
#include <bit>

#include "geo/units.h"
#include "solver/sampling.h"

namespace sunload {

namespace {

/// Clusters that a patch weighs against each other: their table costs about as much as a
/// tenth of its lines.
constexpr std::size_t most_clusters = 256;

/// Place along a curve that keeps neighbours together (Morton 1966), 10 bits an axis.
std::uint32_t morton(Vec3 p, const Box& box) {
  const auto spread = [](double x, double low, double high) {
    constexpr double steps = 1023;
    auto bits = static_cast<std::uint32_t>(high > low ? steps * (x - low) / (high - low) : 0);
    bits = (bits | bits << 16) & 0x030000ffu;
    bits = (bits | bits << 8) & 0x0300f00fu;
    bits = (bits | bits << 4) & 0x030c30c3u;
    return (bits | bits << 2) & 0x09249249u;
  };
  return spread(p.x, box.low.x, box.high.x) | spread(p.y, box.low.y, box.high.y) << 1 |
         spread(p.z, box.low.z, box.high.z) << 2;
}

}  // namespace

Lamps::Lamps(const Scene& scene, const Hierarchy& hierarchy)
    : source_of_side_(2 * scene.mesh.triangle_count(), -1) {
  std::vector<Vec3> middles;
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    const Material& material = scene.materials[scene.material[t].index()];
    const double exitance = material.emission_w_m2;
    if (exitance <= 0) continue;
    const Vec3 a = scene.mesh.corner(t, 0), twice_area = scene.mesh.area_vector2(t);
    for (const bool front : {true, false}) {
      constexpr double third = 1.0 / 3;
      if (hierarchy.patch_at(static_cast<std::int32_t>(t), third, third, front) < 0) continue;
      const double area = norm(twice_area) / 2;
      const Vec3 n = twice_area / (2 * area);
      sources_.push_back({a, scene.mesh.corner(t, 1) - a, scene.mesh.corner(t, 2) - a,
                          front ? n : -n, exitance, area, 1 - material.transmittance,
                          static_cast<std::int32_t>(2 * t + (front ? 0 : 1))});
      middles.push_back(a + (sources_.back().ab + sources_.back().ac) / 3);
    }
  }
  const Box box = bounding_box(middles);
  std::stable_sort(sources_.begin(), sources_.end(), [&](const Source& one, const Source& other) {
    const auto place = [&](const Source& s) { return morton(s.a + (s.ab + s.ac) / 3, box); };
    return place(one) < place(other);
  });
  const std::size_t each = (sources_.size() + most_clusters - 1) / most_clusters;
  for (std::size_t begin = 0; begin < sources_.size(); begin += each)
    add_cluster(begin, std::min(begin + each, sources_.size()));
  for (std::size_t s = 0; s < sources_.size(); ++s)
    source_of_side_[static_cast<std::size_t>(sources_[s].side)] = static_cast<std::int32_t>(s);
}

void Lamps::add_cluster(std::size_t begin, std::size_t end) {
  Cluster cluster{begin, end, {}, 0, 0};
  for (std::size_t s = begin; s < end; ++s) {
    const Source& source = sources_[s];
    const double power = source.exitance * source.area;
    cluster.centre += power * (source.a + (source.ab + source.ac) / 3);
    cluster.power += power;
  }
  cluster.centre = cluster.centre / cluster.power;
  double power = 0;
  for (std::size_t s = begin; s < end; ++s) {
    Source& source = sources_[s];
    for (const Vec3 p : {source.a, source.a + source.ab, source.a + source.ac})
      cluster.radius = std::max(cluster.radius, norm(p - cluster.centre));
    power += source.exitance * source.area;
    source.cluster = clusters_.size();
    source.up_to = power / cluster.power;
  }
  clusters_.push_back(cluster);
}

LampView::LampView(const Lamps& lamps)
    : lamps_(lamps), chance_(lamps.clusters_.size()), up_to_(lamps.clusters_.size()) {}

/// Not normalised; 0 where no point of the patch and none of the cluster see each other's front.
double LampView::chance(const Lamps::Cluster& cluster) const {
  const Vec3 way = cluster.centre - centroid_;
  const double reach = radius_ + cluster.radius;
  if (dot(normal_, way) <= -reach) return 0;
  const bool is_single = cluster.end == cluster.begin + 1;
  if (is_single && dot(lamps_.sources_[cluster.begin].normal, way) >= reach) return 0;
  return cluster.power / (dot(way, way) + reach * reach);
}

void LampView::look_from(const Hierarchy& hierarchy, std::size_t patch) {
  a_ = hierarchy.corner(patch, 0);
  ab_ = hierarchy.corner(patch, 1) - a_;
  ac_ = hierarchy.corner(patch, 2) - a_;
  normal_ = hierarchy.normal(patch);
  centroid_ = hierarchy.centroid(patch);
  radius_ = 0;
  for (std::size_t k = 0; k < 3; ++k)
    radius_ = std::max(radius_, norm(hierarchy.corner(patch, k) - centroid_));
  choose_clusters();
}

void LampView::look_from(Vec3 position, Vec3 normal) {
  a_ = centroid_ = position;
  ab_ = ac_ = {0, 0, 0};
  normal_ = normal;
  radius_ = 0;
  choose_clusters();
}

void LampView::choose_clusters() {
  double sum = 0;
  for (std::size_t c = 0; c < chance_.size(); ++c) {
    chance_[c] = chance(lamps_.clusters_[c]);
    sum += chance_[c];
    up_to_[c] = sum;
  }
  if (sum <= 0) return;
  for (std::size_t c = 0; c < chance_.size(); ++c) {
    chance_[c] /= sum;
    up_to_[c] /= sum;
  }
}

/// Of points drawn on a source [m-2].
double LampView::density(const Lamps::Source& source) const {
  return chance_[source.cluster] * source.exitance / lamps_.clusters_[source.cluster].power;
}

LampView::Point LampView::point(double u, double v) const {
  // What is left of u after a choice is uniform again.
  const auto chosen = [&u](double low, double high) {
    constexpr double below_one = 1 - 0x1p-53;
    u = std::clamp((u - low) / (high - low), 0.0, below_one);
  };
  const auto c = std::min(
      static_cast<std::size_t>(std::upper_bound(up_to_.begin(), up_to_.end(), u) - up_to_.begin()),
      up_to_.size() - 1);
  chosen(up_to_[c] - chance_[c], up_to_[c]);
  const auto& cluster = lamps_.clusters_[c];
  std::size_t s = cluster.begin;
  while (s + 1 < cluster.end && lamps_.sources_[s].up_to <= u) ++s;
  chosen(s > cluster.begin ? lamps_.sources_[s - 1].up_to : 0, lamps_.sources_[s].up_to);
  const auto& source = lamps_.sources_[s];
  const Barycentric at = sample_triangle(u, v);
  return {source.a + at.w1 * source.ab + at.w2 * source.ac, source.normal, source.exitance,
          density(source)};
}

double LampView::seen_by_line(const Hit& hit, Vec3 w, double cos_theta) const {
  if (hit.left_scene()) return 0;
  const auto s = lamps_.source_of_side_[2 * static_cast<std::size_t>(hit.triangle) +
                                        (hit.front ? 0u : 1u)];
  if (s < 0) return 0;
  const auto& source = lamps_.sources_[static_cast<std::size_t>(s)];
  const double cos_source = std::max(0.0, -dot(w, source.normal));
  // g / (g + q) without dividing by the distance, which may be all but 0.
  const double g = cos_theta * cos_source;
  const double q = pi * hit.distance_m * hit.distance_m * density(source);
  // Lines that a screen stops stand for those that it lets pass.
  return source.exitance / source.stopped * (g + q > 0 ? g / (g + q) : 1);
}

LampView::Seen LampView::seen_by_points(const RayCaster& caster, const RandomWords& seeds,
                                        std::size_t count) const {
  Seen seen;
  if (up_to_.empty() || up_to_.back() <= 0) return seen;
  const double offset = caster.offset_m();
  for (std::size_t first = 0; first < count; first += packet_size) {
    Packet origins{}, ways{};
    double light[packet_size] = {};
    std::uint32_t active = 0;
    for (std::size_t l = 0; l < std::min(packet_size, count - first); ++l) {
      double x[sobol_dimensions];
      for (int d = 0; d < sobol_dimensions; ++d)
        x[d] = owen_scrambled(sobol(static_cast<std::uint32_t>(first + l), d),
                              seeds[static_cast<std::size_t>(d)]) * 0x1p-32;
      const Barycentric at = sample_triangle(x[0], x[1]);
      const Vec3 origin = a_ + at.w1 * ab_ + at.w2 * ac_ + normal_ * offset;
      const Point lamp = point(x[2], x[3]);
      const Vec3 way = lamp.position - origin;
      const double distance_2 = dot(way, way);
      // cosθ_x cosθ_y |y - x|²
      const double cosines = std::max(0.0, dot(normal_, way)) * std::max(0.0, -dot(lamp.normal, way));
      if (cosines <= 0 || distance_2 <= offset * offset) continue;
      const double g = cosines / (pi * distance_2 * distance_2);
      light[l] = lamp.exitance * g / (g + lamp.density);
      put(origins, l, origin);
      put(ways, l, way + lamp.normal * offset);
      active |= 1u << l;
    }
    if (active == 0) continue;
    seen.rays += static_cast<std::uint64_t>(std::popcount(active));
    for (auto bits = caster.unoccluded_up_to(origins, ways, active); bits != 0; bits &= bits - 1)
      seen.sum += light[std::countr_zero(bits)];
  }
  return seen;
}

}  // namespace sunload
