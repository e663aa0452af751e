// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/exact_totals.h"

#include <algorithm>
#include <optional>

#include "geo/base/vector_code.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

using Realizations = std::vector<std::vector<double>>;

/// Scaling to one part moves the sums of others, by less each time (iterative proportional fitting:
/// Deming & Stephan 1940, On a least squares adjustment of a sampled frequency table).
constexpr int turns = 2;

double mean_of(const Realizations& exposure, std::size_t i) {
  double sum = 0;
  for (const auto& of_one : exposure) sum += of_one[i];
  return sum / static_cast<double>(exposure.size());
}

template <class T>
using OfChunk = ExactTotals::OfChunk<T>;
using Interval = ExactTotals::Interval;
using Light = ExactTotals::Light;

SUNLOAD_VECTOR_CODE void add(const float* __restrict values, double times, double* __restrict to) {
  for (std::size_t i = 0; i < receivers_per_chunk; ++i)
    to[i] += times * static_cast<double>(values[i]);
}

SUNLOAD_VECTOR_CODE void add_difference(const float* __restrict now, const float* __restrict before,
                                        double times, double* __restrict to) {
  for (std::size_t i = 0; i < receivers_per_chunk; ++i)
    to[i] += times * (static_cast<double>(now[i]) - static_cast<double>(before[i]));
}

SUNLOAD_VECTOR_CODE void scale(float* __restrict values, const float* __restrict more,
                               float share) {
  for (std::size_t i = 0; i < receivers_per_chunk; ++i) values[i] *= 1 + share * more[i];
}

/// Changes light of one interval; nothing falls below 0. `changed`: by how much [J m-2]; `most`:
/// the largest value up to now.
SUNLOAD_VECTOR_CODE void change(float* __restrict E, const float* __restrict now,
                                const float* __restrict before, float length_s, std::size_t count,
                                float* __restrict changed, float* __restrict most) {
  for (std::size_t i = 0; i < count; ++i) {
    const float old = E[i], sum = old + (now[i] - before[i]), after = sum > 0 ? sum : 0;
    E[i] = after;
    changed[i] = (after - old) * length_s;
    most[i] = after > most[i] ? after : most[i];
  }
}

/// Time whose sum is known exactly: a part, or all of it.
struct Known {
  const Realizations& exposure;
  const std::vector<double>& total;  ///< of the series as it was
  const std::vector<double>* share;  ///< of every interval's time; null: all of it
  double share_of(std::size_t row) const { return share ? (*share)[row] : 1; }
};

/// Parts first, then all of it: where parts overlap, or know less, it decides.
std::vector<Known> known_times(const ReceiverTally& tally) {
  std::vector<Known> times;
  for (const PartTally& part : tally.parts)
    if (part.with_errors && !part.exposure_realization.empty() && !part.total.empty())
      times.push_back({part.exposure_realization, part.total, &part.share});
  times.push_back(
      {tally.exposure_realization, tally.exposure[static_cast<std::size_t>(Part::total)], nullptr});
  return times;
}

/// The two kinds of light that are made up of few solutions.
struct Made {
  Light reflected, sky;  ///< no sky: empty
};

/// Σ over the intervals of share · length · (now - before), of one kind of light.
OfChunk<double> change_of(const Known& time, const std::vector<Interval>& intervals,
                          const Light& before, const Light& now) {
  OfChunk<double> changed{};
  for (std::size_t n = 0; n < now.size(); ++n)
    if (const double share = time.share_of(intervals[n].row); share > 0)
      add_difference(now[n].data(), before[n].data(), share * intervals[n].length_s,
                     changed.data());
  return changed;
}

/// What scaling by 1 more adds: shares count twice, in the sum and in what is scaled.
OfChunk<double> scalable(const Known& time, const std::vector<Interval>& intervals,
                         const Light& now) {
  OfChunk<double> sum{};
  for (std::size_t n = 0; n < now.size(); ++n)
    if (const double share = time.share_of(intervals[n].row); share > 0)
      add(now[n].data(), share * share * intervals[n].length_s, sum.data());
  return sum;
}

void scale_all(const Known& time, const std::vector<Interval>& intervals,
               const OfChunk<float>& more, Light& now) {
  for (std::size_t n = 0; n < now.size(); ++n)
    if (const double share = time.share_of(intervals[n].row); share > 0)
      scale(now[n].data(), more.data(), static_cast<float>(share));
}

