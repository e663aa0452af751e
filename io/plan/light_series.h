// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Period, sun path and irradiance of a study: the light of every interval.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geo/sky/irradiance.h"
#include "geo/sun/site.h"
#include "geo/sun/sun.h"
#include "geo/time/period_parts.h"
#include "io/study/study.h"
#include "solver/light/sun_block.h"

namespace sunload {

/// One interval of the period with its light; irradiances are means over it.
struct LitInterval {
  SunInterval when;
  Irradiance mean;        ///< over the whole interval
  Irradiance of_the_sky;  ///< what the sky's shape follows from: light while the sun is up
  /// Present where the luminance of a model was made into irradiance by this efficacy.
  std::optional<LuminousEfficacy> lm_per_w{};
  /// Of the ground on that day, in (0, 1), where the study asks for it and the weather tells it.
  std::optional<double> albedo{};
  /// Where short intervals are solved together (io/plan/joined_intervals.h): these; else null.
  std::shared_ptr<const std::vector<LitInterval>> joined{};
  /// Where several suns stand for it: these, with what each brings. Under a clear sky what its
  /// height has, else alike.
  std::vector<SunSample> sun_samples{};
  std::vector<SunSample> direct_suns{};  ///< of joined intervals, for straight light alone

  std::span<const LitInterval> parts() const;

  /// Number of suns that stand for it: of those for straight light alone where these are more.
  std::size_t suns() const;
};

/// Whether neither sun nor sky shines: the solver passes such intervals over unless something in
/// the scene shines by itself (IntervalLight::is_dark of the same interval). Twilight with diffuse
/// light is not dark, nor is a sun above the horizon of whatever strength: its hours are counted.
bool is_dark(const LitInterval& interval);

/// Whether the second begins where the first ends, to a millisecond.
bool meet(const TimeSpan& first, const TimeSpan& second);

/// The intervals of a period in the order of time, with what was told of weather and clocks.
struct LightSeries {
  std::vector<LitInterval> intervals;
  bool times_are_synthetic = false;  ///< `positions`: time counts from 2000-01-01T12:00Z
  std::vector<std::string> weather;  ///< the weather file in words; empty without one
  std::string weather_sha256;        ///< of its bytes
  /// Days with sun, and those of them whose albedo is that of the nearest day that has one.
  std::size_t days = 0, days_without_albedo = 0;
  std::vector<std::string> notes;  ///< what happened at clock changes, table ends, …
  /// Begin and end of every interval.
  std::vector<TimeSpan> spans() const;
  /// Whether any is made of several (LitInterval::joined).
  bool any_joined() const;
  /// Intervals in [begin, end) that are not dark.
  std::size_t lit_count(std::size_t begin, std::size_t end) const;
  std::size_t lit_count() const { return lit_count(0, intervals.size()); }
  /// Suns above the horizon, all those that stand for one interval counted.
  std::size_t sun_samples() const;
  /// The same for light that mirrors send on, which fewer suns may stand for.
  std::size_t suns_of_mirrors() const;
  /// Directions to the suns for straight light alone (LitInterval::direct_suns).
  std::vector<Vec3> direct_suns() const;
  /// Number of intervals, with each part of a joined one counted; and of those that are not dark.
  std::size_t parts() const;
  std::size_t lit_parts() const;
};

/// Sun path and irradiance of every interval (docs/developer/design.md, Study).
/// Throws InputError for times that do not exist or do not increase.
LightSeries light_series(const Study& study, const Site& site);

/// Lumens per watt of an interval's light (Perez et al. 1990) under the sky that it has while the
/// sun is up, unless it has its own; with 2 cm of precipitable water, which most sources of light
/// do not tell.
LuminousEfficacy efficacy_of(const LitInterval& interval);

/// Means over the interval in the study's quantity: W m-2 as they are, or lx: DNI and DHI by their
/// own efficacy, the global value by that of its parts.
Irradiance source_means(const LitInterval& interval, Quantity quantity);

/// The open sky of an interval, in scene axes; its DHI is that while the sun is up.
Sky sky_of(const LitInterval& interval, const LightStudy& light);
/// The same but for a factor.
RelativeSky relative_sky_of(const LitInterval& interval, const LightStudy& light);

}  // namespace sunload
