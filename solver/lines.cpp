#include "solver/lines.h"

#include <algorithm>
#include <atomic>

#include "geo/check.h"
#include "solver/line_follower.h"
#include "solver/parallel.h"
#include "solver/patch_lines.h"
#include "solver/rng.h"

namespace sunload {

LinkTable::LinkTable(std::size_t rows) : blocks((rows + rows_per_block - 1) / rows_per_block) {}

std::size_t LinkTable::link_count() const {
  std::size_t count = 0;
  for (const auto& block : blocks) count += block.target.size();
  return count;
}

std::size_t LinkTable::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& b : blocks)
    bytes += 4 * (b.begin.capacity() + b.target.capacity() + b.weight.capacity());
  return bytes;
}

void LinkTable::append_row(Block& block, std::vector<Link>& links, float scale) {
  std::sort(links.begin(), links.end(), [](const Link& a, const Link& b) {
    return a.target != b.target ? a.target < b.target : a.weight < b.weight;
  });
  for (std::size_t l = 0; l < links.size();) {
    const auto target = links[l].target;
    float weight = 0;
    for (; l < links.size() && links[l].target == target; ++l) weight += links[l].weight;
    block.target.push_back(target);
    block.weight.push_back(weight * scale);
  }
  block.begin.push_back(static_cast<std::uint32_t>(block.target.size()));
}

LineSet empty_line_set(std::size_t rows, bool any_lamps) {
  return {LinkTable(rows), LinkTable(rows), LinkTable(rows), std::vector<LineEnds>(rows),
          std::vector<double>(any_lamps ? rows : 0), {}};
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
        follower_(scene, hierarchy, caster, grid, rules.mirror_depth, rules.largest_link),
        guide_(guide),
        ground_source_(static_cast<std::size_t>(grid.cell_count())) {}

  struct Output {
    std::vector<MirroredFirstLight> first_light;  ///< per realization, empty without mirrors
    std::vector<Glimpse> glimpses;
    std::uint64_t rays = 0;
  };

  Output trace(std::size_t begin, std::size_t end, Lines& lines) const {
    Output output;
    output.first_light.resize(lines.realizations.size());
    LineCollector own, pooled;
    BrightView view(guide_);
    for (std::size_t patch = begin; patch < end; ++patch) {
      pooled.clear();
      view.look_from(hierarchy_, patch);
      for (std::size_t r = 0; r < lines.realizations.size(); ++r) {
        own.clear();
        trace_patch(patch, r, view, own, output);
        for (Glimpse& glimpse : own.glimpses) {
          glimpse.patch = static_cast<std::uint32_t>(patch);
          glimpse.realization = static_cast<std::uint32_t>(r);
        }
        output.glimpses.insert(output.glimpses.end(), own.glimpses.begin(), own.glimpses.end());
        pooled += own;
        own.store(lines.realizations[r], patch, lines_per_realization());
      }
      pooled.store(lines.pooled, patch, rules_.lines_per_patch);
    }
    return output;
  }

 private:
  int lines_per_realization() const { return rules_.lines_per_patch / rules_.realizations; }

  void trace_patch(std::size_t patch, std::size_t realization, const BrightView& view,
                   LineCollector& into, Output& output) const {
    const PatchLines lines(hierarchy_, patch, caster_.offset_m(),
                           line_seeds(hierarchy_, patch, realization, rules_.seed));
    RandomKey key{.seed = rules_.seed,
                  .purpose = Purpose::glossy,
                  .realization = static_cast<std::uint32_t>(realization),
                  .element = hierarchy_.key()[patch]};
    const auto count = static_cast<std::size_t>(lines_per_realization());
    for (std::size_t first = 0; first < count; first += packet_size)
      trace_packet(LinePacket(lines, first, count), patch, view, key, first, into,
                   output.first_light[realization], output.rays);
    if (!view.any()) return;
    key.purpose = Purpose::lamps;
    output.rays += view.see_points(caster_, random_words(key), count,
                                   [&](const auto& point) { follower_.link(point, into); });
  }

  void trace_packet(const LinePacket& lines, std::size_t patch, const BrightView& view,
                    RandomKey key, std::size_t first, LineCollector& into,
                    MirroredFirstLight& first_light, std::uint64_t& rays) const {
    const auto hits = lines.first_hits(caster_);
    const Vec3 normal = hierarchy_.normal(patch);
    rays += lines.count;
    for (std::size_t l = 0; l < lines.count; ++l) {
      const Hit hit = hits[l];
      const auto& [origin, w] = lines.line[l];
      key.sun = static_cast<std::uint32_t>(first + l);
      rays += follower_.follow(origin, w, hit, key, into,
                               view.share_of_line(hierarchy_, hit, w, dot(w, normal)));
      if (hit.left_scene() && sends_on(follower_.material_of_patch(patch)))
        rays += book_mirrored(origin, w, patch, key, first_light);
    }
  }

  /// The line brings first light to a mirror: its way on is booked here, since
  /// no patch's own lines see it leave.
  std::uint64_t book_mirrored(Vec3 origin, Vec3 w, std::size_t patch, const RandomKey& line,
                              MirroredFirstLight& book) const {
    const auto fate = follower_.mirrored_on(origin, w, patch, line);
    const double share = hierarchy_.area()[patch] / lines_per_realization();
    const std::size_t source = w.z > 0 ? follower_.sky_cell(w) : ground_source_;
    MirroredFirstLight::for_each(book, fate, [&](std::vector<double>& power, double part) {
      if (power.empty()) power.assign(ground_source_ + 1, 0);
      power[source] += share * part;
    });
    return fate.rays;
  }

  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  const LineRules& rules_;
  LineFollower follower_;
  const Guide& guide_;
  std::size_t ground_source_;
};

