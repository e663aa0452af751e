// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/joined_intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "geo/base/units.h"
#include "geo/time/period_parts.h"
#include "geo/time/time.h"
#include "io/plan/rules_of_study.h"
#include "io/study/words.h"

namespace sunload {

namespace {

/// Fewer are solved one by one as fast.
constexpr std::size_t fewest_lit = 2000;
constexpr double fewest_in_step = 4;
constexpr int longest_step_min = 60;
/// Sunlit time that one sun stands for: of what is straight, and of what mirrors send on. The sun
/// moves by half a degree, its own diameter, and by five.
constexpr double direct_sun_s = 2 * seconds_per_minute, sent_on_sun_s = 20 * seconds_per_minute;

/// Whether anything is wanted of every interval for itself.
bool asks_for_instants(const Study& study) {
  bool any = study.output.standard_error == StandardErrors::instants ||
             (study.solver.accuracy && study.solver.accuracy->irradiance_relative);
  for (std::size_t p = 0; p < part_count; ++p) any = any || is_watched(study, static_cast<Part>(p));
  return any;
}

/// Minutes of the steps whose intervals may be solved together; none: each is wanted.
std::optional<int> step_minutes(const Study& study) {
  using Unit = SeriesStepStudy::Unit;
  const SeriesStepStudy& step = study.output.series_step;
  if (study.solver.short_intervals == ShortIntervals::each) return {};
  if (study.solver.transport == Transport::shoot || asks_for_instants(study)) return {};
  if (study.solver.short_intervals == ShortIntervals::automatic && study.solver.year == Year::each)
    return {};
  if (step.is_interval() && !study.output.series.empty()) return {};
  if (step.is_interval() || step.unit != Unit::minutes) return longest_step_min;
  for (int minutes = std::min(step.minutes, longest_step_min);; --minutes)
    if (step.minutes % minutes == 0) return minutes;
}

bool has_clock(const Study& study, const LightSeries& series) {
  return !series.times_are_synthetic && !std::holds_alternative<InstantsPeriod>(study.period.kind);
}

bool pays(const LightSeries& series, double step_s) {
  if (series.lit_count() < fewest_lit) return false;
  double total_s = 0;
  for (const LitInterval& interval : series.intervals) total_s += interval.when.length_s();
  return total_s * fewest_in_step <= step_s * static_cast<double>(series.intervals.size());
}

/// A sun of a part, with what it brings over time.
struct PartSun {
  Vec3 direction;
  double dni_s = 0, sunlit_s = 0;
};

/// A low sun has fewer lumens per watt than a high one: what they bring is that of the quantity.
std::vector<PartSun> suns_of(std::span<const LitInterval> parts, Quantity quantity) {
  std::vector<PartSun> suns;
  for (const LitInterval& part : parts) {
    const SunInterval& when = part.when;
    if (when.sunlit_s <= 0 || when.direction.z <= 0) continue;
    const double dni_s = source_means(part, quantity).dni * when.length_s();
    for (const SunSample& sun : part.sun_samples)
      suns.push_back({sun.direction, dni_s * sun.dni_share, when.sunlit_s * sun.time_share});
    if (part.sun_samples.empty()) suns.push_back({when.direction, dni_s, when.sunlit_s});
  }
  return suns;
}

/// Runs of suns of no more sunlit time than that, each as one sun in their middle, weighted by what
/// they bring.
std::vector<SunSample> in_runs(std::span<const PartSun> suns, double longest_s) {
  double dni_s = 0, sunlit_s = 0;
  for (const PartSun& sun : suns) dni_s += sun.dni_s, sunlit_s += sun.sunlit_s;
  constexpr double rounding = 1e-6;
  const double runs = std::max(1.0, std::ceil(sunlit_s / longest_s - rounding));
  std::vector<SunSample> samples;
  double passed_s = 0;
  for (std::size_t first = 0; first < suns.size();) {
    PartSun run;
    Vec3 by_dni, by_time;
    const double end_s = sunlit_s / runs * static_cast<double>(samples.size() + 1);
    std::size_t next = first;
    for (; next < suns.size(); ++next) {
      const PartSun& sun = suns[next];
      // By its middle a sun belongs to one run.
      if (next > first && passed_s + sun.sunlit_s / 2 > end_s) break;
      passed_s += sun.sunlit_s;
      by_dni += sun.direction * sun.dni_s;
      by_time += sun.direction * sun.sunlit_s;
      run.dni_s += sun.dni_s;
      run.sunlit_s += sun.sunlit_s;
    }
    samples.push_back({normalized(run.dni_s > 0 ? by_dni : by_time),
                       dni_s > 0 ? run.dni_s / dni_s : run.sunlit_s / sunlit_s,
                       run.sunlit_s / sunlit_s});
    first = next;
  }
  return samples;
}

/// The part in which half of the time with sun, or of all time where there is none, is over.
std::size_t middle_of(std::span<const LitInterval> parts) {
  double sunlit_s = 0, passed_s = 0;
  for (const LitInterval& part : parts) sunlit_s += part.when.sunlit_s;
  if (sunlit_s <= 0) return parts.size() / 2;
  std::size_t last = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].when.sunlit_s <= 0 || parts[p].when.direction.z <= 0) continue;
    last = p;
    passed_s += parts[p].when.sunlit_s;
    if (passed_s >= sunlit_s / 2) break;
  }
  return last;
}

