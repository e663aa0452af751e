// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Means over facades, of series in batches and of totals in results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "solver/base/threads.h"

namespace sunload {

/// What the area of a facade divides: every patch's term, or their sum. The two differ by a
/// rounding; each array keeps the one that it has always had, so that results keep their bits.
enum class Divided { terms, sums };

/// Area-weighted means over the patches of every facade.
class FacadeMeans {
 public:
  /// Per patch its facade (-1: none) and its area; `count`: of facades.
  FacadeMeans(std::vector<std::int32_t> facade, std::vector<double> patch_area, std::size_t count)
      : facade_(std::move(facade)), patch_area_(std::move(patch_area)), area_(count, 0) {
    for (std::size_t i = 0; i < facade_.size(); ++i)
      if (facade_[i] >= 0) area_[static_cast<std::size_t>(facade_[i])] += patch_area_[i];
  }
  /// [rows, patch] → [rows, facade]; 0 for a facade without patches. `Values`: a vector.
  template <class Values>
  std::vector<double> of(const Values& values, Divided divided) const {
    const std::size_t N = facade_.size(), F = area_.size();
    const std::size_t rows = N > 0 ? values.size() / N : 0;
    std::vector<double> means(rows * F, 0);
    // Patches of a facade follow each other: sums of several rows need not wait for each other.
    constexpr std::size_t rows_together = 4;
    parallel_chunks(rows, rows_together, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = 0; i < N; ++i)
        if (facade_[i] >= 0) {
          const auto f = static_cast<std::size_t>(facade_[i]);
          for (std::size_t row = begin; row < end; ++row) {
            const double term = patch_area_[i] * static_cast<double>(values[row * N + i]);
            means[row * F + f] += divided == Divided::terms ? term / area_[f] : term;
          }
        }
    });
    if (divided == Divided::sums)
      for (std::size_t at = 0; at < means.size(); ++at)
        if (area_[at % F] > 0) means[at] /= area_[at % F];
    return means;
  }

 private:
  std::vector<std::int32_t> facade_;
  std::vector<double> patch_area_, area_;
};

}  // namespace sunload
