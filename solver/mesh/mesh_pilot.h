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

  /// Load of one side (0 front, 1 back) of an element. Cost: 16 rays for every direction and
  /// packet of points; large elements have more packets.
  ElementLoad load(std::size_t element, std::uint8_t side, double min_area_m2) const;

  /// Which sources an element's side sees, and how: `sees_sun`, `largest_cosine` and
  /// `lamp_form_factor` alone, as `load` has them, in a small part of its time.
  ElementLoad sources(std::size_t element, std::uint8_t side, double min_area_m2) const;

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
  struct Points;
  struct Emitter {
    std::int32_t triangle;
    double power_share;  ///< of this one and all before it
  };
  void add_suns(const Points& points, const std::vector<PeriodSun>& suns, Vec3 normal,
                std::size_t packet, double* sum, ElementLoad& load) const;
  void look_for_suns(const Points& points, ElementLoad& load) const;
  void add_emitters(const Points& points, std::size_t packet, std::uint32_t half, double area_m2,
                    double* sum, ElementLoad& load) const;
  /// Luminaires to which an element is even, and what the beams of the others bring.
  struct LuminaireLoad {
    std::vector<const Luminaire*> even;
    double mean = 0, variance = 0;
  };
  LuminaireLoad beams(const Points& points, std::size_t element) const;
  void add_beam(const Points& points, const Luminaire& luminaire, const LuminaireView& view,
                double area_m2, LuminaireLoad& load) const;
  void add_luminaires(const Points& points, const std::vector<const Luminaire*>& luminaires,
                      std::size_t packet, double* sum) const;
  void add_surroundings(const Points& points, std::size_t packet, std::uint32_t half,
                        double* sum) const;
  /// Of the side that a ray has met.
  double radiosity(std::int32_t leaf, bool front) const;

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
