// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/control_group.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

namespace sunload {

namespace {

namespace fs = std::filesystem;

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// The first number of a file; infinite for `max`, and where there is none.
double first_number(const fs::path& path) {
  std::ifstream file(path);
  double number = 0;
  if (!(file >> number)) return no_limit;
  return number;
}

/// The group's folder in a hierarchy, and those above it. In containers the hierarchy may begin
/// with the group itself, and its path may not be there.
std::vector<fs::path> with_parents(const fs::path& hierarchy, const std::string& group) {
  std::vector<fs::path> folders;
  std::error_code unreadable;
  for (fs::path at = fs::path(group).relative_path(); !at.empty(); at = at.parent_path())
    if (fs::exists(hierarchy / at, unreadable)) folders.push_back(hierarchy / at);
  if (fs::exists(hierarchy, unreadable)) folders.push_back(hierarchy);
  return folders;
}

/// Whether a list like `cpu,cpuacct` names the controller.
bool names(const std::string& controllers, const std::string& controller) {
  std::istringstream list(controllers);
  for (std::string name; std::getline(list, name, ',');)
    if (name == controller) return true;
  return false;
}

/// Bytes that files keep in memory, by the group's memory.stat.
double files_in_memory(const fs::path& group, const std::string& prefix) {
  std::ifstream file(group / "memory.stat");
  double bytes = 0, value = 0;
  for (std::string name; file >> name >> value;)
    if (name == prefix + "inactive_file" || name == prefix + "active_file") bytes += value;
  return bytes;
}

double memory_left(const fs::path& group, const char* limit_file, const char* usage_file,
                   const std::string& prefix) {
  const double limit = first_number(group / limit_file), usage = first_number(group / usage_file);
  if (limit == no_limit || usage == no_limit) return no_limit;
  return std::max(0.0, limit - std::max(0.0, usage - files_in_memory(group, prefix)));
}

double quota_v2(const fs::path& group) {
  std::ifstream file(group / "cpu.max");
  double quota = 0, period = 0;
  return file >> quota >> period && period > 0 ? quota / period : no_limit;
}

double quota_v1(const fs::path& group) {
  const double quota = first_number(group / "cpu.cfs_quota_us"),
               period = first_number(group / "cpu.cfs_period_us");
  const bool has_one = quota > 0 && quota != no_limit && period > 0 && period != no_limit;
  return has_one ? quota / period : no_limit;
}

template <class Left>
double least(const std::vector<fs::path>& groups, const Left& left) {
  double least = no_limit;
  for (const auto& group : groups) least = std::min(least, left(group));
  return least;
}

}  // namespace

ControlGroups::ControlGroups(const fs::path& of_process, const fs::path& mounts) {
  std::ifstream file(of_process);
  for (std::string line; std::getline(file, line);) {
    // number:controllers:path
    const auto first = line.find(':');
    const auto second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string group = line.substr(second + 1);
    if (controllers.empty()) memory_v2_ = cpu_v2_ = with_parents(mounts, group);
    if (names(controllers, "memory")) memory_v1_ = with_parents(mounts / "memory", group);
    if (names(controllers, "cpu")) cpu_v1_ = with_parents(mounts / "cpu", group);
  }
}

double ControlGroups::memory_left_bytes() const {
  return std::min(least(memory_v2_,
                        [](const fs::path& group) {
                          return memory_left(group, "memory.max", "memory.current", "");
                        }),
                  least(memory_v1_, [](const fs::path& group) {
                    return memory_left(group, "memory.limit_in_bytes", "memory.usage_in_bytes",
                                       "total_");
                  }));
}

double ControlGroups::processors() const {
  return std::min(least(cpu_v2_, quota_v2), least(cpu_v1_, quota_v1));
}

}  // namespace sunload
