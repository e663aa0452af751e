// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which units are a process' own, by every scheduler's words for it.
#include "io/run/shard.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "geo/base/check.h"
#include "tests/support/refusal_of.h"

namespace sunload {
namespace {

using Variables = std::map<std::string, std::string>;

Shard shard(const std::string& text, const Variables& variables = {}) {
  return parse_shard(text, [&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? std::string() : found->second;
  });
}

/// The message with which a shard is refused, empty if it is not.
std::string refusal(const std::string& text, const Variables& variables = {}) {
  return test::refusal_of([&] { shard(text, variables); });
}

void expect_shard(const Shard& is, std::size_t index, std::size_t count) {
  EXPECT_EQ(is.index, index);
  EXPECT_EQ(is.count, count);
}

/// The environment of one task of `sbatch --array=first-last:step`.
Variables array_task(int id, int first, int last, int step = 1) {
  return {{"SLURM_ARRAY_TASK_ID", std::to_string(id)},
          {"SLURM_ARRAY_TASK_MIN", std::to_string(first)},
          {"SLURM_ARRAY_TASK_MAX", std::to_string(last)},
          {"SLURM_ARRAY_TASK_STEP", std::to_string(step)},
          {"SLURM_ARRAY_TASK_COUNT", std::to_string((last - first) / step + 1)},
          // What every batch script sees too, and what says nothing about shards.
          {"SLURM_JOB_ID", "71"},
          {"SLURM_ARRAY_JOB_ID", "70"},
          {"SLURM_PROCID", "0"},
          {"SLURM_NTASKS", "1"}};
}

Variables with(Variables variables, const Variables& more) {
  variables.insert(more.begin(), more.end());
  return variables;
}

const Variables srun_task{{"SLURM_PROCID", "2"}, {"SLURM_STEP_NUM_TASKS", "4"}};
const Variables mpi_rank{{"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "3"}};

TEST(Shard, WrittenOut) {
  expect_shard(shard("0/1"), 0, 1);
  expect_shard(shard("2/3"), 2, 3);
  expect_shard(shard("63/64"), 63, 64);
  // What is written out needs no scheduler, and none can change it.
  expect_shard(shard("2/3", with(array_task(0, 0, 7), srun_task)), 2, 3);
}

TEST(Shard, EveryUnitBelongsToExactlyOne) {
  for (std::size_t count = 1; count <= 9; ++count)
    for (std::size_t unit = 0; unit < 40; ++unit) {
      int owners = 0;
      for (std::size_t index = 0; index < count; ++index)
        owners += Shard{index, count, false}.owns(unit) ? 1 : 0;
      EXPECT_EQ(owners, 1) << unit << " of " << count;
    }
}

TEST(Shard, NoShards) {
  for (const char* text : {"",          "3/3",
                           "4/3",       "-1/3",
                           "0/0",       "1",
                           "1/",        "/3",
                           "1/3/5",     "a/3",
                           "1/b",       "1.0/3",
                           "0x1/3",     " 1/3",
                           "1/ 3",      "+1/3",
                           "automatic", "auto/",
                           "auto/0",    "auto/x",
                           "AUTO",      "99999999999999999999/3"})
    EXPECT_NE(refusal(text, array_task(0, 0, 3)), "") << "'" << text << "'";
}

TEST(Shard, TaskOfASlurmArray) {
  for (int task = 0; task < 4; ++task)
    expect_shard(shard("auto", array_task(task, 0, 3)), static_cast<std::size_t>(task), 4);
  expect_shard(shard("auto", array_task(1, 1, 8)), 0, 8);
  expect_shard(shard("auto", array_task(8, 1, 8)), 7, 8);
  expect_shard(shard("auto", array_task(0, 0, 0)), 0, 1);
}

TEST(Shard, TaskOfASlurmArrayWithSteps) {
  for (int place = 0; place < 4; ++place)
    expect_shard(shard("auto", array_task(3 + 5 * place, 3, 18, 5)),
                 static_cast<std::size_t>(place), 4);
  // --array=0-10:3 ends at 9, and Slurm says so.
  expect_shard(shard("auto", array_task(6, 0, 9, 3)), 2, 4);
}

TEST(Shard, AnArrayWithGapsCannotBeCounted) {
  // --array=0,1,7: three tasks, but which one is task 7?
  Variables gaps = array_task(7, 0, 7);
  gaps["SLURM_ARRAY_TASK_COUNT"] = "3";
  EXPECT_NE(refusal("auto", gaps).find("no regular range"), std::string::npos);
  Variables between = array_task(3, 0, 6, 2);
  EXPECT_NE(refusal("auto", between), "");
  EXPECT_NE(refusal("auto", array_task(9, 0, 7)), "");
  Variables no_step = array_task(2, 0, 3);
  no_step["SLURM_ARRAY_TASK_STEP"] = "0";
  EXPECT_NE(refusal("auto", no_step), "");
  // The remedy: the number of shards is written out.
  expect_shard(shard("auto/8", gaps), 7, 8);
}

TEST(Shard, TaskOfASlurmStep) {
  expect_shard(shard("auto", srun_task), 2, 4);
  // A batch script outside of any step, and a step of one task, say nothing.
  EXPECT_NE(refusal("auto", {{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "4"}}), "");
  EXPECT_NE(refusal("auto", {{"SLURM_PROCID", "0"}, {"SLURM_STEP_NUM_TASKS", "1"}}), "");
  // A step of one task within an array is the array's.
  expect_shard(shard("auto", with(array_task(2, 0, 3), {{"SLURM_STEP_NUM_TASKS", "1"}})), 2, 4);
}

TEST(Shard, RankOfOpenMpi) {
  expect_shard(shard("auto", mpi_rank), 1, 3);
  EXPECT_NE(refusal("auto", {{"OMPI_COMM_WORLD_RANK", "1"}}), "");
}

TEST(Shard, IndexAloneNeedsTheCount) {
  expect_shard(shard("auto/5", {{"PBS_ARRAY_INDEX", "3"}}), 3, 5);
  expect_shard(shard("auto/5", {{"PBS_ARRAYID", "0"}}), 0, 5);
  expect_shard(shard("auto/5", {{"SLURM_ARRAY_TASK_ID", "4"}}), 4, 5);
  EXPECT_NE(refusal("auto", {{"PBS_ARRAY_INDEX", "3"}}).find("auto/N"), std::string::npos);
  EXPECT_NE(refusal("auto/5", {{"PBS_ARRAY_INDEX", "5"}}), "");
  EXPECT_NE(refusal("auto/5", {}), "");
}

TEST(Shard, AmbiguousIsRefused) {
  for (const auto& [here, there, first, second] :
       {std::tuple{array_task(1, 0, 3), mpi_rank, "Slurm array", "OpenMPI"},
        {srun_task, mpi_rank, "srun step", "OpenMPI"}}) {
    const std::string why = refusal("auto", with(here, there));
    EXPECT_NE(why.find(first), std::string::npos) << why;
    EXPECT_NE(why.find(second), std::string::npos) << why;
  }
  Variables both = array_task(1, 0, 3);
  both["SLURM_PROCID"] = "2";
  both["SLURM_STEP_NUM_TASKS"] = "4";
  EXPECT_NE(refusal("auto", both), "");
  // Two schedulers' indices that differ.
  EXPECT_NE(refusal("auto/5", {{"PBS_ARRAY_INDEX", "3"}, {"SLURM_ARRAY_TASK_ID", "4"}}), "");
  EXPECT_NE(refusal("auto/5", {{"PBS_ARRAY_INDEX", "3"}, {"PBS_ARRAYID", "4"}}), "");
  expect_shard(shard("auto/5", {{"PBS_ARRAY_INDEX", "3"}, {"PBS_ARRAYID", "3"}}), 3, 5);
}

TEST(Shard, WhatIsNoNumberIsRefused) {
  Variables words = array_task(1, 0, 3);
  words["SLURM_ARRAY_TASK_COUNT"] = "four";
  EXPECT_NE(refusal("auto", words).find("SLURM_ARRAY_TASK_COUNT=four"), std::string::npos);
  EXPECT_NE(refusal("auto/5", {{"PBS_ARRAY_INDEX", "-1"}}), "");
  EXPECT_NE(refusal("auto/5", {{"PBS_ARRAY_INDEX", "3[]"}}), "");
}

TEST(Shard, ReadsTheProcessEnvironmentByItself) {
  setenv("SUNLOAD_SHARD_TEST", "here", 1);
  EXPECT_EQ(process_environment("SUNLOAD_SHARD_TEST"), "here");
  unsetenv("SUNLOAD_SHARD_TEST");
  EXPECT_EQ(process_environment("SUNLOAD_SHARD_TEST"), "");
}

}  // namespace
}  // namespace sunload
