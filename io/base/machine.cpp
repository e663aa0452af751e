// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/machine.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <sstream>
#include <thread>

#include "geo/base/check.h"
#include "io/base/control_group.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;
constexpr double unlimited = std::numeric_limits<double>::infinity();

double system_available_bytes() {
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name;
    double kib = 0;
    if (words >> name >> kib && name == "MemAvailable:") return kib * 1024;
  }
  return unlimited;
}

/// What the limit of the address space (`ulimit -v`) leaves.
double address_space_left_bytes() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const double used = pages * static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - used);
}

/// The folder, or the nearest one above it that is there.
fs::path nearest_existing(const std::string& path) {
  fs::path at = fs::absolute(path);
  std::error_code failed;
  while (!fs::exists(at, failed) && at.has_relative_path()) at = at.parent_path();
  return at;
}

}  // namespace

void keep_memory_to_end_with() {
  constexpr std::size_t enough_bytes = std::size_t{8} << 20;  // addresses: none of it is touched
  static std::unique_ptr<std::byte[]> set_aside(new (std::nothrow) std::byte[enough_bytes]);
  static std::atomic_flag is_spent;
  std::set_new_handler([] {
    if (!is_spent.test_and_set()) set_aside.reset();
    std::set_new_handler(nullptr);
    throw std::bad_alloc();
  });
}

double available_memory_bytes() {
  return std::min(
      {system_available_bytes(), ControlGroups().memory_left_bytes(), address_space_left_bytes()});
}

double free_disk_bytes(const std::string& path) {
  std::error_code failed;
  const auto space = fs::space(nearest_existing(path), failed);
  return failed ? unlimited : static_cast<double>(space.available);
}

namespace {

/// What to tell of a place where something else is; empty of a folder, and of nothing. One look:
/// it may vanish between two.
std::string no_folder_at(const fs::path& at) {
  std::error_code unknown;
  const auto status = fs::status(at, unknown);
  return fs::exists(status) && !fs::is_directory(status) ? at.string() + " is no folder" : "";
}

/// Of making a folder: what was there already and is gone at the second look is called no folder.
bool may_have_vanished(const std::error_code& failed) {
  return failed == std::errc::no_such_file_or_directory || failed == std::errc::file_exists ||
         failed == std::errc::not_a_directory;
}

}  // namespace

std::string folder_problem(const std::string& path) {
  const fs::path at = nearest_existing(path);
  // Who may do everything is told "permission denied" of it.
  if (std::string no_folder = no_folder_at(at); !no_folder.empty()) return no_folder;
  if (access(at.c_str(), W_OK | X_OK) != 0) return std::strerror(errno);
  struct statvfs files {};
  const bool counts_files = statvfs(at.c_str(), &files) == 0 && files.f_files > 0;
  return counts_files && files.f_favail == 0
             ? "its file system has no inodes left, that is, no more files fit"
             : "";
}

std::string bytes_text(double bytes) {
  constexpr double step = 1024;
  constexpr std::array units{"bytes", "KiB", "MiB", "GiB", "TiB"};
  std::size_t unit = 0;
  while (bytes >= step && unit + 1 < units.size()) {
    bytes /= step;
    ++unit;
  }
  return fmt::format("{:.{}f} {}", bytes, unit == 0 ? 0 : 1, units[unit]);
}

int permitted_processors() {
  const double quota = ControlGroups().processors();
  return std::max(1,
                  static_cast<int>(std::min<double>(processors_by_affinity(), std::ceil(quota))));
}

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024;
}

void make_writable_folder(const std::string& path) {
  // Who cleans up, or another process that leaves no empty folders, may remove parents while they
  // are made, and the folder when it has been.
  constexpr int attempts = 100;
  constexpr std::chrono::milliseconds pause{1};
  std::error_code failed;
  int no_access = 0;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (attempt > 0) std::this_thread::sleep_for(pause);
    fs::create_directories(path, failed);
    if (may_have_vanished(failed)) continue;
    no_access = !failed && access(path.c_str(), W_OK | X_OK) != 0 ? errno : 0;
    if (no_access != ENOENT) break;
  }
  // Some systems call it success where a file is there already.
  if (const std::string no_folder = no_folder_at(nearest_existing(path)); !no_folder.empty())
    throw MachineError("cannot write into " + path + " (" + no_folder +
                       "); choose another folder with --output");
  if (failed)
    throw MachineError("cannot make the folder " + path + " (" + failed.message() +
                       "); choose another with --output");
  if (no_access != 0)
    throw MachineError("cannot write into " + path + " (" + std::strerror(no_access) +
                       "); choose another folder with --output");
}

}  // namespace sunload
