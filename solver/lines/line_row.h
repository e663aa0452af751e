// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One row of lines: what the lines of a patch or sensor bring, in each realization and in all
/// together.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/lines/line_follower.h"
#include "solver/lines/lines.h"
#include "solver/lines/split_row.h"

namespace sunload {

class LineRow {
 public:
  /// Forgets the lines. Links of the lines to come lead to no element of a larger form factor.
  void begin(double largest_link);
  /// Receives the lines of the realization at hand.
  LineCollector& own() { return own_; }
  /// Lines to come are those of the next realization. Moves the glimpses of the one at hand to
  /// `glimpses`, as those of `receiver`.
  void end_realization(std::size_t receiver, std::vector<Glimpse>& glimpses);
  /// Appends the row to its block of links in each set. `lines_each`: lines of every realization.
  void store(std::size_t row, std::size_t lines_each, Lines& lines);

 private:
  static constexpr std::size_t tables = 3;
  /// Where the links of one table end, of each realization.
  using EndsOfLinks = std::vector<std::uint32_t>;

  LineCollector own_;  ///< links of all realizations, the rest of the one at hand
  std::array<EndsOfLinks, tables> end_;
  std::vector<LineEnds> ends_;  ///< per realization
  std::vector<double> lamps_;
  SplitRow split_;
};

}  // namespace sunload
