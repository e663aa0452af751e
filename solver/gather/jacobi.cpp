// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/jacobi.h"

#include <algorithm>

#include "geo/base/vector_code.h"
#include "solver/base/threads.h"
#include "solver/mesh/push_pull.h"

namespace sunload {

namespace {

/// Rows of sources are anywhere in memory, and the sums wait for nothing else: they are asked for
/// so many links before they are needed (6 … 48 are alike).
constexpr std::size_t links_ahead = 16;

template <class Value>
inline void ask_ahead(const LinkTable::Reader& read, const Value* source, std::size_t width) {
  __builtin_prefetch(source + read.target_ahead(links_ahead) * width);
}

// Compilers turn the inner loops into one vector instruction per link where the
// processor has 512 bits; the order of additions is the same everywhere.
SUNLOAD_VECTOR_CODE void gather_rows(const LinkTable::Block& block, const float* source, float* out,
                                     Into into) {
  LinkTable::Reader read(block);
  for (std::size_t row = 0; row < block.rows(); ++row) {
    float sum[block_width];
    for (std::size_t k = 0; k < block_width; ++k)
      sum[k] = into == Into::add ? out[row * block_width + k] : 0.0f;
    for (std::size_t left = read.next_row(); left > 0; --left) {
      ask_ahead(read, source, block_width);
      const auto [target, weight] = read.next();
      const float* B = source + static_cast<std::size_t>(target) * block_width;
      for (std::size_t k = 0; k < block_width; ++k) sum[k] += weight * B[k];
    }
    for (std::size_t k = 0; k < block_width; ++k) out[row * block_width + k] = sum[k];
  }
}

}  // namespace

void gather(const LinkTable& links, const Columns& source, Columns& out, Into into) {
  parallel_for(links.blocks.size(), [&](std::size_t b) {
    gather_rows(links.blocks[b], source.data(),
                out.data() + b * LinkTable::rows_per_block * block_width, into);
  });
}

void gather(const LinkTable& links, const std::vector<double>& source, std::vector<double>& out,
            Into into) {
  parallel_for(links.blocks.size(), [&](std::size_t b) {
    LinkTable::Reader read(links.blocks[b]);
    for (std::size_t row = 0; row < links.blocks[b].rows(); ++row) {
      double& sum = out[b * LinkTable::rows_per_block + row];
      if (into == Into::replace) sum = 0;
      for (std::size_t left = read.next_row(); left > 0; --left) {
        ask_ahead(read, source.data(), 1);
        const auto [target, weight] = read.next();
        sum += static_cast<double>(weight) * source[target];
      }
    }
  });
}

namespace {

/// Passes over the links that so many bounces take.
int passes(const LineSet& lines, int bounces) {
  return lines.all_reflections ? std::min(bounces, 1) : bounces;
}

/// ρ (base + irradiance), of all elements.
void set_radiosity(const Hierarchy& mesh, const PatchOptics& optics, const Columns& base,
                   Reflected& light) {
  parallel_for(
      optics.diffuse.size(),
      [&](std::size_t i) {
        for (std::size_t k = i * block_width; k < (i + 1) * block_width; ++k)
          light.gathered_radiosity[k] = optics.diffuse[i] * (base[k] + light.irradiance[k]);
      },
      LinkTable::rows_per_block);
  pull_up(mesh, light.gathered_radiosity);
}
void set_radiosity(const Hierarchy& mesh, const PatchOptics& optics,
                   const std::vector<double>& base, ReflectedExposure& light) {
  for (std::size_t i = 0; i < base.size(); ++i)
    light.gathered_radiosity[i] =
        static_cast<double>(optics.diffuse[i]) * (base[i] + light.irradiance[i]);
  pull_up(mesh, light.gathered_radiosity);
}

/// Where links stand for all reflections, what was gathered is all radiosity, and nothing is left.
template <class Light, class Irradiance>
void count_all_as_gathered(const Hierarchy& mesh, const PatchOptics& optics, const Irradiance& base,
                           Light& light) {
  set_radiosity(mesh, optics, base, light);
  light.before = light.irradiance;
}

}  // namespace

Reflected reflect(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                  const Columns& base, const Columns& ground, int bounces) {
  Reflected out{ground, columns(mesh.element_count()), {}, {}};
  for (int b = 1; b <= passes(lines, bounces); ++b) {
    set_radiosity(mesh, optics, base, out);
    out.two_before.swap(out.before);
    out.before.swap(out.irradiance);
    out.irradiance = ground;
    gather(lines.patches, out.gathered_radiosity, out.irradiance, Into::add);
    if (lines.all_reflections) count_all_as_gathered(mesh, optics, base, out);
  }
  return out;
}

ReflectedExposure reflect(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                          const std::vector<double>& base, const std::vector<double>& ground,
                          int bounces) {
  ReflectedExposure out{ground, std::vector<double>(mesh.element_count(), 0), {}, {}};
  for (int b = 1; b <= passes(lines, bounces); ++b) {
    set_radiosity(mesh, optics, base, out);
    out.two_before.swap(out.before);
    out.before.swap(out.irradiance);
    out.irradiance = ground;
    gather(lines.patches, out.gathered_radiosity, out.irradiance, Into::add);
    if (lines.all_reflections) count_all_as_gathered(mesh, optics, base, out);
  }
  return out;
}

}  // namespace sunload
