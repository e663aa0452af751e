// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/luminaire_points.h"

#include <cmath>

#include "solver/base/sampling.h"
#include "solver/base/spherical_triangle.h"

namespace sunload {

namespace {

/// Solid angle from which on directions are drawn [sr]: there they have nine digits and more, and
/// below it cosθ / r² hardly varies over the patch.
constexpr double least_solid_angle = 1e-3;

}  // namespace

/// A patch, or a sensor, before luminaires.
class LuminairePoints::Receiver {
 public:
  Receiver(const LuminairePoints& points, std::size_t receiver, LampRays& rays)
      : luminaires_(points.luminaires_),
        steps_(points.steps_),
        receiver_(receiver),
        rays_(rays),
        sampler_(rays.sampler()),
        geometry_(sampler_.geometry(receiver)),
        corners_(sampler_.corners(receiver)),
        lifted_(geometry_.normal * sampler_.offset_m()) {
    const auto& [a, b, c] = corners_;
    area_ = norm(cross(b - a, c - a)) / 2;
  }

  void receive(const Luminaire& luminaire) {
    const double height = dot(geometry_.normal, luminaire.position - corners_[0]);
    if (height <= sampler_.offset_m()) return;
    sampler_.seed(receiver_, static_cast<std::uint32_t>(luminaire.key), seeds_,
                  Purpose::luminaires);
    // Of a sensor, a point, there is no solid angle.
    if (area_ > 0) {
      if (const IntensitySteps& steps = steps_[luminaire.web]; !steps.cones.empty()) {
        const LuminaireView view(luminaire, steps, corners_);
        if (view.is_dark()) return;
        if (!view.is_even()) return receive_by(luminaire, view, height);
      }
      const auto& [a, b, c] = corners_;
      const Vec3 from = luminaire.position;
      const SphericalTriangle seen(a - from, b - from, c - from);
      if (seen.solid_angle() >= least_solid_angle) return receive_in(luminaire, seen, height);
    }
    receive_at_points(luminaire);
  }

 private:
  void receive_in(const Luminaire& luminaire, const SphericalTriangle& seen, double height) {
    receive_along(luminaire, height, [&](double u, double v) {
      return LuminaireView::Direction{seen.sample(u, v), 1 / seen.solid_angle()};
    });
  }

  void receive_by(const Luminaire& luminaire, const LuminaireView& view, double height) {
    receive_along(luminaire, height, [&](double u, double v) { return view.sample(u, v); });
  }

  /// `draw(u, v)`: a direction from the luminaire to the patch.
  template <class Draw>
  void receive_along(const Luminaire& luminaire, double height, const Draw& draw) {
    for (std::size_t p = 0; p < sampler_.packets(); ++p) {
      const ScrambledPoints points = sampler_.points(seeds_, p);
      LampRays::Look look;
      for (std::size_t l = 0; l < packet_size; ++l) {
        if ((sampler_.active(p) >> l & 1u) == 0) continue;
        const auto [w, density] = draw(points.u[l] * 0x1p-32, points.v[l] * 0x1p-32);
        const double below = -dot(geometry_.normal, w);
        const double I = luminaires_.intensity(luminaire, w);
        if (below <= 0 || I <= 0) continue;
        put(look.origins, l, luminaire.position + w * (height / below) + lifted_);
        look.add(l, -w, height / below, I / (density * area_));
      }
      rays_.look(receiver_, p, look, Purpose::luminaires);
    }
  }

  void receive_at_points(const Luminaire& luminaire) {
    for (std::size_t p = 0; p < sampler_.packets(); ++p) {
      LampRays::Look look{.origins = sampler_.origins(geometry_, seeds_, p)};
      for (std::size_t l = 0; l < packet_size; ++l) {
        if ((sampler_.active(p) >> l & 1u) == 0) continue;
        const Vec3 way = luminaire.position - at(look.origins, l);
        const double r = norm(way);
        const Vec3 w = way / r;
        const double cos_theta = dot(geometry_.normal, w);
        const double I = luminaires_.intensity(luminaire, -w);
        if (cos_theta > 0 && I > 0) look.add(l, w, r, I * cos_theta / (r * r));
      }
      rays_.look(receiver_, p, look, Purpose::luminaires);
    }
  }

  const Luminaires& luminaires_;
  const std::vector<IntensitySteps>& steps_;
  std::size_t receiver_;
  LampRays& rays_;
  const SunSampler& sampler_;
  SunSampler::Geometry geometry_;
  std::array<Vec3, 3> corners_;
  Vec3 lifted_;
  double area_;  ///< 0: of a sensor
  SunSampler::Seeds seeds_;
};

LuminairePoints::LuminairePoints(const Luminaires& luminaires) : luminaires_(luminaires) {
  for (const IntensityWeb& web : luminaires.webs) steps_.push_back(steps_of(web));
}

void LuminairePoints::shine_on(std::size_t receiver, LampRays& rays) const {
  if (!luminaires_.any()) return;
  Receiver before(*this, receiver, rays);
  for (const Luminaire& luminaire : luminaires_.all) before.receive(luminaire);
}

}  // namespace sunload
