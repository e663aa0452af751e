// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/lines.h"

#include <algorithm>
#include <atomic>

#include "geo/base/check.h"
#include "solver/base/rng.h"
#include "solver/base/threads.h"
#include "solver/light/tally.h"
#include "solver/lines/line_bundle.h"
#include "solver/lines/line_follower.h"
#include "solver/lines/line_row.h"
#include "solver/lines/patch_lines.h"

namespace sunload {

LineSet empty_line_set(std::size_t rows, std::size_t elements, std::size_t cells, bool any_lamps) {
  return {LinkTable(rows, elements),
          LinkTable(rows, cells),
          LinkTable(rows, cells),
          std::vector<LineEnds>(rows),
          std::vector<double>(any_lamps ? rows : 0),
          {},
          false};
}

std::vector<double> sky_view_factors(const LineSet& lines) {
  std::vector<double> shares;
  for (const LineEnds& ends : lines.ends) shares.push_back(static_cast<double>(ends.sky));
  return shares;
}

std::vector<double> sky_view_errors(const Lines& lines) {
  std::vector<double> errors, of_realizations(lines.realizations.size());
  for (std::size_t row = 0; row < lines.pooled.ends.size(); ++row) {
    for (std::size_t r = 0; r < of_realizations.size(); ++r)
      of_realizations[r] = static_cast<double>(lines.realizations[r].ends[row].sky);
    errors.push_back(mean_error(of_realizations).standard_error);
  }
  return errors;
}

namespace {

/// Lines of the patches of one block, all realizations: the unit of parallel work.
class BlockTracer {
 public:
  BlockTracer(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
              const SkyGrid& grid, const Guide& guide, const LineRules& rules)
      : hierarchy_(hierarchy),
        caster_(caster),
        rules_(rules),
        follower_(scene, hierarchy, caster, grid, rules.mirror_depth),
        grid_(grid),
        guide_(guide),
        ground_source_(static_cast<std::size_t>(grid.cell_count())) {}

  struct Output {
    std::vector<MirroredFates> mirrored_fates;  ///< per realization, empty without mirrors
    std::vector<Glimpse> glimpses;
    std::uint64_t rays = 0;
  };

  Output trace(std::size_t begin, std::size_t end, Lines& lines) const {
    Output output;
    output.mirrored_fates.resize(lines.realizations.size());
    LineBundle bundle;
    Row row{BrightView(guide_), {}};
    for (std::size_t first = begin, last = begin; first < end; first = last) {
      last = end_of_bundle(first, end);
      cast(first, last, bundle);
      std::size_t at = 0;
      for (std::size_t patch = first; patch < last; at += lines_of(patch++))
        follow_patch(patch, bundle, at, row, lines, output);
    }
    return output;
  }

 private:
  /// What one patch's lines bring.
  struct Row {
    BrightView view;
    LineRow lines;
  };

  std::size_t lines_of(std::size_t patch) const {
    return static_cast<std::size_t>(rules_.lines_of(patch));
  }
  std::size_t lines_per_realization(std::size_t patch) const {
    return lines_of(patch) / static_cast<std::size_t>(rules_.realizations);
  }
  /// Enough lines to fill packets with similar directions, few enough for the cache.
  std::size_t end_of_bundle(std::size_t first, std::size_t end) const {
    constexpr std::size_t lines_per_bundle = 4096;
    std::size_t lines = lines_of(first), last = first + 1;
    while (last < end && lines + lines_of(last) <= lines_per_bundle) lines += lines_of(last++);
    return last;
  }

  /// The lines of patches [first, last), realization by realization.
  void cast(std::size_t first, std::size_t last, LineBundle& bundle) const {
    bundle.clear();
    for (std::size_t patch = first; patch < last; ++patch)
      for (std::size_t r = 0; r < static_cast<std::size_t>(rules_.realizations); ++r)
        bundle.add(PatchLines(hierarchy_, patch, caster_.offset_m(),
                              line_seeds(hierarchy_, patch, r, rules_.seed)),
                   lines_per_realization(patch), rules_.largest_link_of(patch));
    bundle.cast(caster_, hierarchy_, grid_);
  }

  /// Its lines are those of the bundle from number `at` on.
  void follow_patch(std::size_t patch, const LineBundle& bundle, std::size_t at, Row& row,
                    Lines& lines, Output& output) const {
    row.view.look_from(hierarchy_, patch);
    row.lines.begin(rules_.largest_link_of(patch));
    const std::size_t lines_each = lines_per_realization(patch);
    for (std::size_t r = 0; r < lines.realizations.size(); ++r) {
      follow_realization(patch, r, bundle, at + r * lines_each, row, output);
      row.lines.end_realization(patch, output.glimpses);
    }
    row.lines.store(patch, lines_each, lines);
  }

