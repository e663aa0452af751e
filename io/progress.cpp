#include "io/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "geo/units.h"
#include "io/exit_code.h"
#include "solver/parallel.h"

namespace sunload {

namespace {

volatile std::sig_atomic_t caught_signal = 0;

/// After this time without a clean end the process ends where it stands.
constexpr unsigned grace_s = 4;

void remember(int signal) {
  if (caught_signal == 0) alarm(grace_s);
  caught_signal = signal;
}

void end_at_once(int) {
  constexpr char text[] = "stopped at once; finished batches are kept, go on with --resume\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof(text) - 1);
  _exit(exit_code::unfinished);
}

/// Without a terminal one line at most this often.
constexpr std::chrono::seconds line_pause{10};
constexpr std::chrono::milliseconds bar_pause{200};
/// Shorter stages are not worth a line of their own.
constexpr double short_stage_s = 1;

const char* stage_name(Stage stage) {
  switch (stage) {
    case Stage::prepare: return "prepare";
    case Stage::refine: return "refine mesh";
    case Stage::lines: return "trace lines";
    case Stage::light: return "sun positions";
  }
  return "";
}

ProgressStyle resolved(ProgressStyle style) {
  if (style != ProgressStyle::automatic) return style;
  return isatty(STDERR_FILENO) != 0 ? ProgressStyle::bar : ProgressStyle::lines;
}

std::string clock_text(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

Progress::Progress(ProgressStyle style, double time_limit_min)
    : style_(resolved(style)), time_limit_s_(time_limit_min * seconds_per_minute) {
  set_cancellation([this] { return stop_requested(); });
}

Progress::~Progress() {
  set_cancellation({});
  end_bar();
}

void Progress::begin_variant(const std::string& name) {
  const std::lock_guard lock(guard_);
  end_bar();
  variant_ = name;
  stage_.clear();
}

void Progress::set_batches(std::size_t done, std::size_t of) {
  const std::lock_guard lock(guard_);
  batches_done_ = done;
  batches_ = of;
}

void Progress::advance(Stage stage, double share) {
  const std::lock_guard lock(guard_);
  const std::string name = stage_name(stage);
  if (name != stage_) {
    stage_ = name;
    stage_start_ = last_ = Clock::now();
    if (style_ == ProgressStyle::bar) last_ = {};
  }
  const double of_all =
      stage == Stage::light
          ? (static_cast<double>(batches_done_) + share) / static_cast<double>(batches_)
          : share;
  const auto now = Clock::now();
  const auto pause = style_ == ProgressStyle::bar ? Clock::duration(bar_pause)
                                                  : Clock::duration(line_pause);
  const bool at_end = of_all >= 1 && std::chrono::duration<double>(now - stage_start_).count() > short_stage_s;
  if (now - last_ < pause && !at_end) return;
  last_ = now;
  print(name, of_all);
}

void Progress::print(const std::string& stage, double share) {
  const double elapsed = std::chrono::duration<double>(Clock::now() - stage_start_).count();
  const double left = share > 0 ? elapsed * (1 - share) / share : 0;
  switch (style_) {
    case ProgressStyle::bar: {
      const auto filled = static_cast<std::size_t>(share * 30);
      fmt::print(stderr, "\r{:<12} {:<14} [{:<30}] {:5.1f} %  left {} ", variant_, stage,
                 std::string(filled, '='), 100 * share, clock_text(left));
      bar_is_open_ = true;
      if (share >= 1) end_bar();
      break;
    }
    case ProgressStyle::lines:
      fmt::print(stderr, "{}: {} {:.1f} %, {} elapsed, {} left\n", variant_, stage, 100 * share,
                 clock_text(elapsed), clock_text(left));
      break;
    case ProgressStyle::json:
      fmt::print(stderr,
                 "{{\"variant\": \"{}\", \"stage\": \"{}\", \"share\": {:.6f}, \"elapsed_s\": "
                 "{:.3f}, \"left_s\": {:.3f}}}\n",
                 variant_, stage, share, elapsed, left);
      break;
    default:
      break;
  }
  std::fflush(stderr);
}

void Progress::end_bar() {
  if (bar_is_open_) fmt::print(stderr, "\n");
  bar_is_open_ = false;
}

void Progress::say(const std::string& text) {
  const std::lock_guard lock(guard_);
  if (style_ == ProgressStyle::none) return;
  end_bar();
  if (style_ == ProgressStyle::json) return;
  fmt::print(stderr, "{}\n", text);
  std::fflush(stderr);
}

bool Progress::stop_requested() const {
  if (caught_signal != 0) return true;
  return time_limit_s_ > 0 &&
         std::chrono::duration<double>(Clock::now() - start_).count() > time_limit_s_;
}

void install_stop_signals() {
  struct sigaction action {};
  action.sa_handler = remember;
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) sigaction(signal, &action, nullptr);
  action.sa_handler = end_at_once;
  sigaction(SIGALRM, &action, nullptr);
}

std::string stop_signal() {
  switch (static_cast<int>(caught_signal)) {
    case SIGTERM: return "SIGTERM";
    case SIGINT: return "SIGINT";
    case SIGUSR1: return "SIGUSR1";
    default: return {};
  }
}

}  // namespace sunload
