// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A first look at the light of the whole period: how much falls on an element, and how much that
/// varies inside of it. Only the mesh is decided by it; no number of a result is made from it.
///
/// Light comes from parallel directions (suns of the period with their exposure), from these by one
/// mirror, from emitters of the scene, from the sky and the far ground, and from surfaces after one
/// diffuse reflection. It is seen from the same points of the element along the same directions, so
/// that the differences between the points are those of the light and not of its sampling. A beam
/// of a luminaire that may lie between the points is asked by directions of its own: its mean, and
/// how much it varies.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/sky/sky.h"
#include "solver/mesh/element_forest.h"
#include "solver/mesh/period_light.h"
#include "solver/mesh/pilot_sight.h"
#include "solver/mesh/sun_images.h"
#include "solver/surface/luminaire_view.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// What one side of an element receives.
struct ElementLoad {
  double mean = 0;        ///< light load [J m-2]
  double variance = 0;    ///< of the light load over its points; estimated without the variance of
                          ///< the sampling, hence below zero at times [J2 m-4]
  double glint_mean = 0;  ///< of the part that comes by mirrors
  double glint_variance = 0;
  bool sees_sun = false;        ///< some point sees some sun
  double largest_cosine = 0;    ///< of the suns that it sees
  double lamp_form_factor = 0;  ///< largest disc estimate from a point of an emitter that it sees
};

/// Answers for one side of an element at a time; the answers are the same bits for any number of
/// threads.
class MeshPilot {
 public:
  /// All must outlive it; the forest may grow. `scene` has the forest's geometry and materials of
  /// its own.
  MeshPilot(const ElementForest& forest, const Scene& scene, const RayCaster& caster,
            const PeriodLight& light, std::uint64_t seed);

  /// Points on one side (0 front, 1 back) of an element: large ones have more packets.
  PilotPoints points(std::size_t element, std::uint8_t side, double min_area_m2) const {
    return {forest_, element, side, caster_.offset_m(), min_area_m2, seed_};
  }
  /// What is seen from there, which serves all pilots that see alike.
  PilotSight sight(std::size_t element, std::uint8_t side, double min_area_m2) const {
    return {forest_, caster_, light_, grid_, points(element, side, min_area_m2)};
  }
  bool sees_as(const MeshPilot& other) const {
    return &forest_ == &other.forest_ && &caster_ == &other.caster_ && &light_ == &other.light_ &&
           seed_ == other.seed_;
  }

  /// Load of the side that has that sight. Cost: 16 rays for every mirror image of a sun, point of
  /// an emitter and luminaire, and packet.
  ElementLoad load(const PilotSight& sight) const;

  /// Which sources an element's side sees, and how: `sees_sun`, `largest_cosine` and
  /// `lamp_form_factor` alone, as `load` has them, in a small part of its time.
  ElementLoad sources(const PilotPoints& points) const;

  /// Whether suns are seen in mirrors, wherever that may be.
  bool has_glints() const { return images_.any(); }

  /// Light load that surfaces are taken to receive where others see them, per element and side.
  void set_load(std::size_t element, std::uint8_t side, double load);
  double load_of(std::size_t element, std::uint8_t side) const {
    return static_cast<double>(load_[2 * element + side]);
  }
  /// A new element takes the load of its parent until its own is set.
  void add_children_of(std::size_t element);

 private:
  struct Emitter {
    std::int32_t triangle;
    double power_share;  ///< of this one and all before it
  };
  void look_for_suns(const PilotPoints& points, ElementLoad& load) const;
  void add_emitters(const PilotPoints& points, std::size_t packet, std::uint32_t half, double* sum,
                    ElementLoad& load) const;
  /// Luminaires to which an element is even, and what the beams of the others bring.
  struct LuminaireLoad {
    std::vector<const Luminaire*> even;
    double mean = 0, variance = 0;
  };
  LuminaireLoad beams(const PilotPoints& points) const;
  void add_beam(const PilotPoints& points, const Luminaire& luminaire, const LuminaireView& view,
                LuminaireLoad& load) const;
  void add_luminaires(const PilotPoints& points, const std::vector<const Luminaire*>& luminaires,
                      std::size_t packet, double* sum) const;
  double radiosity(PilotSight::SideOfElement side) const;

  const ElementForest& forest_;
  const Scene& scene_;
  const RayCaster& caster_;
  const PeriodLight& light_;
  std::uint64_t seed_;
  SkyGrid grid_;
  std::vector<Emitter> emitters_;
  double emitted_power_ = 0;  ///< of all of them [W]
  SunImages images_;
  std::vector<IntensitySteps> steps_;  ///< per web of the luminaires
  std::vector<float> load_;            ///< [2·element + side] J m-2
};

}  // namespace sunload
