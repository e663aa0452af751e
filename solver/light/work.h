// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Work that was done, and the time it took.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sunload {

/// What is counted. New ones come last: batch files hold them in this order.
enum class Work : std::uint8_t {
  line_rays,
  direct_rays,
  mirror_rays,
  lines_s,
  direct_s,
  mirror_s,
  solve_s,
  realizations_s,
  mirror_beams,  ///< of all suns, by image directions
  mirror_shots,  ///< arrivals of mirrored sun that no beam stands for
  samples,       ///< shot
  shot_rays,     ///< cast for samples, chains included
  shoot_s,
  sensor_rays,
  sensors_s,
  wanted_samples,  ///< shot, but for those that patches get who would have none
};
inline constexpr std::size_t work_count = 16;

/// Counts (exact up to 2^53) and seconds, by `Work`.
class WorkDone {
 public:
  double& operator[](Work kind) { return done_[static_cast<std::size_t>(kind)]; }
  double operator[](Work kind) const { return done_[static_cast<std::size_t>(kind)]; }
  void add(Work kind, std::uint64_t count) { (*this)[kind] += static_cast<double>(count); }
  /// Cast for the light of suns.
  double rays() const {
    return (*this)[Work::direct_rays] + (*this)[Work::mirror_rays] + (*this)[Work::shot_rays] +
           (*this)[Work::sensor_rays];
  }
  WorkDone& operator+=(const WorkDone& more) {
    for (std::size_t i = 0; i < work_count; ++i) done_[i] += more.done_[i];
    return *this;
  }
  /// All of them, in the order of `Work`.
  std::array<double, work_count>& values() { return done_; }
  const std::array<double, work_count>& values() const { return done_; }

 private:
  std::array<double, work_count> done_{};
};

}  // namespace sunload
