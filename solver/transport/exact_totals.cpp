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

/// Scales the reflected light of receivers begin, …, begin + count - 1 until its sum over that time
/// is right.
void scale_to(const Known& time, const std::vector<Interval>& intervals, const Light& before,
              std::size_t begin, std::size_t count, Light& now) {
  OfChunk<double> changed{}, scalable{};
  for (std::size_t n = 0; n < intervals.size(); ++n) {
    const double share = time.share_of(intervals[n].row);
    if (share == 0) continue;
    const double seconds = share * intervals[n].length_s;
    add_difference(now[n].data(), before[n].data(), seconds, changed.data());
    add(now[n].data(), share * seconds, scalable.data());
  }
  OfChunk<float> more{};
  for (std::size_t i = 0; i < count; ++i) {
    const double missing = mean_of(time.exposure, begin + i) - (time.total[begin + i] + changed[i]);
    if (scalable[i] > 0) more[i] = static_cast<float>(std::max(missing / scalable[i], -1.0));
  }
  for (std::size_t n = 0; n < intervals.size(); ++n)
    if (const double share = time.share_of(intervals[n].row); share > 0)
      scale(now[n].data(), more.data(), static_cast<float>(share));
}

/// How what a receiver gets in all changes is shared out: reflected light becomes that of the
/// realizations, the sky takes the rest, and nothing falls below 0.
struct SharedOut {
  double reflected, sky;  ///< changes [J m-2]
};
SharedOut shared_out(double changed, double reflected, double exact_reflected,
                     std::optional<double> sky) {
  if (!sky) return {std::max(changed, -reflected), 0};
  const double of_sky = std::max(changed - (exact_reflected - reflected), -*sky);
  return {std::max(changed - of_sky, -reflected), of_sky};
}

/// Changes series and sums of the parts of receivers begin … end - 1, of which the totals have
/// changed.
void put_parts(const std::vector<Interval>& intervals, const Light& before, const Light& now,
               std::size_t begin, std::size_t end, const std::vector<double>& changed,
               ReceiverTally& tally) {
  const auto part = [](auto& of_parts, Part which) -> auto& {
    return of_parts[static_cast<std::size_t>(which)];
  };
  std::vector<double>&reflected = part(tally.exposure, Part::reflected),
  &sky = part(tally.exposure, Part::sky);
  LargeVector<float>&reflected_series = part(tally.irradiance, Part::reflected),
  &sky_series = part(tally.irradiance, Part::sky);
  const Realizations& exact = part(tally.part_realization, Part::reflected);
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t lane = i - begin;
    const auto shares = shared_out(changed[i], reflected[i],
                                   exact.empty() ? reflected[i] + changed[i] : mean_of(exact, i),
                                   sky.empty() ? std::nullopt : std::optional(sky[i]));
    const double more = reflected[i] > 0 ? shares.reflected / reflected[i] : 0;
    reflected[i] += shares.reflected;
    if (!sky.empty()) sky[i] += shares.sky;
    if (reflected_series.empty() && sky_series.empty()) continue;
    for (std::size_t n = 0; n < intervals.size(); ++n) {
      const std::size_t at = intervals[n].row * changed.size() + i;
      const float of_reflected = static_cast<float>(more) * before[n][lane];
      const float of_sky = now[n][lane] - before[n][lane] - of_reflected;
      const auto add_to = [&](LargeVector<float>& series, float by) {
        if (!series.empty()) series[at] = std::max(0.0f, series[at] + by);
      };
      add_to(reflected_series, sky.empty() ? of_reflected + of_sky : of_reflected);
      if (!sky.empty()) add_to(sky_series, of_sky);
    }
  }
}

/// Changes series, sums and times of receivers begin … end - 1 by what their reflected light has
/// changed by.
void put(const std::vector<Interval>& intervals, const Light& before, const Light& now,
         std::size_t begin, std::size_t end, std::vector<double>& changed, ReceiverTally& tally) {
  const std::size_t receivers = changed.size(), count = end - begin;
  LargeVector<float>& series = tally.irradiance[static_cast<std::size_t>(Part::total)];
  OfChunk<float> joules;
  for (std::size_t n = 0; n < intervals.size(); ++n) {
    const std::size_t row = intervals[n].row;
    change(&series[row * receivers + begin], now[n].data(), before[n].data(),
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
  put_parts(intervals, before, now, begin, end, changed, tally);
}

}  // namespace

void ExactTotals::keep(const Block& block, const Columns& patches, const Columns& sensors) {
  for (std::size_t k = 0; k < block.suns.size(); ++k)
    intervals_.push_back({block.rows[k], block.suns[k].length_s});
  blocks_.push_back({block.suns.size(), PackedColumns(patches), PackedColumns(sensors)});
}

void ExactTotals::take(const PatchOptics& optics, BatchTally& tally) const {
  std::vector<double> changed;
  take(&Reflected::patches, tally, changed);
  for (std::size_t i = 0; i < tally.outgoing.size(); ++i)
    tally.outgoing[i] += static_cast<double>(optics.diffuse[i]) * changed[i];
  take(&Reflected::sensors, tally.sensors, changed);
}

/// Of receivers begin … end - 1.
ExactTotals::Light ExactTotals::light_of(PackedColumns Reflected::*of_receivers, std::size_t begin,
                                         std::size_t end) const {
  Light light(intervals_.size());
  std::size_t first = 0;
  for (const Reflected& block : blocks_) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < block.intervals; ++k)
        light[first + k][i - begin] = (block.*of_receivers).at(i, k);
    first += block.intervals;
  }
  return light;
}

/// `changed`: what sums change by, of every receiver [J m-2].
void ExactTotals::take(PackedColumns Reflected::*of_receivers, ReceiverTally& tally,
                       std::vector<double>& changed) const {
  const std::size_t receivers = tally.sunlit_s.size();
  changed.assign(receivers, 0);
  if (receivers == 0 || tally.exposure[static_cast<std::size_t>(Part::reflected)].empty()) return;
  const std::vector<Known> times = known_times(tally);
  std::fill(tally.irradiance_max.begin(), tally.irradiance_max.end(), 0.0f);
  parallel_chunks(receivers, receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    const Light before = light_of(of_receivers, begin, end);
    Light now = before;
    for (int turn = 0; turn < (times.size() > 1 ? turns : 1); ++turn)
      for (const Known& time : times) scale_to(time, intervals_, before, begin, end - begin, now);
    put(intervals_, before, now, begin, end, changed, tally);
  });
}

}  // namespace sunload
