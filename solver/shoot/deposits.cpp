// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shoot/deposits.h"

#include <algorithm>
#include <tuple>

#include "geo/base/vector_code.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

// One vector instruction or two per deposit; the order of additions is the same everywhere.
SUNLOAD_VECTOR_CODE void add(const Deposit* begin, const Deposit* end, const double* power,
                             const double* area, double* irradiance) {
  for (const Deposit* d = begin; d != end; ++d) {
    const double per_area = d->weight / area[d->target];
    const double* P = power + static_cast<std::size_t>(d->source) * block_width;
    double* E = irradiance + static_cast<std::size_t>(d->target) * block_width;
    double sum[block_width];  // all is read before any of it is written
    for (std::size_t k = 0; k < block_width; ++k) sum[k] = E[k] + per_area * P[k];
    for (std::size_t k = 0; k < block_width; ++k) E[k] = sum[k];
  }
}

}  // namespace

void Deposits::put(std::size_t chunk, std::vector<Deposit> deposits) {
  std::sort(deposits.begin(), deposits.end(), [](const Deposit& a, const Deposit& b) {
    return std::tie(a.target, a.source, a.weight) < std::tie(b.target, b.source, b.weight);
  });
  std::size_t merged = 0;
  for (const Deposit& d : deposits) {
    if (merged > 0 && deposits[merged - 1].target == d.target &&
        deposits[merged - 1].source == d.source)
      deposits[merged - 1].weight += d.weight;
    else
      deposits[merged++] = d;
  }
  deposits.resize(merged);
  chunks_[chunk] = std::move(deposits);
}

void Deposits::add_to(DoubleColumns& irradiance, const DoubleColumns& power,
                      const std::vector<double>& area) const {
  const auto first_of = [](const std::vector<Deposit>& chunk, std::size_t target) {
    return std::lower_bound(chunk.begin(), chunk.end(), target,
                            [](const Deposit& d, std::size_t t) { return d.target < t; });
  };
  parallel_chunks(area.size(), receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    for (const auto& chunk : chunks_) {
      const auto from = first_of(chunk, begin), to = first_of(chunk, end);
      if (from != to)
        add(&*from, &*from + (to - from), power.data(), area.data(), irradiance.data());
    }
  });
}

}  // namespace sunload
