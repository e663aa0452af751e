// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Work that was done, and the time it took.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sunload {

/// What is counted. New ones come last: batch files hold them in this order. Each has its row in
/// `work_kinds`.
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
  end              ///< how many there are
};
inline constexpr auto work_count = static_cast<std::size_t>(Work::end);

/// How results tell of it, among their root attributes.
struct WorkKind {
  /// What the number counts.
  enum class Unit : std::uint8_t { count, seconds };
  /// For which results the number is written.
  enum class Told : std::uint8_t { always, when_shooting, never };
  Work work;
  const char* name;
  Unit unit;
  Told told = Told::always;
};
inline constexpr std::array<WorkKind, work_count> work_kinds{{
    {Work::line_rays, "line_rays", WorkKind::Unit::count},
    {Work::direct_rays, "direct_rays", WorkKind::Unit::count},
    {Work::mirror_rays, "mirror_rays", WorkKind::Unit::count},
    {Work::lines_s, "runtime_lines_s", WorkKind::Unit::seconds},
    {Work::direct_s, "runtime_direct_s", WorkKind::Unit::seconds},
    {Work::mirror_s, "runtime_mirror_s", WorkKind::Unit::seconds},
    {Work::solve_s, "runtime_solve_s", WorkKind::Unit::seconds},
    {Work::realizations_s, "runtime_realizations_s", WorkKind::Unit::seconds},
    {Work::mirror_beams, "mirror_beams", WorkKind::Unit::count},
    {Work::mirror_shots, "mirror_shots", WorkKind::Unit::count},
    {Work::samples, "samples_shot", WorkKind::Unit::count, WorkKind::Told::when_shooting},
    {Work::shot_rays, "shot_rays", WorkKind::Unit::count, WorkKind::Told::when_shooting},
    {Work::shoot_s, "runtime_shoot_s", WorkKind::Unit::seconds, WorkKind::Told::when_shooting},
    {Work::sensor_rays, "sensor_rays", WorkKind::Unit::count},
    {Work::sensors_s, "runtime_sensors_s", WorkKind::Unit::seconds},
    {Work::wanted_samples, "wanted_samples", WorkKind::Unit::count, WorkKind::Told::never},
}};
static_assert(
    [] {
      for (std::size_t i = 0; i < work_count; ++i)
        if (work_kinds[i].work != static_cast<Work>(i) || !work_kinds[i].name) return false;
      return true;
    }(),
    "every kind of work has its row, in the order of the list");

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
