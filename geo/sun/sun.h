// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Apparent sun over a site, and the sun path of a study (ERFA ephemeris).
///
/// Azimuth is clockwise from true north, elevation above the horizon; a sun
/// direction points to the sun. Neglected: diurnal aberration (at most
/// 0.00009°), polar motion (0.0001°), deflection of the vertical.
#pragma once

#include <optional>
#include <vector>

#include "geo/base/units.h"
#include "geo/sun/site.h"
#include "geo/time/time.h"

namespace sunload {

/// By what the true elevation is raised: nothing, or one of the models at `refraction_deg`.
enum class Refraction { none, spa, bennett };

/// The sun as a point, or as a disk that makes penumbrae.
enum class SunDisk { point, finite };

/// Half of the angle that the sun's disk spans; 0 for a point. 0.2666° at 1 au: 959.63″ (Auwers
/// 1891), the value of the almanacs.
double disk_half_angle(SunDisk disk, double distance_au);

/// Air at the site, for refraction.
struct Air {
  double pressure_pa, temperature_c;
};
/// International standard atmosphere at an elevation [m] (troposphere formula).
Air standard_air(double elevation_m);

/// Topocentric position of the sun's centre.
struct SunPosition {
  double azimuth_deg = 0;
  double true_elevation_deg = 0;  ///< without refraction
  double elevation_deg = 0;       ///< apparent: with the chosen refraction
  double distance_au = 1;         ///< sun to observer's Earth centre
};

/// Refraction to be added to a true elevation [degrees]; elevation plus
/// refraction grows strictly with the elevation, so apparent sunrise is one
/// true elevation.
///
/// spa: Reda & Andreas (2008), Solar position algorithm, NREL/TP-560-34302,
/// eq. 42; zero below -0.8333° as there (a jump, below the apparent horizon).
/// bennett: Bennett (1982), J. Navigation 35, p. 257, at the true elevation as
/// in pvlib; below the formula's own maximum (-1.7°) it fades to zero at -6°.
double refraction_deg(Refraction model, double true_elevation_deg, const Air& air);

/// True elevation at which the sun's centre stands on the apparent horizon:
/// what divides sunlit from dark.
double sunlit_above_deg(Refraction model, const Air& air);

/// Geocentric apparent place: true equator and equinox of date.
struct ApparentPlace {
  double right_ascension_deg = 0;  ///< [0, 360)
  double declination_deg = 0;
  double distance_au = 1;
};
ApparentPlace apparent_place(const TimeScales& when);

/// Apparent minus mean (UT1) solar time [s].
double equation_of_time_s(const TimeScales& when);

/// Direct call (some 0.1 ms): ERFA epv00, pnm06a, gst06a, light time, annual
/// aberration, parallax on WGS84. Frames by GeographicLib.
SunPosition sun_position(const TimeScales& when, const Site& site, Refraction refraction,
                         const Air& air);

/// The same, from slow terms interpolated between nodes; agrees with the
/// direct call within 1e-6° (tested) and costs some 0.4 µs.
/// Const, hence usable from many threads.
class SunEphemeris {
 public:
  /// Covers [begin, end] with a margin of a day on both sides.
  SunEphemeris(UnixTime begin, UnixTime end, const Site& site, Refraction refraction, Ut1 ut1,
               const Air& air);
  SunPosition operator()(UnixTime utc) const;

 private:
  Vec3 intermediate_sun_m(JulianDate tt) const;

  // Geocentric sun in the celestial intermediate frame [m], every second day of TT; the days are
  // absolute, so that a position does not depend on the span that was asked for.
  std::vector<Vec3> nodes_m_;
  double first_node_ = 0;  // its number
  UnixTime begin_ = 0, end_ = 0;
  Refraction refraction_;
  Ut1 ut1_;
  Air air_;
  Rotation enu_from_ecef_;
  Vec3 observer_m_;
};

/// The sun's centre passing a true elevation.
struct ElevationCrossing {
  UnixTime time = 0;
  enum class Sense { up, down } sense = Sense::up;
};
/// All passages in [begin, end] in order, to the microsecond, the shortest dips
/// across the threshold included.
std::vector<ElevationCrossing> elevation_crossings(const SunEphemeris& sun, UnixTime begin,
                                                   UnixTime end, double true_elevation_deg);

/// Sunrise, sunset and twilight: the sun's centre at a true elevation.
struct SunEvents {
  std::optional<UnixTime> rise, set;  ///< the first of each; either may be missing near polar day
  UnixTime transit = 0;               ///< upper meridian passage, below the horizon too
  bool never_rises = false, never_sets = false;  ///< polar night, polar day
};
/// Events of the civil day that starts at `day_begin` (24 h of UTC time on; the
/// transit may lie up to a minute outside of it). -0.8333°: the upper limb on a sea
/// horizon with 34′ of refraction.
SunEvents sun_events(const SunEphemeris& sun, UnixTime day_begin,
                     double true_elevation_deg = -0.8333);

/// A stretch of time and what its sun is.
///
/// The representative sun stands at the middle of the sunlit part (apparent
/// elevation of the centre above 0), of the longest one if the sun sets and rises
/// within; a dark interval has `sunlit_s` = 0 and the sun of its middle (docs/developer/design.md,
/// Study).
///
/// Where the site has hills, sunlit is what the sun's centre spends above their line
/// (passages found on steps of a minute); the representative sun of an interval that
/// they hide all the time stands at the middle of the part with the sun above 0.
/// An instant (`given`) with the sun behind them, or below the horizon, has `sunlit_s` = 0.
struct SunInterval {
  UnixTime begin = 0, end = 0;
  UnixTime sun_time = 0;
  double sunlit_s = 0;  ///< length of the sunlit part(s) of [begin, end]
  UnixTime sunlit_begin = 0,
           sunlit_end = 0;            ///< bounds (hull of several parts); both sun_time in the dark
  double up_s = 0;                    ///< as sunlit_s, of an open horizon: at least sunlit_s
  UnixTime up_begin = 0, up_end = 0;  ///< as sunlit_begin and sunlit_end
  SunPosition sun;
  Vec3 direction;  ///< to the sun, scene frame, unit
  /// To suns that stand for equal parts of the sunlit time, in the order of time: at the middle of
  /// each. Empty where the representative sun stands for all of it.
  std::vector<Vec3> sun_samples;

  double length_s() const { return end - begin; }
};
using SunPath = std::vector<SunInterval>;

/// Whether the interval's representative sun is searched in the sunlit part
/// (steps) or stands exactly at the given instant (`instants`).
enum class SunInstant { middle_of_sunlit_part, given };

/// One interval as a caller wants it: [begin, end], and the instant for `given`.
struct PeriodStep {
  UnixTime begin = 0, end = 0;
  UnixTime instant = 0;
  SunInstant rule = SunInstant::middle_of_sunlit_part;
};

/// Suns of an interval where one is too coarse: shadows of an hour are those of 15° of the sun's
/// way.
struct SunSamples {
  /// Absent: as many that one stands for 20 minutes at most, which are 5° of the sun's way about
  /// the pole. An instant (`given`) has one.
  std::optional<int> count = 1;
};

/// Suns that stand for a stretch with that much sun: at least 1.
int sun_sample_count(const SunSamples& samples, double sunlit_s);

/// Sun path over consecutive steps (strictly increasing), standard air at the site's elevation.
SunPath sun_path(const std::vector<PeriodStep>& steps, const Site& site, Refraction refraction,
                 Ut1 ut1, const SunSamples& samples = {});

}  // namespace sunload
