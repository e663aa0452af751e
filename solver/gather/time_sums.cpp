// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/time_sums.h"

#include <algorithm>

#include "geo/base/units.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

double seconds(const BlockSources& sources, std::span<const double> shares, std::size_t k) {
  const double length_s = sources.suns[k].length_s;
  return shares.empty() ? length_s : shares[k] * length_s;
}

}  // namespace

TimeSums::TimeSums(std::size_t realizations, std::size_t patches, std::size_t sensors,
                   std::size_t sky_cells)
    : on_patches(realizations, patches),
      on_sensors(realizations, sensors),
      sky(sky_cells, 0),
      sky_of_lines(sky),
      sent_on(realizations) {}

void TimeSums::add_sources(const BlockSources& sources, std::span<const double> shares) {
  add_whole_sources(sources, shares);
  for (std::size_t k = 0; k < sources.suns.size(); ++k) {
    const double time = seconds(sources, shares, k);
    for (std::size_t c = 0; c < sources.suns[k].sky.size(); ++c)
      sky_of_lines[c] += pi * sources.radiance_for_lines(k, c) * time;
  }
}

void TimeSums::add_whole_sources(const BlockSources& sources, std::span<const double> shares) {
  for (std::size_t k = 0; k < sources.suns.size(); ++k) {
    const IntervalLight& sun = sources.suns[k];
    const double time = seconds(sources, shares, k);
    for (std::size_t c = 0; c < sun.sky.size(); ++c) sky[c] += pi * sun.sky[c] * time;
    ground += sun.ground_exitance * time;
    length_s += time;
  }
}

FirstExposure first_exposure(const LineSet& lines, const PatchOptics& optics, const TimeSums& sums,
                             const ExposureByRays& by_rays) {
  const std::size_t rows = lines.ends.size();
  const std::vector<double>& circumsolar = by_rays.circumsolar;
  const std::vector<double> zeros(rows, 0);
  FirstExposure first{zeros, by_rays.by_mirror, zeros, zeros, zeros};
  gather(lines.sky, circumsolar.empty() ? sums.sky : sums.sky_of_lines, first.sky, Into::replace);
  if (optics.any_mirror) gather(lines.sky_by_mirror, sums.sky, first.mirror, Into::add);
  for (const auto* lamps : {&lines.lamps, &by_rays.parallel})
    for (std::size_t i = 0; i < lamps->size(); ++i) first.lamps[i] += (*lamps)[i] * sums.length_s;
  parallel_for(
      rows,
      [&](std::size_t i) {
        if (!circumsolar.empty()) first.sky[i] = std::max(0.0, first.sky[i] + circumsolar[i]);
        first.base[i] = by_rays.direct[i] + first.sky[i] + first.mirror[i] + first.lamps[i];
        first.ground[i] =
            static_cast<double>(lines.ends[i].ground + lines.ends[i].ground_by_mirror) *
            sums.ground;
      },
      receivers_per_chunk);
  return first;
}

}  // namespace sunload
