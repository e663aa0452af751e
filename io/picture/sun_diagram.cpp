// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/sun_diagram.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "geo/sun/seasons.h"
#include "io/picture/dome_chart.h"
#include "io/picture/render_frame.h"

namespace sunload {

namespace {

constexpr int diagram_width = 1100, diagram_height = 1180;
constexpr Colour grid_colour{0.72, 0.72, 0.74}, hills_colour{0.87, 0.85, 0.80},
    hills_line{0.45, 0.38, 0.28}, arc_colour{0.30, 0.30, 0.33}, rising_half{0.20, 0.42, 0.75},
    falling_half{0.78, 0.32, 0.25}, dot_colour{0.95, 0.62, 0.05}, hidden_colour{0.25, 0.25, 0.25};
constexpr double day_label_room = 0.11;  // of the radius, for "21 May"
constexpr int months_per_year = 12, hours_per_day = 24, day_of_month = 21;
constexpr double small_dot = 1.5, large_dot = 4;  // radii of suns
constexpr double half_day_s = seconds_per_day / 2;

constexpr std::array<const char*, 12> month_names{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                  "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};

CivilTime arc_date(int year, int month, const TimeZone& zone) {
  switch (month) {
    case 3:
      return season_date(Season::march_equinox, year, zone);
    case 6:
      return season_date(Season::june_solstice, year, zone);
    case 9:
      return season_date(Season::september_equinox, year, zone);
    case 12:
      return season_date(Season::december_solstice, year, zone);
    default:
      return {year, month, day_of_month, 0, 0, 0};
  }
}

Horizontal place_of(const SunPosition& sun) { return {sun.azimuth_deg, sun.elevation_deg}; }

/// Draws one diagram; its members are what all parts need.
class SunDiagram {
 public:
  SunDiagram(const Study& study, const Site& site, const LightSeries& light)
      : study_(study),
        site_(site),
        light_(light),
        zone_(study.site.timezone),
        picture_(diagram_width, diagram_height),
        chart_(picture_, DomeProjection::stereographic, 0, day_label_room) {}

  void draw(const std::string& path) {
    chart_.fill_below(picture_, site_.horizon, hills_colour);
    chart_.draw_grid(picture_, grid_colour);
    if (!light_.times_are_synthetic) draw_year();
    chart_.draw_line(picture_, site_.horizon, hills_line);
    draw_scene_axis();
    draw_suns();
    for (const auto& [hour, place] : hour_labels_) label_hour(hour, place);
    draw_words();
    picture_.save(path);
  }

 private:
  int year() const { return zone_.civil_from_utc(light_.intervals.front().when.sun_time).year; }

  void draw_year() {
    const UnixTime begin = utc_from_calendar({year(), 1, 1, 0, 0, 0}) - seconds_per_day;
    const UnixTime end = utc_from_calendar({year() + 1, 1, 1, 0, 0, 0}) + 2 * seconds_per_day;
    sun_.emplace(begin, end, site_, study_.sun.refraction, study_.sun.ut1_utc,
                 standard_air(site_.elevation_m));
    for (int hour = 0; hour < hours_per_day; ++hour) draw_hour(hour);
    for (int month = 1; month <= months_per_year; ++month) draw_arc(month);
  }

  /// Draws what of a sequence of places is above the horizon, up to the horizon itself.
  void draw_above(const std::vector<Horizontal>& places, double width, Colour colour) {
    std::vector<PicturePoint> line;
    const auto flush = [&] {
      if (line.size() > 1) picture_.draw_lines(line, width, colour);
      line.clear();
    };
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool is_up = places[i].elevation_deg >= 0;
      if (i > 0 && is_up != (places[i - 1].elevation_deg >= 0))
        line.push_back(chart_.at(at_horizon(places[i - 1], places[i])));
      if (is_up) line.push_back(chart_.at(places[i]));
      if (!is_up) flush();
    }
    flush();
  }

  static Horizontal at_horizon(Horizontal a, Horizontal b) {
    const double share = a.elevation_deg / (a.elevation_deg - b.elevation_deg);
    const double turn = std::remainder(b.azimuth_deg - a.azimuth_deg, 360.0);
    return {a.azimuth_deg + share * turn, 0};
  }

  void draw_arc(int month) {
    constexpr double step_s = 240;  // a degree of the sky's turn: straight at this size
    const CivilTime date = arc_date(year(), month, zone_);
    // From half a day before the transit to half a day after it: the sun's own day.
    const UnixTime middle = sun_events(*sun_, zone_.utc_from_civil(date).utc).transit;
    std::vector<Horizontal> places;
    for (double t = -half_day_s; t <= half_day_s; t += step_s)
      places.push_back(place_of((*sun_)(middle + t)));
    const bool is_season = month % 3 == 0;
    draw_above(places, is_season ? 2 : 1, arc_colour);
    label_arc(places,
              fmt::format("{} {}", date.day, month_names[static_cast<std::size_t>(month) - 1]),
              month, middle);
  }

  void label_arc(const std::vector<Horizontal>& places, const std::string& text, int month,
                 UnixTime transit) {
    constexpr double label_share = 0.012;
    constexpr int last_rising_month = 6;
    const bool at_rise = month <= last_rising_month;
    const TextStyle style{chart_.text_size() * 0.8, at_rise ? Align::left : Align::right,
                          Weight::normal, arc_colour};
    for (std::size_t i = 1; i < places.size(); ++i) {
      const bool was_up = places[i - 1].elevation_deg >= 0, is_up = places[i].elevation_deg >= 0;
      if (was_up == is_up || is_up != at_rise) continue;
      const double azimuth = at_horizon(places[i - 1], places[i]).azimuth_deg;
      const PicturePoint p = chart_.beyond_horizon(azimuth, label_share);
      picture_.write({p.x, p.y + 0.3 * style.size}, text, style);
      return;
    }
    // Polar night has no arc; that of a polar day carries its date on the line.
    if (places.front().elevation_deg < 0) return;
    const PicturePoint p = chart_.at(place_of((*sun_)(beside_transit(transit, at_rise))));
    write_over({p.x, p.y + 0.35 * style.size}, text,
               {style.size, Align::centre, style.weight, style.colour});
  }

  /// The half hour of standard time before or after a transit: between two hour lines.
  UnixTime beside_transit(UnixTime transit, bool before) const {
    const double offset_s = zone_.standard_offset_s(year());
    const double half = std::floor((transit + offset_s) / seconds_per_hour - 0.5) + 0.5;
    return (before ? half : half + 1) * seconds_per_hour - offset_s;
  }

  /// Centred text on a white patch, so that it can be read on lines and dots.
  void write_over(PicturePoint at, const std::string& text, const TextStyle& style) {
    const double width = picture_.text_width(text, style);
    picture_.fill_rectangle({at.x - width / 2, at.y - 0.8 * style.size}, width, 0.9 * style.size,
                            {1, 1, 1});
    picture_.write(at, text, style);
  }

  /// The sun at one hour of standard time on every day, in the two halves of the year.
  void draw_hour(int hour) {
    const UnixTime first =
        utc_from_calendar({year(), 1, 1, hour, 0, 0}) - zone_.standard_offset_s(year());
    const auto days = static_cast<int>(std::lround((utc_from_calendar({year() + 1, 1, 1, 0, 0, 0}) -
                                                    utc_from_calendar({year(), 1, 1, 0, 0, 0})) /
                                                   seconds_per_day));
    const int june = day_of_year(season_date(Season::june_solstice, year(), zone_)) - 1;
    const int december = day_of_year(season_date(Season::december_solstice, year(), zone_)) - 1;
    std::vector<Horizontal> rising, falling, highest;
    for (int n = december - days; n <= december; ++n) {
      const int day = n < 0 ? n + days : n;  // the year as a ring
      const Horizontal place = place_of((*sun_)(first + day * seconds_per_day));
      if (n <= june) rising.push_back(place);
      if (n >= june) falling.push_back(place);
      if (highest.empty() || place.elevation_deg > highest.front().elevation_deg) highest = {place};
    }
    draw_above(rising, 1.1, rising_half);
    draw_above(falling, 1.1, falling_half);
    constexpr double least_elevation_deg = 3;
    if (highest.front().elevation_deg >= least_elevation_deg)
      hour_labels_.push_back({hour, highest.front()});
  }

  /// Beside the highest point, on the side where the hour line ends; farther off, or on the other
  /// side, where it would cover a sun or the label of another hour.
  void label_hour(int hour, Horizontal highest) {
    constexpr std::array distances{1.0, 1.6, 2.2, -1.0, -1.6, -2.2};  // of the text's size
    const PicturePoint p = chart_.at(highest),
                       inside = chart_.at({highest.azimuth_deg, highest.elevation_deg + 1});
    const double length = std::hypot(inside.x - p.x, inside.y - p.y);
    const auto middle_at = [&](double distance) {
      const double shift = length > 0 ? distance * chart_.text_size() / length : 0;
      return PicturePoint{p.x + shift * (inside.x - p.x), p.y + shift * (inside.y - p.y)};
    };
    const auto free = std::ranges::find_if(
        distances, [&](double distance) { return is_free(middle_at(distance)); });
    const PicturePoint at = middle_at(free == distances.end() ? distances.front() : *free);
    label_middles_.push_back(at);
    write_over({at.x, at.y + 0.36 * chart_.text_size()}, fmt::format("{}", hour),
               {chart_.text_size() * 0.9, Align::centre, Weight::bold, ink});
  }

  /// Whether an hour's two digits would cover neither a sun's dot nor other digits.
  bool is_free(PicturePoint middle) const {
    const double half_width = 0.65 * chart_.text_size(), half_height = 0.5 * chart_.text_size();
    const auto is_apart = [&](PicturePoint other, double by_x, double by_y) {
      return std::abs(other.x - middle.x) > by_x || std::abs(other.y - middle.y) > by_y;
    };
    return std::ranges::all_of(dots_,
                               [&](PicturePoint dot) {
                                 return is_apart(dot, half_width + large_dot,
                                                 half_height + large_dot);
                               }) &&
           std::ranges::all_of(label_middles_, [&](PicturePoint label) {
             return is_apart(label, 2 * half_width, 2 * half_height);
           });
  }

  void draw_scene_axis() {
    if (site_.north_deg == 0) return;
    constexpr double inner = -0.04, outer = 0.03, beyond = 0.075;
    picture_.draw_lines({chart_.beyond_horizon(site_.north_deg, inner),
                         chart_.beyond_horizon(site_.north_deg, outer)},
                        3, ink);
    picture_.write(chart_.beyond_horizon(site_.north_deg, beyond), "scene +y",
                   {chart_.text_size() * 0.8, Align::centre, Weight::bold, ink});
  }

  void draw_suns() {
    // Dots of a year of hours must not hide the lines.
    constexpr std::size_t many = 500;
    const bool are_many = light_.intervals.size() > many;
    const double radius = are_many ? small_dot : large_dot;
    for (const auto& interval : light_.intervals) {
      if (interval.when.sun.elevation_deg < 0) continue;
      const PicturePoint p = chart_.at(place_of(interval.when.sun));
      if (!are_many) dots_.push_back(p);
      if (interval.when.sunlit_s > 0) {
        picture_.fill_circle(p, radius, dot_colour);
        picture_.draw_circle(p, radius, 0.7, ink);
      } else {
        picture_.draw_circle(p, radius, 1.6, hidden_colour);
      }
    }
  }

  void draw_words() {
    const std::string place = light_.times_are_synthetic
                                  ? "positions without date and place"
                                  : fmt::format("{}, {:.0f} m, {}", position_text(site_),
                                                site_.elevation_m, zone_.name());
    draw_title(picture_, "Sun path: " + study_.name + " (" + place + ")",
               "stereographic; " + dome_convention + "; dots: suns of the study" +
                   (site_.horizon.is_open() ? "" : ", hollow: behind hills"));
    if (light_.times_are_synthetic) return;
    const double offset_h = zone_.standard_offset_s(year()) / seconds_per_hour;
    const double whole_h = std::trunc(offset_h);
    const double size = chart_.text_size(), y = picture_.height() - size;
    const std::string hours = fmt::format("hours: standard time UTC{}{:02.0f}:{:02.0f}, year {}; ",
                                          offset_h < 0 ? '-' : '+', std::abs(whole_h),
                                          std::abs(offset_h - whole_h) * 60, year());
    TextStyle style{size, Align::left, Weight::normal, ink};
    double x = size;
    const auto say = [&](const std::string& text, Colour colour) {
      style.colour = colour;
      picture_.write({x, y}, text, style);
      x += picture_.text_width(text, style);
    };
    say(hours, ink);
    say("blue: December to June", rising_half);
    say(", ", ink);
    say("red: June to December", falling_half);
  }

  const Study& study_;
  const Site& site_;
  const LightSeries& light_;
  TimeZone zone_;
  std::optional<SunEphemeris> sun_;  ///< of the whole year
  /// Hours with the highest points of their lines.
  std::vector<std::pair<int, Horizontal>> hour_labels_;
  std::vector<PicturePoint> dots_, label_middles_;  ///< of few suns; of the hours' labels
  Picture picture_;
  DomeChart chart_;
};

}  // namespace

void draw_sun_diagram(const Study& study, const Site& site, const LightSeries& light,
                      const std::string& path) {
  SunDiagram(study, site, light).draw(path);
}

}  // namespace sunload
