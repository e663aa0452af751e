// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/sensor_lines.h"

#include <algorithm>

#include "geo/base/check.h"
#include "solver/base/rng.h"
#include "solver/base/sampling.h"
#include "solver/base/threads.h"
#include "solver/lines/line_follower.h"
#include "solver/lines/line_row.h"

namespace sunload {

namespace {

/// What the lines of a block of sensors leave beside their links.
struct Output {
  std::vector<Glimpse> glimpses;
  std::uint64_t rays = 0;
};

/// Lines of one sensor in one realization. Returns the rays cast.
std::uint64_t trace(const Sensor& sensor, const Hierarchy& hierarchy, const RayCaster& caster,
                    const LineFollower& follower, const BrightView& view, const RandomKey& key,
                    std::size_t lines, LineCollector& into) {
  const Vec3 origin = sensor.position + sensor.normal * caster.offset_m();
  const Tangents axes = tangents(sensor.normal);
  const auto seeds = random_words(key);
  std::uint64_t rays = 0;
  for (std::size_t first = 0; first < lines; first += packet_size) {
    const std::size_t count = std::min(packet_size, lines - first);
    Vec3 w[packet_size];
    Packet origins{}, directions{};
    for (std::size_t l = 0; l < count; ++l) {
      const auto index = static_cast<std::uint32_t>(first + l);
      const double u = scrambled_sobol(index, 0, seeds);
      const double v = scrambled_sobol(index, 1, seeds);
      const Vec3 local = sample_cosine(u, v);
      w[l] = axes.tangent * local.x + axes.bitangent * local.y + sensor.normal * local.z;
      put(origins, l, origin);
      put(directions, l, w[l]);
    }
    const auto hits = caster.first_hits(origins, directions, (1u << count) - 1u);
    rays += count;
    for (std::size_t l = 0; l < count; ++l) {
      RandomKey of_line = key;
      of_line.purpose = Purpose::glossy;
      of_line.sun = static_cast<std::uint32_t>(first + l);
      rays +=
          follower.follow(origin, w[l], hits[l], of_line, into,
                          view.share_of_line(hierarchy, hits[l], w[l], dot(w[l], sensor.normal)));
    }
  }
  if (!view.any()) return rays;
  RandomKey of_points = key;
  of_points.purpose = Purpose::lamps;
  return rays + view.see_points(caster, random_words(of_points), lines,
                                [&](const auto& point) { follower.link(point, into); });
}

}  // namespace

Lines trace_sensor_lines(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                         const SkyGrid& grid, const Guide& guide, const LineRules& rules) {
  SUNLOAD_EXPECT(rules.realizations >= 1 && rules.lines_per_patch % rules.realizations == 0,
                 "lines are shared equally by the realizations");
  const auto& sensors = scene.sensors;
  const auto each = static_cast<std::size_t>(rules.lines_per_patch / rules.realizations);
  const LineFollower follower(scene, hierarchy, caster, grid, rules.mirror_depth);
  Lines lines;
  lines.pooled = empty_line_set(sensors.size(), hierarchy.element_count(),
                                static_cast<std::size_t>(grid.cell_count()), guide.any());
  lines.realizations.assign(static_cast<std::size_t>(rules.realizations), lines.pooled);
  std::vector<Output> outputs(lines.pooled.patches.blocks.size());
  const auto trace_block = [&](std::size_t begin, std::size_t end) {
    Output& output = outputs[begin / LinkTable::rows_per_block];
    LineRow row;
    BrightView view(guide);
    for (std::size_t s = begin; s < end; ++s) {
      row.begin(0);
      view.look_from(sensors[s].position, sensors[s].normal);
      for (std::size_t r = 0; r < lines.realizations.size(); ++r) {
        output.rays += trace(sensors[s], hierarchy, caster, follower, view,
                             {.seed = rules.seed,
                              .purpose = Purpose::lines,
                              .realization = static_cast<std::uint32_t>(r),
                              .element = sensors[s].key},
                             each, row.own());
        row.end_realization(s, output.glimpses);
      }
      row.store(s, each, lines);
    }
  };
  parallel_chunks(sensors.size(), LinkTable::rows_per_block, trace_block);
  for (const auto& output : outputs) {
    lines.rays += output.rays;
    lines.glimpses.insert(lines.glimpses.end(), output.glimpses.begin(), output.glimpses.end());
  }
  return lines;
}

}  // namespace sunload