/// By how much what can be scaled becomes what is missing besides; nothing falls below 0.
float more_of(double missing, double scalable) {
  return scalable > 0 ? static_cast<float>(std::max(missing / scalable, -1.0)) : 0;
}

/// Scales both kinds of light of receivers begin, …, begin + count - 1 alike until the sum of all
/// light over that part of the time is right.
void scale_to(const Known& time, const std::vector<Interval>& intervals, const Made& before,
              std::size_t begin, std::size_t count, Made& now) {
  OfChunk<double> changed = change_of(time, intervals, before.reflected, now.reflected);
  OfChunk<double> all = scalable(time, intervals, now.reflected);
  const OfChunk<double> sky_changed = change_of(time, intervals, before.sky, now.sky);
  const OfChunk<double> sky = scalable(time, intervals, now.sky);
  OfChunk<float> more{};
  for (std::size_t i = 0; i < count; ++i) {
    changed[i] += sky_changed[i];
    all[i] += sky[i];
    more[i] =
        more_of(mean_of(time.exposure, begin + i) - (time.total[begin + i] + changed[i]), all[i]);
  }
  scale_all(time, intervals, more, now.reflected);
  scale_all(time, intervals, more, now.sky);
}

/// What a receiver's light of both kinds is to change by over all of the time [J m-2].
struct Changes {
  double reflected, sky;
};
/// Reflected light becomes that of the realizations, or, where these are not known, takes its share
/// of what is missing; the sky takes the rest where there is one.
Changes changes_of(double missing, double reflected, double sky,
                   std::optional<double> exact_reflected) {
  const double both = reflected + sky;
  const double of_both = both > 0 ? missing * reflected / both : 0;
  const double wanted = exact_reflected ? *exact_reflected - reflected : of_both;
  const double of_sky = sky > 0 ? std::max(missing - wanted, -sky) : 0;
  return {std::max(missing - of_sky, -reflected), of_sky};
}

/// Scales each kind of light until its sum over all of the time is right.
void scale_each(const ReceiverTally& tally, const Known& time,
                const std::vector<Interval>& intervals, const Made& before, std::size_t begin,
                std::size_t count, Made& now) {
  const auto& reflected = tally.exposure[static_cast<std::size_t>(Part::reflected)];
  const auto& sky = tally.exposure[static_cast<std::size_t>(Part::sky)];
  const auto& exact = tally.part_realization[static_cast<std::size_t>(Part::reflected)];
  const OfChunk<double> changed = change_of(time, intervals, before.reflected, now.reflected);
  const OfChunk<double> sky_changed = change_of(time, intervals, before.sky, now.sky);
  const OfChunk<double> of_reflected = scalable(time, intervals, now.reflected);
  const OfChunk<double> of_sky = scalable(time, intervals, now.sky);
  OfChunk<float> more{}, more_sky{};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = begin + i;
    const Changes wanted = changes_of(
        mean_of(time.exposure, at) - time.total[at], reflected[at], now.sky.empty() ? 0 : sky[at],
        exact.empty() ? std::nullopt : std::optional(mean_of(exact, at)));
    more[i] = more_of(wanted.reflected - changed[i], of_reflected[i]);
    more_sky[i] = more_of(wanted.sky - sky_changed[i], of_sky[i]);
  }
  scale_all(time, intervals, more, now.reflected);
  scale_all(time, intervals, more_sky, now.sky);
}

/// Changes the series and the sum of one kind of light of receivers begin … end - 1.
void put_kind(const std::vector<Interval>& intervals, const Light& before, const Light& now,
              std::size_t begin, std::size_t end, Part kind, ReceiverTally& tally) {
  LargeVector<float>& series = tally.irradiance[static_cast<std::size_t>(kind)];
  std::vector<double>& exposure = tally.exposure[static_cast<std::size_t>(kind)];
  const std::size_t receivers = exposure.size();
  for (std::size_t n = 0; n < now.size(); ++n)
    for (std::size_t i = begin; i < end; ++i) {
      const float change = now[n][i - begin] - before[n][i - begin];
      exposure[i] += static_cast<double>(change) * intervals[n].length_s;
      if (series.empty()) continue;
      float& E = series[intervals[n].row * receivers + i];
      E = std::max(0.0f, E + change);
    }
  for (std::size_t i = begin; i < end; ++i) exposure[i] = std::max(0.0, exposure[i]);
}

