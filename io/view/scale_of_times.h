// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the scale of a series ends that is the same at all times.
#pragma once

#include <vector>

namespace sunload {

/// The largest of the ends that the intervals would have each by itself.
class ScaleOfTimes {
 public:
  /// `area`: of each value.
  explicit ScaleOfTimes(std::vector<double> area);
  /// Values of an interval; NaN: not known.
  void add(const std::vector<double>& values);
  /// In every interval `scale_share` of the area lie below or at it, as far as values are known;
  /// not rounded. 0 where nothing is above that.
  double end() const { return end_; }

 private:
  std::vector<double> area_;
  double end_ = 0;
};

}  // namespace sunload
