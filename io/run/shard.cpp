// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/shard.h"

#include <charconv>
#include <cstdlib>
#include <optional>
#include <vector>

#include "geo/base/check.h"

namespace sunload {

namespace {

std::optional<std::size_t> whole_number(const std::string& text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError({}, "--shard " + text, why, "write I/N with 0 <= I < N, auto, or auto/N");
}

/// A number from the environment that must be one if it is set.
std::optional<std::size_t> number_of(const Environment& environment, const char* name,
                                     const std::string& text) {
  const std::string value = environment(name);
  if (value.empty()) return {};
  const auto number = whole_number(value);
  if (!number) refuse(text, std::string(name) + "=" + value + " is no whole number");
  return number;
}

/// One thing that the environment says about shards.
struct Finding {
  std::string source;
  Shard shard;
};

std::optional<Finding> slurm_array(const Environment& env, const std::string& text) {
  const auto id = number_of(env, "SLURM_ARRAY_TASK_ID", text);
  const auto count = number_of(env, "SLURM_ARRAY_TASK_COUNT", text);
  if (!id || !count) return {};
  const std::size_t first = number_of(env, "SLURM_ARRAY_TASK_MIN", text).value_or(0);
  const std::size_t last =
      number_of(env, "SLURM_ARRAY_TASK_MAX", text).value_or(first + *count - 1);
  const std::size_t step = number_of(env, "SLURM_ARRAY_TASK_STEP", text).value_or(1);
  const bool is_regular = step > 0 && *count > 0 && first + (*count - 1) * step == last;
  if (!is_regular || *id < first || *id > last || (*id - first) % step != 0)
    refuse(text, "the Slurm array is no regular range, so that shards cannot be counted");
  return Finding{"Slurm array", {(*id - first) / step, *count, false}};
}

std::optional<Finding> slurm_step(const Environment& env, const std::string& text) {
  const auto id = number_of(env, "SLURM_PROCID", text);
  const auto count = number_of(env, "SLURM_STEP_NUM_TASKS", text);
  if (!id || !count || *count < 2) return {};
  return Finding{"srun step", {*id, *count, true}};
}

std::optional<Finding> open_mpi(const Environment& env, const std::string& text) {
  const auto id = number_of(env, "OMPI_COMM_WORLD_RANK", text);
  const auto count = number_of(env, "OMPI_COMM_WORLD_SIZE", text);
  if (!id || !count) return {};
  return Finding{"OpenMPI", {*id, *count, true}};
}

Shard from_environment(const std::string& text, const Environment& environment) {
  std::vector<Finding> findings;
  for (const auto& look : {slurm_array, slurm_step, open_mpi})
    if (const auto found = look(environment, text)) findings.push_back(*found);
  if (findings.empty()) refuse(text, "neither Slurm nor OpenMPI says which shard this is");
  if (findings.size() > 1)
    refuse(text, "both " + findings[0].source + " and " + findings[1].source +
                     " say which shard this is");
  return findings.front().shard;
}

Shard from_index(const std::string& text, std::size_t count, const Environment& environment) {
  std::optional<std::size_t> index;
  for (const char* name : {"PBS_ARRAY_INDEX", "PBS_ARRAYID", "SLURM_ARRAY_TASK_ID"}) {
    const auto said = number_of(environment, name, text);
    if (said && index && *said != *index)
      refuse(text, "the environment names two indices, " + std::to_string(*index) + " and " +
                       std::to_string(*said));
    if (said) index = said;
  }
  if (!index) refuse(text, "no scheduler says which index this is");
  return {*index, count, false};
}

}  // namespace

std::string process_environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

Shard parse_shard(const std::string& text, const Environment& environment) {
  const auto slash = text.find('/');
  const std::string first = text.substr(0, slash);
  if (slash == std::string::npos) {
    if (first != "auto") refuse(text, "not a shard");
    return from_environment(text, environment);
  }
  const auto count = whole_number(text.substr(slash + 1));
  if (!count || *count == 0) refuse(text, "the number of shards is no positive whole number");
  Shard shard{0, *count, false};
  if (first == "auto") {
    shard = from_index(text, *count, environment);
  } else {
    const auto index = whole_number(first);
    if (!index) refuse(text, "the index is no whole number");
    shard.index = *index;
  }
  if (shard.index >= shard.count)
    refuse(text, "index " + std::to_string(shard.index) + " of " + std::to_string(shard.count) +
                     " shards, which count from 0");
  return shard;
}

}  // namespace sunload
