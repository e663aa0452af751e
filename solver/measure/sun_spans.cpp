// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/measure/sun_spans.h"

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

// Below this share of its length along the level a surface lies flat.
constexpr double flat = 1e-6;

/// Times and directions of a span of the course, its ends among them.
struct Stretch {
  std::vector<double> time;
  std::vector<Vec3> direction;
};

std::vector<Stretch> stretches(const SunCourse& course) {
  std::vector<Stretch> all;
  for (const SunSpan& span : course.counted) {
    Stretch& stretch = all.emplace_back();
    const int steps = std::max(1, static_cast<int>(std::ceil(span.length_s() / sun_course_step_s)));
    for (int i = 0; i <= steps; ++i) {
      stretch.time.push_back(i < steps ? span.begin + span.length_s() * i / steps : span.end);
      stretch.direction.push_back(course.direction(stretch.time.back()));
    }
  }
  return all;
}

/// One point under the sun.
class Watch {
 public:
  Watch(const MeasuredPoint& point, const RayCaster& caster, const SunCourse& course,
        const SunAngles& angles)
      : caster_(caster),
        course_(course),
        normal_(point.normal),
        origin_(point.position + point.normal * caster.offset_m()),
        least_sine_(std::sin(radians(angles.to_surface_deg))),
        least_plan_sine_(std::sin(radians(angles.in_plan_deg))) {
    const double level = std::hypot(normal_.x, normal_.y);
    has_plan_ = angles.in_plan_deg > 0 && level > flat;
    if (has_plan_) plan_ = {normal_.x / level, normal_.y / level, 0};
  }

  /// Whether each of the directions, as many as a packet holds at most, has sun.
  std::uint32_t lit(std::span<const Vec3> suns) const {
    Packet origins{}, directions{};
    std::uint32_t facing = 0;
    for (std::size_t r = 0; r < suns.size(); ++r) {
      put(origins, r, origin_);
      put(directions, r, suns[r]);
      if (faces(suns[r])) facing |= 1u << r;
    }
    return facing == 0 ? 0 : caster_.unoccluded_each(origins, directions, facing);
  }

  void add_spans(const Stretch& stretch, std::vector<SunSpan>& spans) const {
    const std::size_t n = stretch.time.size();
    std::vector<char> is_lit(n);
    for (std::size_t first = 0; first < n; first += packet_size) {
      const std::size_t count = std::min(packet_size, n - first);
      const auto seen = lit({stretch.direction.data() + first, count});
      for (std::size_t r = 0; r < count; ++r) is_lit[first + r] = (seen >> r & 1u) != 0;
    }
    std::vector<Change> changes;
    for (std::size_t i = 0; i + 1 < n; ++i)
      if (is_lit[i] != is_lit[i + 1])
        changes.push_back({stretch.time[i], stretch.time[i + 1], is_lit[i] != 0});
    narrow(changes);
    double begin = stretch.time.front();
    for (const Change& change : changes) {
      const double time = (change.before + change.after) / 2;
      if (change.was_lit)
        spans.push_back({begin, time});
      else
        begin = time;
    }
    if (is_lit.back()) spans.push_back({begin, stretch.time.back()});
  }

 private:
  /// The sun comes or goes between the two times.
  struct Change {
    double before, after;
    bool was_lit;
  };

  bool faces(Vec3 sun) const {
    const double sine = dot(normal_, sun);
    if (sine <= 0 || sine < least_sine_) return false;
    return !has_plan_ || dot(plan_, sun) >= least_plan_sine_ * std::hypot(sun.x, sun.y);
  }

  /// Bisection of all changes side by side.
  void narrow(std::vector<Change>& changes) const {
    for (std::size_t first = 0; first < changes.size(); first += packet_size) {
      const std::size_t count = std::min(packet_size, changes.size() - first);
      std::vector<Vec3> suns(count);
      for (double width = sun_course_step_s; width > sun_change_within_s; width /= 2) {
        for (std::size_t r = 0; r < count; ++r)
          suns[r] = course_.direction((changes[first + r].before + changes[first + r].after) / 2);
        const auto seen = lit(suns);
        for (std::size_t r = 0; r < count; ++r) {
          Change& change = changes[first + r];
          const double middle = (change.before + change.after) / 2;
          ((seen >> r & 1u) != 0) == change.was_lit ? change.before = middle
                                                    : change.after = middle;
        }
      }
    }
  }

  const RayCaster& caster_;
  const SunCourse& course_;
  Vec3 normal_, origin_, plan_{};
  double least_sine_, least_plan_sine_;
  bool has_plan_ = false;
};

}  // namespace

std::vector<std::vector<SunSpan>> sunlit_spans(std::span<const MeasuredPoint> points,
                                               const RayCaster& caster, const SunCourse& course,
                                               const SunAngles& angles) {
  const auto way = stretches(course);
  std::vector<std::vector<SunSpan>> spans(points.size());
  parallel_for(
      points.size(),
      [&](std::size_t i) {
        const Watch watch(points[i], caster, course, angles);
        for (const Stretch& stretch : way) watch.add_spans(stretch, spans[i]);
      },
      receivers_per_chunk);
  return spans;
}

double total_s(std::span<const SunSpan> spans, double least_s) {
  double sum = 0;
  for (const SunSpan& span : spans)
    if (span.length_s() >= least_s) sum += span.length_s();
  return sum;
}

SunSpan longest(std::span<const SunSpan> spans) {
  SunSpan found;
  for (const SunSpan& span : spans)
    if (span.length_s() > found.length_s()) found = span;
  return found;
}

}  // namespace sunload
