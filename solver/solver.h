// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The method on one screen: trace once, light many suns.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/base/watch.h"
#include "solver/first_light/glossy_sun.h"
#include "solver/first_light/mirror_chains.h"
#include "solver/first_light/mirror_sun.h"
#include "solver/first_light/parallel_light.h"
#include "solver/gather/band_light.h"
#include "solver/gather/block_light.h"
#include "solver/gather/jacobi.h"
#include "solver/light/tally.h"
#include "solver/light/transport.h"
#include "solver/lines/lines.h"
#include "solver/mesh/hierarchy.h"
#include "solver/shoot/first_mirrored.h"

namespace sunload {

class Shooter;
struct ShotLight;
struct SunColumns;
struct TimeSums;
struct TracedLight;

struct SolverRules {
  int bounces = 5;  ///< light reflected diffusely 1 … bounces times is followed
  /// Fewer bounces (and mirrors of the sun) where less than this is left.
  double unshot = 1e-3;
  int lines_per_patch = 256;             ///< over all realizations
  std::vector<int> lines_of_patch = {};  ///< if they differ; sensors have lines_per_patch
  int direct_samples = 16;               ///< per patch and sun, over all realizations
  int realizations = 8;
  int mirror_depth = 8;
  double faint_glint = 0.02;  ///< share of the sun below which light reflected again is no beam
  int most_sun_beams = 128;   ///< sequences of mirror orientations per sun that are beams
  /// Orientations that face a sun of which sensors get the first reflection, where no beams stand;
  /// of more they get none.
  int most_sensor_beams = 1 << 16;
  /// A link leads to an element above the leaves where no more than so many of a
  /// patch's lines can be expected to meet it; 0: to leaves only.
  double link_threshold = 0;
  std::uint64_t seed = 1;
  std::string isa = "auto";
  Errors errors = Errors::totals;
  Bands bands = Bands::broadband;  ///< rgb when gathering only
  Transport transport = Transport::gather;
  Jacobi jacobi = Jacobi::incremental;       ///< when shooting
  std::optional<double> power_per_sample_w;  ///< when shooting, ShootingRules
  std::optional<int> samples_per_patch;      ///< when shooting, ShootingRules
  /// BatchTally::by_source and, with errors per instant, se_by_source.
  bool by_source = false;
};

/// Light on a frozen mesh: prepared once per variant, then any batch of suns.
///
/// All results are the same bits for any number of threads. When gathering, those
/// of an interval do not depend on the batch that it is solved in (time sums do,
/// by the order of additions); when shooting, suns of a block share their samples.
class LightSolver {
 public:
  /// Builds the ray caster and traces all lines, unless those of an equal solver
  /// are handed over. `scene` must outlive it.
  LightSolver(const Scene& scene, std::shared_ptr<const Hierarchy> mesh, const SolverRules& rules,
              Watch& watch, std::optional<Lines> ready = {});
  /// On a mesh that is split by edge length alone.
  LightSolver(const Scene& scene, const SplitRules& split, const SolverRules& rules, Watch& watch,
              std::optional<Lines> ready = {});
  ~LightSolver();

  const Hierarchy& hierarchy() const { return hierarchy_; }
  const RayCaster& caster() const { return caster_; }
  const SkyGrid& sky_grid() const { return grid_; }
  const Lines& lines() const { return lines_; }
  int bounces() const { return bounces_; }
  const SolverRules& rules() const { return rules_; }
  bool has_part(Part part) const;
  /// Directions in which the scene's mirrors face.
  std::size_t mirror_orientations() const { return mirrors_.reflecting(); }
  /// Cosine-weighted share of the hemisphere above each patch that is sky.
  std::vector<double> sky_view_factor() const;
  /// Lines of the scene's sensors; no rows where it has none.
  const Lines& sensor_lines() const { return sensor_lines_; }

  /// Light of consecutive intervals; not for rgb. Throws Interrupted.
  BatchTally solve(std::span<const SunLight> batch, Watch& watch);
  /// The same per band, in the order of `band_names`; broadband light is one band. With rgb every
  /// sun has its light in `bands`.
  std::vector<BatchTally> solve_bands(std::span<const SunLight> batch, Watch& watch);

  const WorkDone& work() const { return work_; }

