// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/jacobi.h"

#include <algorithm>
#include <utility>

#include "geo/base/check.h"
#include "geo/base/vector_code.h"
#include "solver/base/chunks.h"
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
SUNLOAD_VECTOR_CODE void gather_rows(const LinkTable::Block& block, const float* source,
                                     const float* before, Into into, float* out) {
  LinkTable::Reader read(block);
  for (std::size_t row = 0; row < block.rows(); ++row) {
    float sum[block_width];
    for (std::size_t k = 0; k < block_width; ++k)
      sum[k] = into == Into::add ? before[row * block_width + k] : 0.0f;
    for (std::size_t left = read.next_row(); left > 0; --left) {
      ask_ahead(read, source, block_width);
      const auto [target, weight] = read.next();
      const float* B = source + static_cast<std::size_t>(target) * block_width;
      for (std::size_t k = 0; k < block_width; ++k) sum[k] += weight * B[k];
    }
    for (std::size_t k = 0; k < block_width; ++k) out[row * block_width + k] = sum[k];
  }
}

void gather_rows(const LinkTable::Block& block, const double* source, const double* before,
                 Into into, double* out) {
  LinkTable::Reader read(block);
  for (std::size_t row = 0; row < block.rows(); ++row) {
    double sum = into == Into::add ? before[row] : 0;
    for (std::size_t left = read.next_row(); left > 0; --left) {
      ask_ahead(read, source, 1);
      const auto [target, weight] = read.next();
      sum += static_cast<double>(weight) * source[target];
    }
    out[row] = sum;
  }
}

/// Rows of `width` values. `before`: what is added to; may be `out`.
template <class Values>
void gather_blocks(const LinkTable& links, const Values& source, const Values& before, Into into,
                   std::size_t width, Values& out) {
  parallel_for(links.blocks.size(), [&](std::size_t b) {
    const std::size_t first = b * LinkTable::rows_per_block * width;
    gather_rows(links.blocks[b], source.data(), before.data() + first, into, out.data() + first);
  });
}

template <class Values>
void gather_blocks_onto(const LinkTable& links, const Values& source, const Values& before,
                        std::size_t width, Values& out) {
  SUNLOAD_EXPECT(
      links.blocks.size() == chunk_count(before.size() / width, LinkTable::rows_per_block),
      "links of every row");
  out.resize(before.size());
  gather_blocks(links, source, before, Into::add, width, out);
}

}  // namespace

void gather_onto(const LinkTable& links, const Columns& source, const Columns& before,
                 Columns& out) {
  gather_blocks_onto(links, source, before, block_width, out);
}

void gather(const LinkTable& links, const Columns& source, Columns& out, Into into) {
  gather_blocks(links, source, out, into, block_width, out);
}

void gather_onto(const LinkTable& links, const std::vector<double>& source,
                 const std::vector<double>& before, std::vector<double>& out) {
  gather_blocks_onto(links, source, before, 1, out);
}

void gather(const LinkTable& links, const std::vector<double>& source, std::vector<double>& out,
            Into into) {
  gather_blocks(links, source, out, into, 1, out);
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
  parallel_for(
      base.size(),
      [&](std::size_t i) {
        light.gathered_radiosity[i] =
            static_cast<double>(optics.diffuse[i]) * (base[i] + light.irradiance[i]);
      },
      receivers_per_chunk);
  pull_up(mesh, light.gathered_radiosity);
}

/// Where links stand for all reflections, what was gathered is all radiosity, and nothing is left.
template <class Light, class Irradiance>
void count_all_as_gathered(const Hierarchy& mesh, const PatchOptics& optics, const Irradiance& base,
                           Light& light) {
  set_radiosity(mesh, optics, base, light);
  light.before = light.irradiance;
}

template <class Irradiance>
ReflectedLight<Irradiance> reflected(const Hierarchy& mesh, const LineSet& lines,
                                     const PatchOptics& optics, const Irradiance& base,
                                     const Irradiance& ground, Irradiance no_radiosity,
                                     int bounces) {
  ReflectedLight<Irradiance> out{ground, std::move(no_radiosity), {}, {}};
  for (int b = 1; b <= passes(lines, bounces); ++b) {
    set_radiosity(mesh, optics, base, out);
    out.two_before.swap(out.before);
    out.before.swap(out.irradiance);
    gather_onto(lines.patches, out.gathered_radiosity, ground, out.irradiance);
    if (lines.all_reflections) count_all_as_gathered(mesh, optics, base, out);
  }
  return out;
}

}  // namespace

Reflected reflect(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                  const Columns& base, const Columns& ground, int bounces) {
  return reflected(mesh, lines, optics, base, ground, columns(mesh.element_count()), bounces);
}

ReflectedExposure reflect(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                          const std::vector<double>& base, const std::vector<double>& ground,
                          int bounces) {
  return reflected(mesh, lines, optics, base, ground, std::vector<double>(mesh.element_count(), 0),
                   bounces);
}

}  // namespace sunload
