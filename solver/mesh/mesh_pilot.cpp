// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/mesh_pilot.h"

#include <algorithm>
#include <cmath>

#include "solver/base/rng.h"
#include "solver/base/sampling.h"

namespace sunload {

namespace {

/// Of all surfaces: variants that differ in their diffuse reflectances get the same mesh, so that
/// their patches pair one to one.
constexpr double typical_reflectance = 0.3;
/// Points of emitters per half.
constexpr std::size_t emitter_points_per_half = 8;
/// Packets of directions from a luminaire whose beam an element may hold between its points.
constexpr std::size_t beam_packets = 2;

struct Moments {
  double mean = 0, variance = 0;
};

/// Over the points, by the covariance of both halves.
Moments moments(const std::array<std::vector<double>, halves_of_light>& at_point) {
  const std::size_t n = at_point[0].size();
  double mean[halves_of_light] = {};
  for (std::size_t h = 0; h < halves_of_light; ++h)
    for (const double x : at_point[h]) mean[h] += x / static_cast<double>(n);
  double variance = 0;
  for (std::size_t s = 0; s < n; ++s)
    variance += (at_point[0][s] - mean[0]) * (at_point[1][s] - mean[1]);
  return {(mean[0] + mean[1]) / 2, variance / static_cast<double>(n - 1)};
}

}  // namespace

MeshPilot::MeshPilot(const ElementForest& forest, const Scene& scene, const RayCaster& caster,
                     const PeriodLight& light, std::uint64_t seed)
    : forest_(forest),
      scene_(scene),
      caster_(caster),
      light_(light),
      seed_(seed),
      images_(scene, caster, light, seed),
      load_(2 * forest.elements().size(), 0.0f) {
  for (const IntensityWeb& web : scene.luminaires.webs) steps_.push_back(steps_of(web));
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    const double exitance = scene.material_of(t).emission_w_m2;
    if (exitance <= 0 || light.lamp_time_s <= 0) continue;
    const int sides = scene.mesh.triangle_sides[t] == Sides::two ? 2 : 1;
    emitted_power_ += sides * exitance * scene.mesh.area_m2(t);
    emitters_.push_back({static_cast<std::int32_t>(t), emitted_power_});
  }
  for (auto& emitter : emitters_) emitter.power_share /= emitted_power_;
}

void MeshPilot::set_load(std::size_t element, std::uint8_t side, double load) {
  load_[2 * element + side] = static_cast<float>(load);
}

void MeshPilot::add_children_of(std::size_t element) {
  load_.resize(2 * forest_.elements().size(), 0.0f);
  const auto child = static_cast<std::size_t>(forest_.elements()[element].first_child);
  for (const std::size_t c : {child, child + 1})
    for (std::size_t side = 0; side < 2; ++side) load_[2 * c + side] = load_[2 * element + side];
}

ElementLoad MeshPilot::load(const PilotSight& sight) const {
  const PilotPoints& points = sight.points();
  ElementLoad load;
  load.sees_sun = sight.sees_sun();
  load.largest_cosine = sight.largest_cosine();
  const LuminaireLoad luminaires = beams(points);
  std::array<std::vector<double>, halves_of_light> at_point, glints;
  for (std::size_t h = 0; h < halves_of_light; ++h) {
    at_point[h] = sight.straight(h);
    sight.add_reflected(
        h, [this](PilotSight::SideOfElement side) { return radiosity(side); }, at_point[h].data());
  }
  for (std::size_t p = 0; p < points.packets.size(); ++p) {
    double lamps[packet_size] = {}, common_glints[packet_size] = {};
    add_luminaires(points, luminaires.even, p, lamps);
    images_.add(images_.of_both_halves(), points.corners, points.packets[p], points.normal,
                common_glints);
    for (std::uint32_t h = 0; h < halves_of_light; ++h) {
      double* sum = &at_point[h][p * packet_size];
      if (!emitters_.empty()) add_emitters(points, p, h, sum, load);
      double glint[packet_size];
      std::copy_n(common_glints, packet_size, glint);
      images_.add(images_.of_half(h), points.corners, points.packets[p], points.normal, glint);
      glints[h].insert(glints[h].end(), glint, glint + packet_size);
      for (std::size_t r = 0; r < packet_size; ++r) sum[r] += lamps[r] + glint[r];
    }
  }
  const auto [mean, variance] = moments(at_point);
  const auto [glint_mean, glint_variance] = moments(glints);
  load.mean = mean + luminaires.mean;
  load.variance = variance + luminaires.variance;
  load.glint_mean = glint_mean;
  load.glint_variance = glint_variance;
  return load;
}