 private:
  bool is_rgb() const { return rules_.bands == Bands::rgb; }
  BatchTally empty_tally(std::size_t intervals) const;
  TimeSums empty_sums() const;
  std::span<const SunLight> lit_block(std::span<const SunLight> batch) const;
  void solve_block(std::span<const SunLight> block, std::size_t first_row,
                   std::vector<TimeSums>& sums, std::vector<BatchTally>& tallies);
  TracedLight trace_block(const BlockSources& sources, TimeSums& sums);
  void make_columns(TracedLight& traced) const;
  void trace_sun(const BlockSources& sources, TimeSums& sums, TracedLight& traced);
  std::vector<SunBeams> trace_mirrors(std::span<const SunLight> block, MirroredIrradiance into,
                                      std::vector<SunFates>& sent_on);
  std::vector<SunBeams> beams_of(std::span<const SunLight> block) const;
  void trace_gloss(std::span<const SunLight> block, MirroredIrradiance into,
                   std::vector<SunFates>& sent_on);
  void trace_sensors(std::span<const SunLight> block, std::vector<SunBeams> beams, TimeSums& sums,
                     TracedLight& traced);
  std::vector<SunBeams> with_first_reflections(std::vector<SunBeams> beams,
                                               std::span<const SunLight> block) const;
  void solve_traced(std::size_t band, const BlockSources& sources, TracedLight traced,
                    std::size_t first_row, TimeSums& sums, BatchTally& tally);
  /// Returns the radiosity that was gathered last.
  Columns light_patches(const PatchOptics& optics, const BlockSources& sources,
                        std::size_t first_row, TracedLight& traced, BatchTally& tally);
  void light_sensors(const PatchOptics& optics, const BlockSources& sources,
                     const Columns& followed, std::size_t first_row, TracedLight& traced,
                     ReceiverTally& tally);
  void book_sun_sent_on(const TracedLight& traced, std::span<const SunLight> block,
                        std::size_t first_row, TimeSums& sums, BatchTally& tally) const;
  void book_parallel(std::size_t suns, std::size_t first_row, BatchTally& tally) const;
  void errors_per_instant(const PatchOptics& optics, const BlockSources& sources,
                          std::size_t first_row, TracedLight& traced, BatchTally& tally) const;
  void solve_realizations(std::vector<TimeSums>& sums, std::vector<BatchTally>& tallies);
  void solve_realization(const PatchOptics& optics, std::size_t r, const TimeSums& sums,
                         BatchTally& tally) const;
  /// Returns the radiosity that was gathered last.
  std::vector<double> realization_of_patches(const PatchOptics& optics, std::size_t r,
                                             const TimeSums& sums, BatchTally& tally) const;
  void realization_of_sensors(const PatchOptics& optics, std::size_t r, const TimeSums& sums,
                              const std::vector<double>& followed, ReceiverTally& tally) const;
  void shoot_block(std::span<const SunLight> block, std::size_t first_row, BatchTally& tally);
  TracedLight trace_for_shooting(const BlockSources& sources);
  FirstMirrored::SentSuns send_sun(std::span<const SunLight> block);
  BlockLight shot_to_sensors(std::size_t r, const BlockSources& sources, const ShotLight& light,
                             SunColumns& of_sensors) const;
  void add_realization(std::size_t r, const ShotLight& light, std::span<const SunLight> block,
                       std::size_t first_row, BatchTally& tally) const;
  void add_by_source(std::size_t r, const ShotLight& light, std::span<const SunLight> block,
                     ExposureBySource& to) const;

  const Scene& scene_;
  SolverRules rules_;
  WorkDone work_;  // before what is built with a stopwatch running
  std::shared_ptr<const Hierarchy> mesh_;
  const Hierarchy& hierarchy_;
  RayCaster caster_;
  SkyGrid grid_;
  PatchOptics optics_;                       ///< broadband
  std::vector<PatchOptics> optics_of_band_;  ///< one where light is broadband
  Lines lines_, sensor_lines_;
  SunSampler sampler_, sensor_sampler_;
  MirrorGroups mirrors_;
  MirrorSun mirror_sun_;
  MirrorChains mirror_chains_;
  ParallelLight parallel_, sensor_parallel_;
  GlossySun glossy_sun_;
  LobeImages lobe_images_;  ///< for sensors
  int bounces_;
  std::unique_ptr<Shooter> shooter_;  ///< null when gathering
};

}  // namespace sunload
