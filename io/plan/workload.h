// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the costs of a variant are made of, as far as that is known before it starts: receivers,
/// lines, suns, solutions. What these take: io/plan/work_estimate, memory_estimate, disk_estimate.
#pragma once

#include "io/plan/disk_estimate.h"
#include "io/plan/variant_plan.h"
#include "solver/accuracy.h"

namespace sunload {

/// Solutions that serve all intervals of a period, where few do.
struct YearNodes {
  double skies = 0, suns = 0;
  double all() const { return skies + suns; }
};

/// Of all seasons together but where said. Counts are doubles: sums of them pass 64 bits.
struct Workload {
  const VariantPlan& plan;
  SampleCounts counts;

  double patches = 0;    ///< without sensors, which have a pace of their own
  double receivers = 0;  ///< patches and sensors
  double seasons = 1;    ///< each is a scene of its own: lines, and solutions of a year
  double bands = 1;

  bool has_mirrors = false;
  bool is_guided = false;  ///< lines look for bright surfaces
  bool by_matrix = false, shoots = false;
  bool of_few = false;       ///< few solutions serve the period
  bool of_instants = false;  ///< standard errors of each interval

  double lines_of_patches = 0, lines = 0;  ///< of one season: of patches, of all receivers
  double links = 0;                        ///< of one season, those of each bounce counted

  double lit = 0;          ///< intervals with light
  double suns = 0;         ///< all those that stand for one interval counted
  double shining = 0;      ///< of these: that bring direct light
  double grid_points = 0;  ///< between which suns for what is straight are interpolated; 0: none
  double batch = 0;        ///< intervals of a batch
  double batches = 0;

  YearNodes nodes = {};  ///< of each season
  double solved = 0;     ///< intervals and nodes that are solved in full
  double near_suns = 0;  ///< of these: that look at the bright sky about their sun by rays

  double kinds = 0;  ///< of light: total, direct, sky, reflected, and what the scene has besides
  double kept_kinds = 0;    ///< that a batch holds at once
  double stored_kinds = 0;  ///< that have series, standard errors of instants among them
  double value_bytes = 0;   ///< of one stored value of a series
  SeriesBytes series = {};
  PartCost periods = {};     ///< parts of the period that have totals
  double suns_of_parts = 0;  ///< that these are, solved side by side as suns

  /// Lanes that the sun's geometry is looked at for: points of a grid where there is one, and what
  /// is interpolated between them at its share of the cost.
  double looked_at() const;
  /// What few solutions keep of one season [bytes].
  double node_bytes() const;
  /// What a batch keeps of each receiver and band for the totals [bytes].
  double batch_sum_bytes() const;
};
Workload workload(const VariantPlan& plan, std::size_t patches, const SampleCounts& counts);

/// Rays and samples that are not lines.
struct WorkloadRays {
  double to_sun = 0, of_sensors = 0, circumsolar = 0, to_luminaires = 0;
  double all() const { return to_sun + of_sensors + circumsolar + to_luminaires; }
};
WorkloadRays rays_of(const Workload& work);

/// Samples of all shots; 0 where nothing is shot. Throws InputError for more than can be counted.
struct ShotSamples {
  double all = 0, of_one_shot = 0;
};
ShotSamples shot_samples(const Workload& work);

/// Whether few solutions will serve the period, as far as that is known before they are tried.
bool is_year_of_few(const VariantPlan& plan);

// Parts of these, of what is tried before (io/plan/work_probe).
/// Patches that look at the bright sky about the sun by rays; shooting leaves it to lines.
double circumsolar_receivers(const VariantPlan& plan, std::size_t patches);
/// Patches to which rays tell of the sun: where edges of shadows cross what sends light on by rays,
/// or the sun has a disk, and behind screens.
double asked_by_rays(const VariantPlan& plan, std::size_t patches);
/// Sensors, each as often as the suns of the half space above the horizon that it faces.
double sensors_that_face(const VariantPlan& plan);
bool any_sends_on(const VariantPlan& plan);
bool any_emits(const VariantPlan& plan);
double band_factor(const VariantPlan& plan);

}  // namespace sunload
