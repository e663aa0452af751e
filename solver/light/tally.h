// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a batch of suns leaves behind: series, time integrals, ledger.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/light/fate.h"
#include "solver/light/sun_block.h"
#include "solver/light/transport.h"

namespace sunload {

/// Parts of the irradiance (docs/developer/design.md, Result and ledger).
enum class Part : std::uint8_t { total, direct, sky, mirror, lamps, reflected };
inline constexpr std::size_t part_count = 6;
inline constexpr std::array<const char*, part_count> part_names{"total",  "direct", "sky",
                                                                "mirror", "lamps",  "reflected"};

inline constexpr std::array<bool, part_count> all_parts{true, true, true, true, true, true};

/// Terms of the energy ledger, every one estimated on its own.
///
/// in = sun + sky + ground + emitted;  out = absorbed + transmitted + escaped + unshot
enum class Term : std::uint8_t {
  sun,
  sky,
  ground,
  emitted,
  absorbed,
  transmitted,
  escaped,
  unshot
};
inline constexpr std::size_t term_count = 8;

/// The energy of a scene by terms.
struct Ledger {
  std::array<double, term_count> terms{};  ///< W, or J when integrated over time
  double lost_at_backs = 0;                ///< part of `absorbed`: met backs of one-sided surfaces
  double estimated = 0;  ///< what patches receive of light that is not followed: beside the terms

  double& operator[](Term t) { return terms[static_cast<std::size_t>(t)]; }
  double operator[](Term t) const { return terms[static_cast<std::size_t>(t)]; }
  double in() const;
  double out() const;
  double residual() const { return in() - out(); }
  Ledger& operator+=(const Ledger& other);
};
/// All of it times the factor.
Ledger scaled(Ledger ledger, double factor);

/// Lines of a ledger in results: its terms, the residual, and the light that is estimated.
inline constexpr std::size_t ledger_line_count = term_count + 2;
inline constexpr std::array<const char*, ledger_line_count> ledger_line_names{
    "sun",         "sky",     "ground", "emitted",  "absorbed",
    "transmitted", "escaped", "unshot", "residual", "estimated"};
inline constexpr std::size_t residual_line = term_count;
/// Value of the line of that number in `ledger_line_names`.
double ledger_line(const Ledger& ledger, std::size_t line);

/// `ledger` with power [W] that ended so: what met backs is absorbed, what was cut is unshot.
Ledger booked(const Fate<double>& fate, Ledger ledger = {});

/// A part of the batch's time: a month, the mornings, ….
struct PartOfBatch {
  std::vector<double> share;  ///< [K] of every interval's time, 0 … 1
  bool with_errors = true;    ///< whether realizations are solved for it
};

/// What N receivers get in such a part: sums over the intervals of share · what they get [J m-2].
struct PartTally : PartOfBatch {
  std::vector<double> total, direct;  ///< [N] of the series; a part that there is not: empty
  std::vector<double> sunlit_s;       ///< [N]
  std::vector<std::vector<double>> exposure_realization;  ///< [R][N]; without errors: none
};

/// What N receivers (patches or sensors) get in K consecutive intervals, R
/// realizations. Energies are J m-2; a part that the scene cannot have is empty. In [K][N] receiver
/// p in interval k of the batch stands at k·N + p.
struct ReceiverTally {
  std::array<LargeVector<float>, part_count> irradiance;  ///< [K][N] W m-2, where it is kept
  LargeVector<float> irradiance_se;                       ///< [K][N], if asked for
  std::array<std::vector<double>, part_count> exposure;   ///< [N] time sum of the series
  /// [R][N]; while lines gather a batch the rows are empty.
  std::vector<std::vector<double>> exposure_realization;
  /// The same of the parts but `total`.
  std::array<std::vector<std::vector<double>>, part_count> part_realization;
  std::vector<double> sunlit_s;       ///< [N]
  std::vector<float> irradiance_max;  ///< [N]
  std::vector<PartTally> parts;       ///< those that were asked for, in their order
};

/// Exposures of every realization by what their errors come from, [R][N] J m-2. What they leave of
/// the whole exposure comes by lines.
struct ExposureBySource {
  std::vector<std::vector<double>> sun;  ///< by direct samples of every sun, mirrored included
  // Only if asked for (SolverRules).
  std::vector<std::vector<double>> parallel;  ///< by direct samples, the same for all suns
  // When shooting, and only if asked for.
  std::vector<std::vector<double>> emitted;    ///< by samples of emitters, the same for all suns
  std::vector<std::vector<double>> reflected;  ///< by samples of every block of suns
};

/// Standard errors of irradiance by what they come from, [K][N] W m-2.
struct ErrorsBySource {
  std::vector<float> samples;  ///< direct ones, of suns and parallel sources
  std::vector<float> shots;    ///< samples of power; 0 when gathering
  std::vector<float> lines;    ///< all the rest
};

/// Standard errors of totals alone, or of every interval too.
enum class Errors { totals, instants };

/// The time sums of one realization's parts, where the tally has them.
inline std::vector<double>* part_of_realization(ReceiverTally& tally, Part part, std::size_t r) {
  auto& of_part = tally.part_realization[static_cast<std::size_t>(part)];
  return of_part.empty() ? nullptr : &of_part[r];
}

/// Results of consecutive intervals: of the patches, of sensors, of the scene [J].
struct BatchTally : ReceiverTally {
  std::size_t intervals = 0;
  std::vector<double> outgoing;  ///< [N] radiosity, time-integrated
  ExposureBySource by_source;
  ErrorsBySource se_by_source;  ///< if asked for, per instant
  ReceiverTally sensors;
  std::vector<Ledger> ledger;              ///< [K] W
  std::vector<Ledger> ledger_realization;  ///< [R] J
  Ledger energy;                           ///< J: time sum of `ledger`
  /// [R][K] W, if errors per instant are asked for.
  std::vector<std::vector<Ledger>> ledger_instants;
};

/// What a tally has room for.
struct TallyShape {
  std::size_t patches = 0, sensors = 0, intervals = 0, realizations = 0;
  std::array<bool, part_count> parts{};             ///< that the scene can have
  std::array<bool, part_count> series = all_parts;  ///< of these, whose series are kept
  Errors errors = Errors::totals;
  bool by_source = false;
  Transport transport = Transport::gather;
  std::vector<PartOfBatch> periods{};  ///< parts of the batch's time that have totals of their own
};
/// All zeros. Arrays for errors per instant and for sources have room only where these are asked
/// for. When gathering, exposures by source are empty: the sun's part is put there at the end.
BatchTally empty_tally(const TallyShape& shape);

/// Rounds the sums of realizations to single precision, in which batch files keep them (only their
/// spread counts): what is computed in memory then has the bits of what files give back.
void round_realizations(BatchTally& tally);

/// Puts the tally of consecutive intervals of a batch, from interval `first` on, into that of the
/// whole: series to their place, sums and largest values together. What a stretch lacks stays 0.
/// Not for tallies by source.
void put_stretch(const BatchTally& stretch, std::size_t first, BatchTally& whole);

/// Mean and standard error of independent realizations.
struct MeanError {
  double mean = 0, standard_error = 0;
};
/// s / √R of the values; standard_error is 0 for a single value.
MeanError mean_error(const std::vector<double>& values);

}  // namespace sunload
