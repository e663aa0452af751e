// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Limits of control groups, as the files of both versions tell them.
#include "io/base/control_group.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

struct Files {
  WorkFolder folder;
  ControlGroups groups() const { return ControlGroups(folder / "cgroup", folder / "mounts"); }
};

TEST(ControlGroups, WithoutAnyNothingIsLimited) {
  const Files files;
  EXPECT_TRUE(std::isinf(files.groups().memory_left_bytes()));
  EXPECT_TRUE(std::isinf(files.groups().processors()));
}

TEST(ControlGroups, Version2TakesTheTightestOfAllAround) {
  const Files files;
  files.folder.write("cgroup", "0::/job/step\n");
  files.folder.write("mounts/job/step/memory.max", "max\n");
  files.folder.write("mounts/job/step/memory.current", "900\n");
  files.folder.write("mounts/job/memory.max", "5000\n");
  files.folder.write("mounts/job/memory.current", "3000\n");
  // Files that were written lately fill a group: they are no reason to refuse work.
  files.folder.write("mounts/job/memory.stat",
                     "anon 500\nfile 2600\ninactive_file 2000\nactive_file 500\n");
  files.folder.write("mounts/job/step/cpu.max", "max 100000\n");
  files.folder.write("mounts/job/cpu.max", "250000 100000\n");
  EXPECT_EQ(files.groups().memory_left_bytes(), 5000 - (3000 - 2500));
  EXPECT_EQ(files.groups().processors(), 2.5);
}

TEST(ControlGroups, Version1HasAHierarchyForEach) {
  const Files files;
  files.folder.write("cgroup", "4:memory:/slurm/job_7\n3:cpuset:/\n2:cpu,cpuacct:/slurm\n0::/\n");
  files.folder.write("mounts/memory/slurm/job_7/memory.limit_in_bytes", "8000\n");
  files.folder.write("mounts/memory/slurm/job_7/memory.usage_in_bytes", "1000\n");
  files.folder.write("mounts/memory/slurm/job_7/memory.stat",
                     "cache 1\ntotal_inactive_file 100\ntotal_active_file 200\n");
  files.folder.write("mounts/memory/memory.limit_in_bytes", "9223372036854771712\n");
  files.folder.write("mounts/memory/memory.usage_in_bytes", "1000\n");
  files.folder.write("mounts/cpu/slurm/cpu.cfs_quota_us", "150000\n");
  files.folder.write("mounts/cpu/slurm/cpu.cfs_period_us", "100000\n");
  files.folder.write("mounts/cpu/cpu.cfs_quota_us", "-1\n");
  files.folder.write("mounts/cpu/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(files.groups().memory_left_bytes(), 8000 - 700);
  EXPECT_EQ(files.groups().processors(), 1.5);
}

// As in containers, whose hierarchy begins with their own group.
TEST(ControlGroups, APathThatIsNotThereIsTheHierarchysTop) {
  const Files files;
  files.folder.write("cgroup", "0::/somewhere/else\n");
  files.folder.write("mounts/memory.max", "100\n");
  files.folder.write("mounts/memory.current", "60\n");
  EXPECT_EQ(files.groups().memory_left_bytes(), 40);
}

}  // namespace
}  // namespace sunload::test