  void follow_realization(std::size_t patch, std::size_t realization, const LineBundle& bundle,
                          std::size_t at, Row& row, Output& output) const {
    RandomKey key{.seed = rules_.seed,
                  .purpose = Purpose::glossy,
                  .realization = static_cast<std::uint32_t>(realization),
                  .element = hierarchy_.key()[patch]};
    const Vec3 normal = hierarchy_.normal(patch);
    const bool sends_light_on = sends_on(follower_.material_of_patch(patch));
    const std::size_t count = lines_per_realization(patch);
    LineCollector& own = row.lines.own();
    output.rays += count;
    for (std::size_t l = 0; l < count; ++l) {
      const FirstMeeting& met = bundle.met(at + l);
      const auto& [origin, w] = bundle.line(at + l);
      key.sun = static_cast<std::uint32_t>(l);
      const double share = row.view.share_of_line(hierarchy_, met.hit, w, dot(w, normal));
      output.rays += follower_.follow(origin, w, met, key, own, share);
      if (met.hit.left_scene() && sends_light_on)
        output.rays += book_mirrored(origin, w, patch, key, output.mirrored_fates[realization]);
    }
    if (!row.view.any()) return;
    key.purpose = Purpose::lamps;
    output.rays += row.view.see_points(caster_, random_words(key), count,
                                       [&](const auto& point) { follower_.link(point, own); });
  }

  /// The line brings first light to a mirror: its way on is booked here, since
  /// no patch's own lines see it leave.
  std::uint64_t book_mirrored(Vec3 origin, Vec3 w, std::size_t patch, const RandomKey& line,
                              MirroredFates& book) const {
    const auto sent = follower_.mirrored_on(origin, w, patch, line);
    const auto lines_each = static_cast<double>(lines_per_realization(patch));
    const double share = hierarchy_.area()[patch] / lines_each;
    const std::size_t source = w.z > 0 ? follower_.sky_cell(w) : ground_source_;
    book.resize(ground_source_ + 1);
    book[source] += scaled(sent.fate, share);
    return sent.rays;
  }

  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  const LineRules& rules_;
  LineFollower follower_;
  const SkyGrid& grid_;
  const Guide& guide_;
  std::size_t ground_source_;
};

void add(MirroredFates& to, const MirroredFates& from, double factor) {
  if (from.empty()) return;
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) to[i] += scaled(from[i], factor);
}

void trim(LineSet& set, std::size_t block) {
  for (auto* table : {&set.patches, &set.sky, &set.sky_by_mirror}) table->blocks[block].trim();
}

void expect_shared_equally(const LineRules& rules, std::size_t patches) {
  SUNLOAD_EXPECT(rules.realizations >= 1, "at least one realization");
  SUNLOAD_EXPECT(rules.lines_of_patch.empty() || rules.lines_of_patch.size() == patches,
                 "lines of every patch");
  const auto is_shared = [&](int lines) { return lines % rules.realizations == 0; };
  SUNLOAD_EXPECT(
      is_shared(rules.lines_per_patch) &&
          std::all_of(rules.lines_of_patch.begin(), rules.lines_of_patch.end(), is_shared),
      "lines are shared equally by the realizations");
}

}  // namespace

Lines trace_lines(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                  const SkyGrid& grid, const Guide& guide, const LineRules& rules, Watch& watch) {
  const std::size_t patches = hierarchy.patch_count();
  expect_shared_equally(rules, patches);
  const BlockTracer tracer(scene, hierarchy, caster, grid, guide, rules);
  Lines lines;
  lines.pooled = empty_line_set(patches, hierarchy.element_count(),
                                static_cast<std::size_t>(grid.cell_count()), guide.any());
  lines.realizations.assign(static_cast<std::size_t>(rules.realizations), lines.pooled);

  std::vector<BlockTracer::Output> outputs(lines.pooled.patches.blocks.size());
  std::atomic<std::size_t> done = 0;
  parallel_chunks(patches, LinkTable::rows_per_block, [&](std::size_t begin, std::size_t end) {
    const std::size_t block = begin / LinkTable::rows_per_block;
    outputs[block] = tracer.trace(begin, end, lines);
    for (auto& set : lines.realizations) trim(set, block);
    trim(lines.pooled, block);
    watch.cast(static_cast<double>(outputs[block].rays));
    watch.advance(Stage::lines,
                  static_cast<double>(done += end - begin) / static_cast<double>(patches));
  });

  for (const auto& output : outputs) {
    lines.rays += output.rays;
    lines.glimpses.insert(lines.glimpses.end(), output.glimpses.begin(), output.glimpses.end());
    for (std::size_t r = 0; r < output.mirrored_fates.size(); ++r) {
      add(lines.realizations[r].mirrored_fates, output.mirrored_fates[r], 1);
      add(lines.pooled.mirrored_fates, output.mirrored_fates[r], 1.0 / rules.realizations);
    }
  }
  return lines;
}

}  // namespace sunload
