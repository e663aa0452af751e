#include "solver/line_follower.h"

#include "geo/check.h"
#include "solver/oracle.h"

namespace sunload {

namespace {

/// Unit normal of the side of a triangle that was met.
Vec3 met_normal(const Mesh& mesh, const Hit& hit) {
  const Vec3 n = normalized(mesh.area_vector2(static_cast<std::size_t>(hit.triangle)));
  return hit.front ? n : -n;
}

}  // namespace

void LineCollector::clear() {
  patches.clear();
  sky.clear();
  sky_by_mirror.clear();
  ends = {};
}

LineCollector& LineCollector::operator+=(const LineCollector& other) {
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(patches, other.patches);
  append(sky, other.sky);
  append(sky_by_mirror, other.sky_by_mirror);
  ends.sky += other.ends.sky;
  ends.ground += other.ends.ground;
  ends.ground_by_mirror += other.ends.ground_by_mirror;
  ends.escaped += other.ends.escaped;
  ends.backs += other.ends.backs;
  ends.cut += other.ends.cut;
  return *this;
}

void LineCollector::store(LineSet& set, std::size_t row, int count) {
  const float scale = 1.0f / static_cast<float>(count);
  const std::size_t block = row / LinkTable::rows_per_block;
  LinkTable::append_row(set.patches.blocks[block], patches, scale);
  LinkTable::append_row(set.sky.blocks[block], sky, scale);
  LinkTable::append_row(set.sky_by_mirror.blocks[block], sky_by_mirror, scale);
  set.ends[row] = {ends.sky * scale,     ends.ground * scale, ends.ground_by_mirror * scale,
                   ends.escaped * scale, ends.backs * scale,  ends.cut * scale};
}

LineFollower::LineFollower(const Scene& scene, const Hierarchy& hierarchy,
                           const RayCaster& caster, const SkyGrid& grid, int mirror_depth,
                           double largest_link)
    : scene_(scene),
      hierarchy_(hierarchy),
      caster_(caster),
      grid_(grid),
      mirror_depth_(mirror_depth),
      largest_link_(largest_link) {}

const Material& LineFollower::material_of(std::int32_t triangle) const {
  return scene_.materials[scene_.material[static_cast<std::size_t>(triangle)].index()];
}

double LineFollower::mirror_of(std::size_t patch) const {
  return material_of(hierarchy_.patches()[patch].triangle).mirror;
}

Vec3 LineFollower::offset_point(std::int32_t triangle, const Hit& hit, Vec3 side_normal) const {
  const auto t = static_cast<std::size_t>(triangle);
  const Mesh& mesh = scene_.mesh;
  const Vec3 point = mesh.corner(t, 0) * (1 - hit.u - hit.v) + mesh.corner(t, 1) * hit.u +
                     mesh.corner(t, 2) * hit.v;
  return point + side_normal * caster_.offset_m();
}

/// The largest element about a patch that is still small as seen from the line's beginning.
/// Its centre lies as far away as the line has come, give or take its distance from `point`.
std::uint32_t LineFollower::linked_element(std::size_t patch, Vec3 point, double path_m) const {
  std::size_t element = patch;
  for (auto up = hierarchy_.parent(element); up >= 0; up = hierarchy_.parent(element)) {
    const auto& sphere = hierarchy_.sphere(static_cast<std::size_t>(up) - hierarchy_.patch_count());
    const Vec3 centre{static_cast<double>(sphere.x), static_cast<double>(sphere.y),
                      static_cast<double>(sphere.z)};
    const double distance_m = path_m - norm(centre - point);
    if (largest_form_factor(static_cast<double>(sphere.radius), distance_m) > largest_link_) break;
    element = static_cast<std::size_t>(up);
  }
  return static_cast<std::uint32_t>(element);
}

std::uint64_t LineFollower::follow(Vec3 origin, Vec3 w, const Hit& first, LineCollector& into) const {
  std::uint64_t rays = 0;
  double weight = 1, path_m = 0;
  Hit hit = first;
  for (int reflections = 0;; ++reflections) {
    const auto share = static_cast<float>(weight);
    if (hit.left_scene()) {
      into.ends.escaped += share;
      if (w.z > 0) {
        if (reflections == 0) into.ends.sky += share;
        (reflections == 0 ? into.sky : into.sky_by_mirror).push_back({sky_cell(w), share});
      } else {
        (reflections == 0 ? into.ends.ground : into.ends.ground_by_mirror) += share;
      }
      return rays;
    }
    const auto patch = hierarchy_.patch_at(hit.triangle, hit.u, hit.v, hit.front);
    if (patch < 0) {
      into.ends.backs += share;
      return rays;
    }
    path_m += hit.distance_m;
    const Material& material = material_of(hit.triangle);
    if (material.diffuse > 0 || material.emission_w_m2 > 0)
      into.patches.push_back({linked_element(static_cast<std::size_t>(patch),
                                             origin + w * hit.distance_m, path_m),
                              share});
    if (material.mirror <= 0) return rays;
    const Vec3 n = met_normal(scene_.mesh, hit);
    weight *= mirror_reflectance(material, -dot(w, n));
    if (reflections == mirror_depth_) {
      into.ends.cut += static_cast<float>(weight);
      return rays;
    }
    origin = offset_point(hit.triangle, hit, n);
    w = mirrored(-w, n);
    hit = caster_.first_hit(origin, w);
    ++rays;
  }
}

LineFollower::Fate LineFollower::mirrored_on(Vec3 origin, Vec3 w, std::size_t mirror_patch) const {
  const Vec3 n = hierarchy_.normal(mirror_patch);
  const double weight = mirror_reflectance(
      material_of(hierarchy_.patches()[mirror_patch].triangle), dot(w, n));
  const Vec3 away = mirrored(w, n);
  Fate fate = sent_on(away, weight, caster_.first_hit(origin, away));
  ++fate.rays;
  return fate;
}

LineFollower::Fate LineFollower::sent_on(Vec3 w, double weight, const Hit& first) const {
  Fate fate;
  if (mirror_depth_ < 1) {  // not even the first reflection is followed
    fate.cut = weight;
    return fate;
  }
  Hit hit = first;
  for (int reflections = 1;; ++reflections) {
    if (hit.left_scene()) {
      fate.escaped = weight;
      return fate;
    }
    if (hierarchy_.patch_at(hit.triangle, hit.u, hit.v, hit.front) < 0) {
      fate.backs = weight;
      return fate;
    }
    const Vec3 n = met_normal(scene_.mesh, hit);
    weight *= mirror_reflectance(material_of(hit.triangle), -dot(w, n));
    if (weight <= 0) return fate;
    if (reflections == mirror_depth_) {
      fate.cut = weight;
      return fate;
    }
    w = mirrored(-w, n);
    hit = caster_.first_hit(offset_point(hit.triangle, hit, n), w);
    ++fate.rays;
  }
}

}  // namespace sunload
