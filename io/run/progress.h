// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Progress on stderr, signals and time limits: how long work is watched.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>

#include "solver/base/watch.h"

namespace sunload {

/// How progress is shown; automatic: a bar on a terminal, else lines.
enum class ProgressStyle { automatic, bar, lines, json, none };

/// Ends parallel work on a signal or at the time limit while it lives, and tells of the work on
/// stderr: stage, sun positions done and all, rays per second, time left, memory. On a terminal a
/// bar; otherwise a line at most every 10 s, or one JSON object per line (docs/cluster.md).
class Progress : public Watch {
 public:
  explicit Progress(ProgressStyle style, double time_limit_min = 0);
  ~Progress() override;

  /// A variant of so many sun positions.
  void begin_variant(const std::string& name, std::size_t suns);
  /// The next batch: its sun positions, and those that are finished before it.
  void begin_batch(std::size_t finished, std::size_t suns);
  void advance(Stage stage, double share) override;
  void cast(double rays) override;
  /// A line of its own; as JSON {"message"}; without progress nothing.
  void say(const std::string& text);
  /// The same for what has gone wrong or may have: also without progress.
  void warn(const std::string& text);
  /// A signal came, or the time is up.
  bool stop_requested() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct State;
  void begin_stage(Stage stage);
  State state(Stage stage, double share) const;
  void print(const State& state);
  void end_bar();

  ProgressStyle style_;
  double time_limit_s_;
  std::mutex guard_;
  std::string variant_, stage_;
  std::size_t suns_ = 0;      ///< of the variant
  std::size_t finished_ = 0;  ///< before the batch in hand
  std::size_t in_batch_ = 0;  ///< of the batch in hand
  double computed_ = 0;       ///< of `finished_`, in this stage
  double rays_ = 0;           ///< cast in the stage
  Clock::time_point start_ = Clock::now(), stage_start_ = start_, last_ = start_;
  bool bar_is_open_ = false;
};

}  // namespace sunload
