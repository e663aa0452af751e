// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/room.h"

#include <fmt/format.h>

#include "io/base/machine.h"
#include "io/plan/memory_estimate.h"

namespace sunload {

std::string memory_problem(const WorkEstimate& work, PatchesAre patches) {
  const double left = available_memory_bytes();
  if (work.memory_bytes <= left) return {};
  const bool is_least = patches == PatchesAre::at_least;
  return fmt::format(
      "too little memory: {} {} are needed for {} patches{}, {} are available; "
      "use a larger mesh.max_edge_m, fewer lines_per_patch or a smaller batch_suns{}",
      is_least ? "more than" : "about", bytes_text(work.memory_bytes), work.patches,
      is_least ? " or more" : "", bytes_text(left),
      work.samples > 0 ? ", and a larger power_per_sample_w or auto" : "");
}

std::string accuracy_pilot_problem(const VariantPlan& plan, std::size_t patches) {
  if (!plan.study.solver.accuracy) return {};
  const double needed = accuracy_pilot_memory_bytes(plan, patches), left = available_memory_bytes();
  if (needed <= left) return {};
  return fmt::format(
      "too little memory for the pilot of the accuracy asked for: about {} are needed for {} "
      "patches, {} are available; use a larger mesh.max_edge_m, or lines_per_patch without "
      "accuracy",
      bytes_text(needed), patches, bytes_text(left));
}

std::string disk_problem(const WorkEstimate& work, const std::string& folder,
                         double finished_bytes) {
  if (const auto problem = folder_problem(folder); !problem.empty())
    return "cannot write into " + folder + ": " + problem + "; choose another folder with --output";
  const double left = free_disk_bytes(folder), needed = work.disk_bytes - finished_bytes;
  if (needed <= left) return {};
  return fmt::format(
      "too little disk space for {}: about {} are needed, {} are free; "
      "choose another folder with --output, or fewer output.series",
      folder, bytes_text(needed), bytes_text(left));
}

}  // namespace sunload
