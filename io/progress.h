/// Progress on stderr, signals and time limits: how long work is watched.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

#include "solver/watch.h"

namespace sunload {

enum class ProgressStyle { automatic, bar, lines, json, none };

/// Ends parallel work on a signal or at the time limit while it lives, and tells
/// of the work on stderr: a bar on a terminal, otherwise a line at most
/// every 10 s, or one JSON object per line
/// {"variant", "stage", "share", "elapsed_s", "left_s"}.
class Progress : public Watch {
 public:
  explicit Progress(ProgressStyle style, double time_limit_min = 0);
  ~Progress() override;

  /// Names the variant, and where its light stage stands among all batches.
  void begin_variant(const std::string& name);
  void set_batches(std::size_t done, std::size_t of);
  void advance(Stage stage, double share) override;
  /// A line of its own, whatever the style (none: nothing).
  void say(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;
  bool stop_requested() const;
  void print(const std::string& stage, double share);
  void end_bar();

  ProgressStyle style_;
  double time_limit_s_;
  std::mutex guard_;
  std::string variant_;
  std::size_t batches_done_ = 0, batches_ = 1;
  Clock::time_point start_ = Clock::now(), stage_start_ = start_, last_ = {};
  std::string stage_;
  bool bar_is_open_ = false;
};

/// From here on SIGTERM, SIGINT and SIGUSR1 ask the work to stop; where it has not
/// within 4 s, the process ends with exit code 75 all the same: files appear under
/// their names only when complete, so nothing finished is lost.
void install_stop_signals();
/// Name of the signal that asked to stop, empty if none did.
std::string stop_signal();

}  // namespace sunload
