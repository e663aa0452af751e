// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/push_pull.h"

#include "solver/base/threads.h"

namespace sunload {

namespace {

constexpr std::size_t trees_per_task = 256;

/// Calls mean(element, half, other half) for every inner element after its halves.
template <class Mean>
void for_each_inner(const Hierarchy& mesh, Mean&& mean) {
  const std::size_t patches = mesh.patch_count();
  parallel_for(
      mesh.tree_count(),
      [&](std::size_t tree) {
        for (auto i = mesh.first_inner(tree); i < mesh.first_inner(tree + 1); ++i)
          mean(patches + i, mesh.halves_of(i)[0], mesh.halves_of(i)[1]);
      },
      trees_per_task);
}

}  // namespace

void pull_up(const Hierarchy& mesh, Columns& radiosity) {
  if (radiosity.size() < mesh.element_count() * block_width) return;
  for_each_inner(mesh, [&](std::size_t element, std::size_t a, std::size_t b) {
    for (std::size_t k = 0; k < block_width; ++k)
      radiosity[element * block_width + k] =
          0.5f * (radiosity[a * block_width + k] + radiosity[b * block_width + k]);
  });
}

void pull_up(const Hierarchy& mesh, std::vector<double>& radiosity) {
  if (radiosity.size() < mesh.element_count()) return;
  for_each_inner(mesh, [&](std::size_t element, std::size_t a, std::size_t b) {
    radiosity[element] = 0.5 * (radiosity[a] + radiosity[b]);
  });
}

void push_down(const Hierarchy& mesh, DoubleColumns& irradiance) {
  const std::size_t patches = mesh.patch_count();
  if (irradiance.size() < mesh.element_count() * block_width) return;
  parallel_for(
      mesh.tree_count(),
      [&](std::size_t tree) {
        for (auto i = mesh.first_inner(tree + 1); i-- > mesh.first_inner(tree);)
          for (const std::size_t half : mesh.halves_of(i))
            for (std::size_t k = 0; k < block_width; ++k)
              irradiance[half * block_width + k] += irradiance[(patches + i) * block_width + k];
      },
      trees_per_task);
  irradiance.resize(patches * block_width);
}

}  // namespace sunload
