// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/series_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/study/words.h"

namespace sunload {

namespace {

using Unit = SeriesStepStudy::Unit;

std::vector<PeriodPart> parts_of(const SeriesStepStudy& step, const std::vector<TimeSpan>& spans,
                                 const TimeZone& zone) {
  if (step.unit == Unit::minutes)
    return clock_steps(step.minutes * seconds_per_minute, spans, zone);
  const PartKind kind = step.unit == Unit::day ? PartKind::day : PartKind::month;
  return divided(kind, spans, zone, 0).parts;  // seasons alone ask for the latitude
}

class Steps {
 public:
  Steps(const Study& study, const LightSeries& light, const TimeZone& zone)
      : study_(study),
        step_(study.output.series_step),
        light_(light),
        zone_(zone),
        spans_(light.spans()) {}

  std::vector<SeriesStep> all() const {
    if (light_.times_are_synthetic)
      refuse("the period has no clock", "suns are given by their positions, without times",
             "write series_step: interval");
    std::vector<SeriesStep> steps;
    for (const PeriodPart& part : parts_of(step_, spans_, zone_)) {
      const std::size_t first = part.intervals.front().interval,
                        last = part.intervals.back().interval;
      for (const PartShare& share : part.intervals)
        if (share.share != 1) refuse_cut(share.interval);
      for (std::size_t k = first; k < last; ++k)
        if (!meet(spans_[k], spans_[k + 1])) refuse_gap(k);
      const std::size_t count = last - first + 1;
      steps.push_back({{spans_[first][0], spans_[last][1]}, first, count, sun_of(first, count)});
    }
    return steps;
  }

 private:
  std::size_t sun_of(std::size_t first, std::size_t count) const {
    double sunlit_s = 0, passed_s = 0;
    for (std::size_t k = first; k < first + count; ++k)
      sunlit_s += light_.intervals[k].when.sunlit_s;
    if (sunlit_s <= 0) return first + count / 2;
    for (std::size_t k = first; k < first + count; ++k) {
      passed_s += light_.intervals[k].when.sunlit_s;
      if (passed_s >= sunlit_s / 2) return k;
    }
    return first + count - 1;
  }

  std::string interval_words(std::size_t k) const {
    return iso_local(spans_[k][0], zone_) + " … " + iso_local(spans_[k][1], zone_);
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& why,
                           const std::string& hint) const {
    throw InputError(step_.where, "output.series_step: " + word_of(step_) + ": " + what, why, hint);
  }
  /// A period that is the file's own cannot begin elsewhere.
  std::string whole_days_words() const {
    if (std::holds_alternative<WeatherPeriod>(study_.period.kind))
      return "write period.start, end and step_min in place of year_of: weather, or (not for EPW) "
             "light.stamp: start or end if the file's times are those";
    return "begin the period so that intervals end at midnight";
  }
  [[noreturn]] void refuse_cut(std::size_t k) const {
    refuse(
        "interval " + interval_words(k) + " lies in several steps",
        step_.unit == Unit::minutes
            ? "a step is a whole number of intervals, counted from midnight of the site's clock"
            : fmt::format("a step is a {} of the site's clock, of whole intervals", word_of(step_)),
        step_.unit == Unit::minutes
            ? "write a multiple of the intervals' length, and begin the period at such a time"
            : whole_days_words() + ", or write output.totals: [" + word_of(step_) +
                  "], which shares them out");
  }
  [[noreturn]] void refuse_gap(std::size_t k) const {
    refuse(fmt::format("nothing is known between {} and {}, or it is known twice",
                       iso_local(spans_[k][1], zone_), iso_local(spans_[k + 1][0], zone_)),
           "a step has no gaps: its mean holds for all of its time",
           step_.unit == Unit::month
               ? "write series_step: day, or output.totals: [month], whose months may have gaps"
               : "write series_step: interval, or output.totals: [day], whose days may have gaps");
  }

  const Study& study_;
  const SeriesStepStudy& step_;
  const LightSeries& light_;
  const TimeZone& zone_;
  std::vector<TimeSpan> spans_;
};

}  // namespace

std::vector<SeriesStep> series_steps(const Study& study, const LightSeries& light) {
  const SeriesStepStudy& step = study.output.series_step;
  if (step.is_interval()) return {};
  const TimeZone zone(study.site.timezone);
  return Steps(study, light, zone).all();
}

}  // namespace sunload