ElementLoad MeshPilot::sources(const PilotPoints& points) const {
  ElementLoad load;
  look_for_suns(points, load);
  double unused[packet_size] = {};
  for (std::size_t p = 0; p < points.packets.size() && !emitters_.empty(); ++p)
    for (std::uint32_t h = 0; h < halves_of_light; ++h) add_emitters(points, p, h, unused, load);
  return load;
}

/// From the highest one down: the first that some point sees is the one that counts.
void MeshPilot::look_for_suns(const PilotPoints& points, ElementLoad& load) const {
  std::vector<std::pair<double, Vec3>> suns;
  for (const auto* of : {&light_.suns, &light_.samples[0], &light_.samples[1]})
    for (const PeriodSun& sun : *of)
      if (const double cos_theta = dot(points.normal, sun.direction); cos_theta > 0)
        suns.emplace_back(cos_theta, sun.direction);
  std::sort(suns.begin(), suns.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [cos_theta, direction] : suns)
    for (const Packet& packet : points.packets)
      if (any_passed(caster_.passed_each(packet, same_for_all(direction), all_rays)) != 0) {
        load.sees_sun = true;
        load.largest_cosine = cos_theta;
        return;
      }
}

/// Points y on emitters by power: E(x) = mean of Φ cosθ cosθ' V / (π r²), the same y for all x.
void MeshPilot::add_emitters(const PilotPoints& points, std::size_t packet, std::uint32_t half,
                             double* sum, ElementLoad& load) const {
  const Mesh& mesh = scene_.mesh;
  const Packet& origins = points.packets[packet];
  const RandomWords& seeds = points.emitter_seeds[half];
  for (std::uint32_t s = 0; s < emitter_points_per_half; ++s) {
    const auto number = [&](int d) { return scrambled_sobol(s, d, seeds); };
    const auto emitter =
        std::lower_bound(emitters_.begin(), emitters_.end() - 1, number(0),
                         [](const Emitter& e, double share) { return e.power_share <= share; });
    const auto t = static_cast<std::size_t>(emitter->triangle);
    const Barycentric at = sample_triangle(number(1), number(2));
    const Vec3 y =
        mesh.corner(t, 0) * at.w0 + mesh.corner(t, 1) * at.w1 + mesh.corner(t, 2) * at.w2;
    const Vec3 front = normalized(mesh.area_vector2(t));
    const bool two_sided = mesh.triangle_sides[t] == Sides::two;
    PacketDirections directions;
    double kernel[packet_size] = {};
    std::uint32_t facing = 0;
    for (std::size_t r = 0; r < packet_size; ++r) {
      const Vec3 x{static_cast<double>(origins.x[r]), static_cast<double>(origins.y[r]),
                   static_cast<double>(origins.z[r])};
      const Vec3 to = y - x;
      const double r2 = dot(to, to), cos_r = dot(points.normal, to);
      const double cos_there_r = two_sided ? std::abs(dot(front, to)) : -dot(front, to);
      directions.x[r] = static_cast<float>(to.x);
      directions.y[r] = static_cast<float>(to.y);
      directions.z[r] = static_cast<float>(to.z);
      if (cos_r <= 0 || cos_there_r <= 0) continue;
      kernel[r] = cos_r * cos_there_r / (pi * r2 * r2);
      facing |= 1u << r;
    }
    if (facing == 0) continue;
    const PacketHits hits = caster_.first_hits(origins, directions, facing);
    const double weight = emitted_power_ * light_.lamp_time_s / emitter_points_per_half;
    for (std::size_t r = 0; r < packet_size; ++r) {
      if (!(facing >> r & 1u) || hits.triangle[r] != emitter->triangle) continue;
      sum[r] += weight * kernel[r];
      load.lamp_form_factor = std::max(load.lamp_form_factor, kernel[r] * points.area_m2);
    }
  }
}

