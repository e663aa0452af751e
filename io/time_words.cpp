#include "io/time_words.h"

#include <fmt/format.h>

#include <cmath>

namespace sunload {

namespace {

std::string interval_words(const LitInterval& interval, const TimeZone& zone) {
  const SunInterval& w = interval.when;
  return fmt::format("mean over {} to {}, sun at {} ({}): azimuth {:.2f} deg, elevation {:.2f} deg",
                     iso_local(w.begin, zone), iso_local(w.end, zone), iso_local(w.sun_time, zone),
                     iso_utc(w.sun_time), w.sun.azimuth_deg, w.sun.elevation_deg);
}

}  // namespace

std::string north_words(double north_deg) {
  if (north_deg == 0) return "the scene's +y axis points to true north";
  return fmt::format("the scene's +y axis points {:.3f} deg {} of true north", std::abs(north_deg),
                     north_deg > 0 ? "clockwise" : "counter-clockwise");
}

std::string pole_words(const Site& site, UnixTime first, const TimeZone& zone,
                       const SunStudy& sun_study) {
  CivilTime day = zone.civil_from_utc(first);
  day.hour = 0;
  day.minute = 0;
  day.second = 0;
  const UnixTime begin = zone.utc_from_civil(day).utc;
  const SunEphemeris sun(begin, begin + seconds_per_day, site, sun_study.refraction,
                         sun_study.ut1_utc, Air{});
  const UnixTime noon = sun_events(sun, begin).transit;
  const SunPosition at_noon = sun(noon);
  if (at_noon.elevation_deg <= 0) return "the sun stays below the horizon on the first day";
  return fmt::format(
      "a 1 m pole on level ground casts {:.3f} m of shadow towards {:.1f} deg (clockwise from true "
      "north) at {}",
      1 / std::tan(radians(at_noon.elevation_deg)), wrapped_deg(at_noon.azimuth_deg + 180),
      iso_local(noon, zone));
}

std::string time_words(const LightSeries& light, const Site& site, const Study& study,
                       const std::string& site_source) {
  const TimeZone zone(study.site.timezone);
  std::string text;
  if (light.times_are_synthetic) {
    text = fmt::format("  {} sun positions without a date; time counts from 2000-01-01T12:00Z\n",
                       light.intervals.size());
  } else {
    text = fmt::format("  site       {:.5f} deg north, {:.5f} deg east, {:.1f} m ({})\n",
                       site.latitude_deg, site.longitude_deg, site.elevation_m, site_source);
    text += "  first      " + interval_words(light.intervals.front(), zone) + "\n";
    text += "  last       " + interval_words(light.intervals.back(), zone) + "\n";
  }
  for (std::size_t i = 0; i < light.weather.size(); ++i)
    text += (i == 0 ? "  weather    " : "             ") + light.weather[i] + "\n";
  text += "  north      " + north_words(site.north_deg) + "\n";
  if (!light.times_are_synthetic)
    text += "  pole test  " +
            pole_words(site, light.intervals.front().when.sun_time, zone, study.sun) + "\n";
  return text;
}

}  // namespace sunload
