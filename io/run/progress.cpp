// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "geo/base/units.h"
#include "io/base/machine.h"
#include "io/base/names.h"
#include "io/base/standard_streams.h"
#include "io/base/stop_signals.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// Least time between two lines, objects, drawings of the bar.
constexpr std::chrono::seconds line_pause{10}, json_pause{1};
constexpr std::chrono::milliseconds bar_pause{200};
constexpr double million = 1e6;

const char* stage_name(Stage stage) {
  switch (stage) {
    case Stage::prepare:
      return "prepare";
    case Stage::refine:
      return "refine mesh";
    case Stage::lines:
      return "trace lines";
    case Stage::nodes:
      return "skies and suns";
    case Stage::light:
      return "sun positions";
  }
  return "";
}

ProgressStyle resolved(ProgressStyle style) {
  if (style != ProgressStyle::automatic) return style;
  return isatty(STDERR_FILENO) != 0 ? ProgressStyle::bar : ProgressStyle::lines;
}

std::string clock_text(double seconds) {
  const long s = std::lround(seconds);
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

/// Columns of the terminal, or what one has at least.
std::size_t terminal_columns() {
  constexpr std::size_t usual = 80;
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

using Json = nlohmann::ordered_json;

std::string message_json(const std::string& text) {
  return Json{{"message", text}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

/// What one line, object or drawing tells.
struct Progress::State {
  std::string variant, stage;
  double share = 0;  ///< of the stage
  std::size_t suns_done = 0, suns = 0;
  double rays_per_s = 0, elapsed_s = 0, memory_bytes = 0;
  std::optional<double> left_s;  ///< once something has been done

  std::string words() const {
    // `check` refines meshes and lights nothing; pilots do not count their rays.
    const std::string done = suns > 0 ? fmt::format("{}/{} suns, ", suns_done, suns) : "";
    // Nor are there many where geometry tells of the sun.
    constexpr double worth_telling = 0.05 * million;
    const std::string speed =
        rays_per_s >= worth_telling ? fmt::format("{:.1f} Mrays/s, ", rays_per_s / million) : "";
    const std::string left = left_s ? clock_text(*left_s) + " left, " : "";
    return fmt::format("{}{}{}{:.0f} MiB", done, speed, left, memory_bytes / mib);
  }
  std::string line() const {
    return fmt::format("{}: {} {:.1f} %, {}, {} elapsed", variant, stage, 100 * share, words(),
                       clock_text(elapsed_s));
  }
  std::string json() const {
    return Json({{"variant", variant},
                 {"stage", stage},
                 {"share", share},
                 {"suns_done", suns_done},
                 {"suns", suns},
                 {"rays_per_s", rays_per_s},
                 {"elapsed_s", elapsed_s},
                 {"left_s", left_s ? Json(*left_s) : Json()},
                 {"memory_bytes", memory_bytes}})
        .dump();
  }
  /// As wide as the terminal allows: what is longer would begin a new line with every drawing.
  std::string bar(std::size_t columns) const {
    constexpr std::size_t narrowest = 8, widest = 30;
    const std::string name = variant + " " + stage;
    const std::string numbers = fmt::format(" {:3.0f} %  {}", 100 * share, words());
    const std::size_t taken = name.size() + numbers.size() + std::string(" []").size() + 1;
    const std::size_t width = std::min(widest, columns - std::min(columns, taken));
    const auto filled = static_cast<std::size_t>(share * static_cast<double>(width));
    std::string text = name;
    if (width >= narrowest)
      text += " [" + std::string(filled, '=') + std::string(width - filled, ' ') + "]";
    text += numbers;
    if (text.size() >= columns) text.resize(columns - 1);
    return text;
  }
};

Progress::Progress(ProgressStyle style, double time_limit_min)
    : style_(resolved(style)), time_limit_s_(time_limit_min * seconds_per_minute) {
  set_cancellation([this] { return stop_requested(); });
}

Progress::~Progress() {
  set_cancellation({});
  end_bar();
}

void Progress::begin_variant(const std::string& name, std::size_t suns) {
  const std::lock_guard lock(guard_);
  end_bar();
  variant_ = name;
  stage_.clear();
  suns_ = suns;
  finished_ = in_batch_ = 0;
}

void Progress::cast(double rays) {
  const std::lock_guard lock(guard_);
  rays_ += rays;
}

void Progress::begin_stage(Stage stage) {
  if (stage_ == stage_name(stage)) return;
  stage_ = stage_name(stage);
  stage_start_ = Clock::now();
  computed_ = 0;
  in_batch_ = 0;
  rays_ = 0;
  if (style_ == ProgressStyle::bar || style_ == ProgressStyle::json) last_ = {};
}

void Progress::begin_batch(std::size_t finished, std::size_t suns) {
  const std::lock_guard lock(guard_);
  begin_stage(Stage::light);
  computed_ += static_cast<double>(in_batch_);
  finished_ = finished;
  in_batch_ = suns;
}

Progress::State Progress::state(Stage stage, double share) const {
  State now;
  now.variant = variant_;
  now.stage = stage_;
  now.share = share;
  now.suns_done = finished_;
  now.suns = suns_;
  now.elapsed_s = std::chrono::duration<double>(Clock::now() - stage_start_).count();
  now.memory_bytes = peak_memory_bytes();
  if (now.elapsed_s > 0) now.rays_per_s = rays_ / now.elapsed_s;
  if (stage == Stage::light && suns_ > 0) {
    const double of_batch = share * static_cast<double>(in_batch_);
    const double done = static_cast<double>(finished_) + of_batch;
    const double computed = computed_ + of_batch;
    now.suns_done = static_cast<std::size_t>(done);
    now.share = std::min(1.0, done / static_cast<double>(suns_));
    // What was finished before this process came says nothing of its speed.
    if (computed > 0)
      now.left_s = std::max(0.0, now.elapsed_s * (static_cast<double>(suns_) - done) / computed);
  } else if (share > 0) {
    now.left_s = now.elapsed_s * (1 - share) / share;
  }
  if (now.share >= 1) now.left_s = 0;
  return now;
}

void Progress::advance(Stage stage, double share) {
  const std::lock_guard lock(guard_);
  if (style_ == ProgressStyle::none) return;
  begin_stage(stage);
  const auto now = Clock::now();
  const auto pause = style_ == ProgressStyle::bar    ? Clock::duration(bar_pause)
                     : style_ == ProgressStyle::json ? Clock::duration(json_pause)
                                                     : Clock::duration(line_pause);
  const State told = state(stage, share);
  const bool is_end = told.share >= 1 && style_ != ProgressStyle::lines;
  if (now - last_ < pause && !is_end) return;
  last_ = now;
  print(told);
}

void Progress::print(const State& state) {
  switch (style_) {
    case ProgressStyle::bar:
      // Back to the line's beginning; what the last drawing has more is erased.
      tell_as_it_is("\r" + without_controls(state.bar(terminal_columns())) + "\033[K");
      bar_is_open_ = true;
      if (state.share >= 1) end_bar();
      break;
    case ProgressStyle::lines:
      tell(state.line());
      break;
    case ProgressStyle::json:
      tell(state.json());
      break;
    default:
      break;
  }
}

void Progress::end_bar() {
  if (bar_is_open_) tell("");
  bar_is_open_ = false;
}

void Progress::say(const std::string& text) {
  if (style_ != ProgressStyle::none) warn(text);
}

void Progress::warn(const std::string& text) {
  const std::lock_guard lock(guard_);
  end_bar();
  tell(style_ == ProgressStyle::json ? message_json(text) : text);
}

bool Progress::stop_requested() const {
  if (stop_signal_came()) return true;
  return time_limit_s_ > 0 &&
         std::chrono::duration<double>(Clock::now() - start_).count() > time_limit_s_;
}

}  // namespace sunload