MeshPilot::LuminaireLoad MeshPilot::beams(const PilotPoints& points) const {
  LuminaireLoad load;
  if (light_.lamp_time_s <= 0) return load;
  const std::array corners{forest_.corner(points.element, 0), forest_.corner(points.element, 1),
                           forest_.corner(points.element, 2)};
  for (const Luminaire& luminaire : scene_.luminaires.all) {
    if (dot(points.normal, luminaire.position - corners[0]) <= caster_.offset_m()) continue;
    if (const IntensitySteps& steps = steps_[luminaire.web]; !steps.cones.empty()) {
      const LuminaireView view(luminaire, steps, corners);
      if (view.is_dark()) continue;
      if (!view.is_even()) {
        add_beam(points, luminaire, view, load);
        continue;
      }
    }
    load.even.push_back(&luminaire);
  }
  return load;
}

/// By directions ω of density p from the luminaire: with E = I V cosθ / r² at the point that ω
/// meets, and dA = r² / cosθ dω,
///
///     mean E = 1/A ∫ I V dω,    mean E² = 1/A ∫ I V E dω
///
/// V is the share that passes.
void MeshPilot::add_beam(const PilotPoints& points, const Luminaire& luminaire,
                         const LuminaireView& view, LuminaireLoad& load) const {
  const double height = dot(points.normal, luminaire.position - points.corners[0]);
  double mean = 0, squares = 0;
  for (std::size_t p = 0; p < beam_packets; ++p) {
    Packet origins{}, ways{};
    double weight[packet_size] = {}, E[packet_size] = {};
    std::uint32_t facing = 0;
    for (std::size_t s = 0; s < packet_size; ++s) {
      const auto index = static_cast<std::uint32_t>(p * packet_size + s);
      const auto [w, density] = view.sample(scrambled_sobol(index, 2, points.beam_seeds),
                                            scrambled_sobol(index, 3, points.beam_seeds));
      const double cos_theta = -dot(points.normal, w);
      const double I = scene_.luminaires.intensity(luminaire, w);
      if (cos_theta <= 0 || I <= 0) continue;
      const double r = height / cos_theta;
      put(origins, s, luminaire.position + w * r);
      put(ways, s, w * -r);
      weight[s] = I / (density * points.area_m2 * beam_packets * packet_size);
      E[s] = light_.lamp_time_s * I * cos_theta / (r * r);
      facing |= 1u << s;
    }
    if (facing == 0) continue;
    const auto shares = caster_.passed_up_to(origins, ways, facing);
    for (std::size_t s = 0; s < packet_size; ++s) {
      if (!(facing >> s & 1u)) continue;
      const auto V = static_cast<double>(shares[s]);
      mean += light_.lamp_time_s * weight[s] * V;
      squares += light_.lamp_time_s * weight[s] * V * E[s] * V;
    }
  }
  load.mean += mean;
  load.variance += std::max(0.0, squares - mean * mean);
}

/// E(x) = I cosθ V / r².
void MeshPilot::add_luminaires(const PilotPoints& points,
                               const std::vector<const Luminaire*>& luminaires, std::size_t packet,
                               double* sum) const {
  const Packet& origins = points.packets[packet];
  for (const Luminaire* each : luminaires) {
    const Luminaire& luminaire = *each;
    PacketDirections ways{};
    double E[packet_size] = {};
    std::uint32_t facing = 0;
    for (std::size_t r = 0; r < packet_size; ++r) {
      const Vec3 way = luminaire.position - at(origins, r);
      const double cos_r = dot(points.normal, way), r2 = dot(way, way), length = std::sqrt(r2);
      if (cos_r <= 0) continue;
      E[r] = scene_.luminaires.intensity(luminaire, -way / length) * cos_r / (length * r2);
      if (E[r] <= 0) continue;
      put(ways, r, way);
      facing |= 1u << r;
    }
    if (facing == 0) continue;
    const auto shares = caster_.passed_up_to(origins, ways, facing);
    for (std::size_t r = 0; r < packet_size; ++r)
      if (facing >> r & 1u) sum[r] += light_.lamp_time_s * E[r] * static_cast<double>(shares[r]);
  }
}

double MeshPilot::radiosity(PilotSight::SideOfElement side) const {
  return typical_reflectance * static_cast<double>(load_[static_cast<std::size_t>(side)]);
}

}  // namespace sunload