void add(std::vector<double>& to, const std::vector<double>& from, double factor) {
  if (from.empty()) return;
  to.resize(from.size(), 0);
  for (std::size_t i = 0; i < from.size(); ++i) to[i] += factor * from[i];
}

void add(MirroredFirstLight& to, const MirroredFirstLight& from, double factor) {
  MirroredFirstLight::for_each(to, from,
                               [&](auto& sum, const auto& part) { add(sum, part, factor); });
}

void trim(LineSet& set, std::size_t block) {
  for (auto* table : {&set.patches, &set.sky, &set.sky_by_mirror}) {
    auto& b = table->blocks[block];
    b.target.shrink_to_fit();
    b.weight.shrink_to_fit();
  }
}

}  // namespace

Lines trace_lines(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                  const SkyGrid& grid, const Guide& guide, const LineRules& rules,
                  Watch& watch) {
  SUNLOAD_EXPECT(rules.realizations >= 1 && rules.lines_per_patch % rules.realizations == 0,
                 "lines are shared equally by the realizations");
  const std::size_t patches = hierarchy.patch_count();
  const BlockTracer tracer(scene, hierarchy, caster, grid, guide, rules);
  Lines lines;
  lines.pooled = empty_line_set(patches, guide.any());
  lines.realizations.assign(static_cast<std::size_t>(rules.realizations), lines.pooled);

  std::vector<BlockTracer::Output> outputs(lines.pooled.patches.blocks.size());
  std::atomic<std::size_t> done = 0;
  parallel_chunks(patches, LinkTable::rows_per_block, [&](std::size_t begin, std::size_t end) {
    const std::size_t block = begin / LinkTable::rows_per_block;
    outputs[block] = tracer.trace(begin, end, lines);
    for (auto& set : lines.realizations) trim(set, block);
    trim(lines.pooled, block);
    watch.advance(Stage::lines,
                  static_cast<double>(done += end - begin) / static_cast<double>(patches));
  });

  for (const auto& output : outputs) {
    lines.rays += output.rays;
    lines.glimpses.insert(lines.glimpses.end(), output.glimpses.begin(), output.glimpses.end());
    for (std::size_t r = 0; r < output.first_light.size(); ++r) {
      add(lines.realizations[r].first_light, output.first_light[r], 1);
      add(lines.pooled.first_light, output.first_light[r], 1.0 / rules.realizations);
    }
  }
  return lines;
}

}  // namespace sunload