/// Puts a stretch with sun behind those that a hull has; one without is none.
void append(UnixTime part_begin, UnixTime part_end, double part_s, UnixTime& begin, UnixTime& end,
            double& length_s) {
  if (part_s <= 0) return;
  if (length_s <= 0) begin = part_begin;
  end = part_end;
  length_s += part_s;
}

SunInterval time_of(std::span<const LitInterval> parts) {
  SunInterval when = parts[middle_of(parts)].when;
  when.begin = parts.front().when.begin;
  when.end = parts.back().when.end;
  when.sunlit_s = when.up_s = 0;
  when.sunlit_begin = when.sunlit_end = when.up_begin = when.up_end = when.sun_time;
  when.sun_samples.clear();
  for (const LitInterval& part : parts) {
    const SunInterval& of = part.when;
    append(of.sunlit_begin, of.sunlit_end, of.sunlit_s, when.sunlit_begin, when.sunlit_end,
           when.sunlit_s);
    append(of.up_begin, of.up_end, of.up_s, when.up_begin, when.up_end, when.up_s);
  }
  return when;
}

/// Σ seconds · light / Σ seconds.
template <class Seconds, class Light>
Irradiance mean_light_of(std::span<const LitInterval> parts, const Seconds& seconds,
                         const Light& light) {
  Irradiance sum;
  double all_s = 0;
  for (const LitInterval& part : parts) {
    const double s = seconds(part);
    const Irradiance& of_part = light(part);
    sum = {sum.dni + s * of_part.dni, sum.dhi + s * of_part.dhi, sum.ghi + s * of_part.ghi};
    all_s += s;
  }
  if (all_s <= 0) return {};
  return {sum.dni / all_s, sum.dhi / all_s, sum.ghi / all_s};
}

LitInterval joined(std::span<LitInterval> parts, Quantity quantity) {
  LitInterval whole;
  whole.when = time_of(parts);
  whole.mean = mean_light_of(
      parts, [](const LitInterval& part) { return part.when.length_s(); },
      [](const LitInterval& part) -> const Irradiance& { return part.mean; });
  whole.of_the_sky = mean_light_of(
      parts, [](const LitInterval& part) { return part.when.up_s; },
      [](const LitInterval& part) -> const Irradiance& { return part.of_the_sky; });
  const LitInterval& middle = parts[middle_of(parts)];
  whole.lm_per_w = middle.lm_per_w;
  whole.albedo = middle.albedo;
  const auto suns = suns_of(parts, quantity);
  if (!suns.empty()) {
    whole.sun_samples = in_runs(suns, sent_on_sun_s);
    whole.direct_suns = in_runs(suns, direct_sun_s);
  }
  whole.joined = std::make_shared<const std::vector<LitInterval>>(
      std::make_move_iterator(parts.begin()), std::make_move_iterator(parts.end()));
  return whole;
}

/// Steps are counted from midnight by the time passed: they lie across hours of the clock where
/// these are no whole number of them, and on days on which clocks change by half an hour.
bool are_of_one_hour(const TimeSpan& before, const TimeSpan& behind, const TimeZone& zone) {
  return clock_hours({before[0], behind[1]}, zone).size() == 1;
}

/// Ends of the runs of intervals that are to be one.
std::vector<std::size_t> ends_of_runs(const LightSeries& series, double step_s,
                                      const TimeZone& zone) {
  const std::vector<TimeSpan> spans = series.spans();
  // The step that holds all of an interval; others stay by themselves.
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> step_of(spans.size(), none);
  const auto steps = clock_steps(step_s, spans, zone);
  for (std::size_t step = 0; step < steps.size(); ++step)
    for (const PartShare& share : steps[step].intervals)
      if (share.share == 1) step_of[share.interval] = step;
  std::vector<std::size_t> ends;
  for (std::size_t k = 0; k < spans.size(); ++k) {
    const bool goes_on = k + 1 < spans.size() && step_of[k] != none &&
                         step_of[k] == step_of[k + 1] && meet(spans[k], spans[k + 1]) &&
                         are_of_one_hour(spans[k], spans[k + 1], zone);
    if (!goes_on) ends.push_back(k + 1);
  }
  return ends;
}

}  // namespace

void join_short_intervals(const Study& study, LightSeries& series) {
  const auto minutes = step_minutes(study);
  if (!minutes || !has_clock(study, series)) return;
  const double step_s = *minutes * seconds_per_minute;
  if (study.solver.short_intervals == ShortIntervals::automatic && !pays(series, step_s)) return;
  const auto ends = ends_of_runs(series, step_s, TimeZone(study.site.timezone));
  const std::size_t count = series.intervals.size();
  if (ends.size() == count) return;
  std::vector<LitInterval> whole;
  whole.reserve(ends.size());
  std::size_t first = 0;
  for (const std::size_t end : ends) {
    const auto parts = std::span(series.intervals).subspan(first, end - first);
    whole.push_back(parts.size() == 1 ? std::move(parts.front())
                                      : joined(parts, study.light.quantity));
    first = end;
  }
  series.intervals = std::move(whole);
  series.notes.push_back(
      fmt::format("{} intervals are solved as {}, of up to {} min each (solver.short_intervals): "
                  "largest values are means over these",
                  count, series.intervals.size(), *minutes));
}

std::string joining_words(const Study& study) {
  const auto minutes = step_minutes(study);
  return minutes ? fmt::format("{} min {}", *minutes, word_of(study.solver.short_intervals)) : "";
}

}  // namespace sunload
