// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/block_light.h"

#include <array>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"
#include "solver/gather/unfollowed.h"
#include "solver/mesh/push_pull.h"

namespace sunload {

namespace {

/// Calls change(at) for the place of every value.
template <class Change>
void for_each_value(const Columns& of, const Change& change) {
  parallel_for(of.size(), change, receivers_per_chunk * block_width);
}

}  // namespace

BlockSources::BlockSources(std::span<const IntervalLight> block, std::size_t sky_cells)
    : suns(block), sky(columns(sky_cells)) {
  SUNLOAD_EXPECT(block.size() <= block_width, "no more suns than a block has");
  expect_valid(block, sky_cells);
  circumsolar_factor.fill(1);
  for (std::size_t k = 0; k < suns.size(); ++k) {
    ground_exitance[k] = static_cast<float>(suns[k].ground_exitance);
    for (std::size_t c = 0; c < suns[k].sky.size(); ++c)
      sky[c * block_width + k] = static_cast<float>(pi * suns[k].sky[c]);
  }
  sky_of_lines = sky;
}

void BlockSources::split_sky(const SkyGrid& grid) {
  for (std::size_t k = 0; k < suns.size(); ++k) {
    circumsolar.emplace_back(grid, suns[k]);
    if (!circumsolar[k].any()) continue;
    for (std::size_t c = 0; c < suns[k].sky.size(); ++c)
      sky_of_lines[c * block_width + k] = static_cast<float>(pi * radiance_for_lines(k, c));
  }
}

BlockLight light_by_rays(const LineSet& lines, RayColumns rays,
                         const std::vector<double>& parallel) {
  BlockLight light;
  light.direct = std::move(rays.direct);
  light.mirror = std::move(rays.mirror);
  light.lamps.assign(lines.lamps.begin(), lines.lamps.end());
  light.lamps.resize(lines.ends.size(), 0);
  for (std::size_t i = 0; i < parallel.size(); ++i)
    light.lamps[i] += static_cast<float>(parallel[i]);
  return light;
}

Columns far_ground_light(const LineSet& lines, const BlockSources& sources) {
  Columns light = columns(lines.ends.size());
  parallel_for(
      lines.ends.size(),
      [&](std::size_t i) {
        const float seen = lines.ends[i].ground + lines.ends[i].ground_by_mirror;
        for (std::size_t k = 0; k < block_width; ++k)
          light[i * block_width + k] = seen * sources.ground_exitance[k];
      },
      receivers_per_chunk);
  return light;
}

BlockLight unreflected_light(const LineSet& lines, const PatchOptics& optics,
                             const BlockSources& sources, RayColumns rays,
                             const std::vector<double>& parallel) {
  const std::size_t rows = lines.ends.size();
  const Columns circumsolar = std::move(rays.circumsolar);
  BlockLight light = light_by_rays(lines, std::move(rays), parallel);
  light.sky = columns(rows);
  const bool split = !circumsolar.empty();
  gather(lines.sky, split ? sources.sky_of_lines : sources.sky, light.sky, Into::replace);
  for_each_value(circumsolar, [&](std::size_t at) {
    light.sky[at] = std::max(0.0f, light.sky[at] + circumsolar[at]);
  });
  if (optics.any_mirror) gather(lines.sky_by_mirror, sources.sky, light.mirror, Into::add);
  light.reflected = far_ground_light(lines, sources);
  return light;
}

BlockLight block_light(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                       const BlockSources& sources, RayColumns rays,
                       const std::vector<double>& parallel, const BounceRules& rules) {
  BlockLight light = unreflected_light(lines, optics, sources, std::move(rays), parallel);
  Columns base = columns(optics.diffuse.size());
  parallel_for(
      optics.diffuse.size(),
      [&](std::size_t i) {
        for (std::size_t k = 0; k < block_width; ++k) {
          const std::size_t at = i * block_width + k;
          base[at] = light.direct[at] + light.sky[at] + light.mirror[at] + light.lamps[i];
        }
      },
      receivers_per_chunk);
  Reflected reflected = reflect(mesh, lines, optics, base, light.reflected, rules.bounces);
  if (!rules.beyond.empty()) light.estimated = unfollowed(reflected, rules.beyond);
  // Never below 0: no bounce takes light away, and roundings keep the order of what they round.
  light.last = std::move(reflected.before);
  light.reflected = std::move(reflected.irradiance);
  for_each_value(light.last,
                 [&](std::size_t at) { light.last[at] = light.reflected[at] - light.last[at]; });
  light.gathered_radiosity = std::move(reflected.gathered_radiosity);
  for_each_value(light.estimated,
                 [&](std::size_t at) { light.reflected[at] += light.estimated[at]; });
  return light;
}

Columns radiosity_of_all_light(const Hierarchy& mesh, const PatchOptics& optics,
                               const BlockLight& light) {
  Columns radiosity = reflected_radiosity(optics, light, mesh.element_count());
  pull_up(mesh, radiosity);
  return radiosity;
}

Columns seen_radiosity(const Hierarchy& mesh, const PatchOptics& optics, BlockLight& light) {
  return light.estimated.empty() ? std::move(light.gathered_radiosity)
                                 : radiosity_of_all_light(mesh, optics, light);
}

std::vector<Ledger> block_ledger(const LineSet& lines, const PatchOptics& optics,
                                 const std::vector<double>& area, const BlockSources& sources,
                                 const BlockLight& light) {
  using Ledgers = std::array<Ledger, block_width>;
  const std::size_t suns = sources.suns.size();
  const std::size_t tasks = chunk_count(area.size(), receivers_per_chunk);
  std::vector<Ledgers> parts(tasks);
  parallel_chunks(area.size(), receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    Ledgers& part = parts[begin / receivers_per_chunk];
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < suns; ++k) {
        const std::size_t at = i * block_width + k;
        const double estimated =
            light.estimated.empty() ? 0 : static_cast<double>(light.estimated[at]);
        const double total = static_cast<double>(light.total(i, k)) - estimated;
        part[k] += ledger_of_patch(
            {.area = area[i],
             .diffuse = static_cast<double>(optics.diffuse[i]),
             .absorbed = optics.absorbed(i),
             .passed = static_cast<double>(optics.passed[i]),
             .emission = static_cast<double>(optics.emission[i]),
             .direct = static_cast<double>(light.direct[at]),
             .sky = static_cast<double>(light.sky[at]),
             .ground_exitance = static_cast<double>(sources.ground_exitance[k]),
             .total = total,
             .gathered_radiosity = static_cast<double>(light.gathered_radiosity[at]),
             .last = light.last.empty() ? total : static_cast<double>(light.last[at]),
             .estimated = estimated},
            lines.ends[i]);
      }
  });
  std::vector<Ledger> ledger(suns);
  for (std::size_t k = 0; k < suns; ++k) {
    for (const auto& part : parts) ledger[k] += part[k];
    ledger[k] += ledger_of_mirrored(
        lines.mirrored_fates,
        [&](std::size_t c) { return static_cast<double>(sources.sky[c * block_width + k]); },
        static_cast<double>(sources.ground_exitance[k]));
  }
  return ledger;
}

}  // namespace sunload
