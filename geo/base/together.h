// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Things that have been joined, each known by one of them: disjoint sets, paths halved (Tarjan &
/// van Leeuwen 1984, Worst-case analysis of set union algorithms).
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace sunload {

class Together {
 public:
  explicit Together(std::size_t count) : first_(count) {
    std::iota(first_.begin(), first_.end(), std::size_t{0});
  }
  /// The one that stands for all that `i` is joined with.
  std::size_t of(std::size_t i) {
    while (first_[i] != i) i = first_[i] = first_[first_[i]];
    return i;
  }
  /// The one that stands for `a` stands from now on for all that `b` is joined with, too.
  void join(std::size_t a, std::size_t b) { first_[of(b)] = of(a); }

 private:
  std::vector<std::size_t> first_;
};

}  // namespace sunload