/// Changes series, sums and times of receivers begin … end - 1 by what both kinds of light have
/// changed by.
void put(const std::vector<Interval>& intervals, const Made& before, const Made& now,
         std::size_t begin, std::size_t end, std::vector<double>& changed, ReceiverTally& tally) {
  const std::size_t receivers = changed.size(), count = end - begin;
  LargeVector<float>& series = tally.irradiance[static_cast<std::size_t>(Part::total)];
  OfChunk<float> joules, was, is;
  for (std::size_t n = 0; n < intervals.size(); ++n) {
    const std::size_t row = intervals[n].row;
    was = before.reflected[n];
    is = now.reflected[n];
    for (std::size_t i = 0; i < count && !now.sky.empty(); ++i) {
      was[i] += before.sky[n][i];
      is[i] += now.sky[n][i];
    }
    change(&series[row * receivers + begin], is.data(), was.data(),
           static_cast<float>(intervals[n].length_s), count, joules.data(),
           &tally.irradiance_max[begin]);
    for (std::size_t i = 0; i < count; ++i) changed[begin + i] += static_cast<double>(joules[i]);
    for (PartTally& part : tally.parts)
      if (!part.total.empty() && part.share[row] > 0)
        for (std::size_t i = 0; i < count; ++i)
          part.total[begin + i] += part.share[row] * static_cast<double>(joules[i]);
  }
  for (std::size_t i = begin; i < end; ++i)
    tally.exposure[static_cast<std::size_t>(Part::total)][i] += changed[i];
  put_kind(intervals, before.reflected, now.reflected, begin, end, Part::reflected, tally);
  put_kind(intervals, before.sky, now.sky, begin, end, Part::sky, tally);
}

}  // namespace

void ExactTotals::keep(const Block& block, const FewLight& patches, const FewLight& sensors) {
  for (std::size_t k = 0; k < block.suns.size(); ++k)
    intervals_.push_back({block.rows[k], block.suns[k].length_s});
  blocks_.push_back({block.suns.size(),
                     {PackedColumns(patches.reflected), PackedColumns(patches.sky)},
                     {PackedColumns(sensors.reflected), PackedColumns(sensors.sky)}});
}

void ExactTotals::take(const PatchOptics& optics, BatchTally& tally) const {
  std::vector<double> changed;
  take(&KeptBlock::patches, tally, changed);
  for (std::size_t i = 0; i < tally.outgoing.size(); ++i)
    tally.outgoing[i] += static_cast<double>(optics.diffuse[i]) * changed[i];
  take(&KeptBlock::sensors, tally.sensors, changed);
}

/// Of receivers begin … end - 1.
ExactTotals::Light ExactTotals::light_of(Kept KeptBlock::*of_receivers, PackedColumns Kept::*kind,
                                         std::size_t begin, std::size_t end) const {
  Light light(intervals_.size());
  std::size_t first = 0;
  for (const KeptBlock& block : blocks_) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < block.intervals; ++k)
        light[first + k][i - begin] = (block.*of_receivers.*kind).at(i, k);
    first += block.intervals;
  }
  return light;
}

/// `changed`: what sums change by, of every receiver [J m-2].
void ExactTotals::take(Kept KeptBlock::*of_receivers, ReceiverTally& tally,
                       std::vector<double>& changed) const {
  const std::size_t receivers = tally.sunlit_s.size();
  changed.assign(receivers, 0);
  if (receivers == 0 || tally.exposure[static_cast<std::size_t>(Part::reflected)].empty()) return;
  const bool has_sky = !tally.exposure[static_cast<std::size_t>(Part::sky)].empty();
  const std::vector<Known> times = known_times(tally);
  std::fill(tally.irradiance_max.begin(), tally.irradiance_max.end(), 0.0f);
  parallel_chunks(receivers, receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    const Made before{light_of(of_receivers, &Kept::reflected, begin, end),
                      has_sky ? light_of(of_receivers, &Kept::sky, begin, end) : Light()};
    Made now = before;
    for (int turn = 0; turn < (times.size() > 1 ? turns : 1); ++turn) {
      for (std::size_t t = 0; t + 1 < times.size(); ++t)
        scale_to(times[t], intervals_, before, begin, count, now);
      scale_each(tally, times.back(), intervals_, before, begin, count, now);
    }
    put(intervals_, before, now, begin, end, changed, tally);
  });
}

}  // namespace sunload
