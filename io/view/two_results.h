// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a page of two results knows of their difference.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/result/reader.h"

namespace sunload {

/// Which patches of the second result lie on each patch of the first, as `sunload compare` pairs
/// them: only where they cover all of it.
struct TwoResults {
  bool is_same = false;             ///< each patch has its own number; the lists are empty then
  std::vector<std::int32_t> count;  ///< of patches on each patch of the first
  std::vector<std::int32_t> patch;  ///< these, one after the other
  std::vector<float> area;          ///< in common [m2]
  /// Where a scale of the differences of the series ends that is the same at all times.
  std::optional<double> end;
};

/// `series`: that both have; empty: none. Every `step`-th interval of it is taken, as in the page.
TwoResults two_results(const ResultReader& first, const ResultReader& second,
                       const std::string& series, std::size_t step);

}  // namespace sunload
