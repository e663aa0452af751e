// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/traced/ray_record.h"

#include <array>
#include <utility>

#include "geo/base/check.h"

namespace sunload {

namespace {

constexpr std::array counts{Work::direct_rays, Work::mirror_rays, Work::mirror_beams,
                            Work::mirror_shots, Work::sensor_rays};

double bytes_of(const Columns& columns) {
  return static_cast<double>(columns.size() * sizeof(columns.front()));
}

double bytes_of(const std::vector<Columns>& of_realizations) {
  double bytes = 0;
  for (const Columns& columns : of_realizations) bytes += bytes_of(columns);
  return bytes;
}

double bytes_of(const RayLight& light) {
  const auto& [pooled, sunlit, of_realizations, by_samples] = light;
  return bytes_of(pooled.direct) + bytes_of(pooled.mirror) + bytes_of(pooled.circumsolar) +
         bytes_of(sunlit) + bytes_of(of_realizations.direct) + bytes_of(of_realizations.mirror) +
         bytes_of(of_realizations.circumsolar) + bytes_of(by_samples);
}

double bytes_of(const RaySums& sums) {
  double bytes = 0;
  for (const auto* kind : {&sums.direct, &sums.mirror, &sums.circumsolar, &sums.gloss})
    for (const auto& of_realization : *kind)
      bytes += static_cast<double>(of_realization.size() * sizeof(of_realization.front()));
  return bytes;
}

void empty(RayRecord& record, RayRecord::State state) {
  RayRecord nothing;
  nothing.most_bytes = record.most_bytes;
  nothing.suns_sky = record.suns_sky;
  nothing.state = state;
  record = std::move(nothing);
}

}  // namespace

BatchRays::BatchRays(const TracedScene& traced, SunsSky suns_sky, RayRecord* record)
    : traced_(traced), record_(record) {
  if (!record_) return;
  if (!takes()) {
    record_->suns_sky = suns_sky;
    empty(*record_, RayRecord::State::written);
  } else if (record_->suns_sky != suns_sky) {
    record_ = nullptr;
  }
}

BlockRays BatchRays::next(const BlockSources& sources, const Kept& kept,
                          std::span<const TimedSums> sums, WorkDone& work) {
  if (takes()) {
    SUNLOAD_EXPECT(taken_ < record_->blocks.size(), "a record has every block of its batch");
    return record_->blocks[taken_++];
  }
  if (!record_) return light_iteration(traced_, sources, kept, sums, work);
  const WorkDone before = work;
  BlockRays rays = light_iteration(traced_, sources, kept, sums, work);
  for (const Work kind : counts) record_->work[kind] += work[kind] - before[kind];
  keep(rays);
  return rays;
}

void BatchRays::keep(const BlockRays& rays) {
  if (record_->state != RayRecord::State::written) return;
  record_->bytes += bytes_of(rays.on_patches) + bytes_of(rays.on_sensors);
  if (record_->bytes > record_->most_bytes)
    empty(*record_, RayRecord::State::given_up);
  else
    record_->blocks.push_back(rays);
}

void BatchRays::end(std::span<TimeSums* const> sums, WorkDone& work) {
  if (!record_) return;
  if (takes()) {
    SUNLOAD_EXPECT(sums.size() == record_->on_patches.size(), "a record has every sum over time");
    work += record_->work;
    for (std::size_t s = 0; s < sums.size(); ++s) {
      sums[s]->on_patches = record_->on_patches[s];
      sums[s]->on_sensors = record_->on_sensors[s];
    }
  } else if (record_->state == RayRecord::State::written) {
    keep(sums);
  }
}

void BatchRays::keep(std::span<TimeSums* const> sums) {
  for (const TimeSums* of : sums)
    record_->bytes += bytes_of(of->on_patches) + bytes_of(of->on_sensors);
  if (record_->bytes > record_->most_bytes) return empty(*record_, RayRecord::State::given_up);
  for (const TimeSums* of : sums) {
    record_->on_patches.push_back(of->on_patches);
    record_->on_sensors.push_back(of->on_sensors);
  }
  record_->state = RayRecord::State::whole;
}

}  // namespace sunload
