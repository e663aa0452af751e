// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/fill_holes.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace sunload {

namespace {

struct Step {
  int columns, rows;
};
constexpr std::array<Step, 8> about{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
constexpr int most = 5;  // of the directions: those beyond a straight rim have three

/// The first data from a cell on in one direction.
struct Seen {
  double value = 0;
  double steps = -1;  ///< to it; below 0: there are none
};

/// Calls `visit(cell, seen)` for each cell of the raster without data.
template <class Visit>
void look(const Raster& raster, Step step, const Visit& visit) {
  std::vector<Seen> from_next_row(raster.columns), from_row(raster.columns);
  for (std::size_t r = 0; r < raster.rows; ++r) {
    const std::size_t row = step.rows > 0 ? raster.rows - 1 - r : r;
    for (std::size_t c = 0; c < raster.columns; ++c) {
      const std::size_t column = step.columns > 0 ? raster.columns - 1 - c : c;
      const double value = raster.at(column, row);
      if (!std::isnan(value)) {
        from_row[column] = {value, 0};
        continue;
      }
      Seen seen;
      const bool is_rim = (step.columns != 0 && c == 0) || (step.rows != 0 && r == 0);
      if (!is_rim) {
        const auto next =
            static_cast<std::size_t>(static_cast<std::ptrdiff_t>(column) + step.columns);
        seen = (step.rows == 0 ? from_row : from_next_row)[next];
        if (seen.steps >= 0) ++seen.steps;
      }
      from_row[column] = seen;
      visit(row * raster.columns + column, seen);
    }
    std::swap(from_next_row, from_row);
  }
}

/// A mean of values, each with a weight.
struct Mean {
  double weighed = 0, weights = 0;
  void add(double value, double weight) {
    weighed += weight * value;
    weights += weight;
  }
};
/// What has been seen from a cell: by all, and by lines that end at data both ways, which go on
/// with planes as they are.
struct Sum {
  Mean all, both_ways;
  int count = 0;
};

}  // namespace

std::vector<std::size_t> fill_holes(Raster& raster,
                                    const std::function<bool(std::size_t)>& is_wanted) {
  std::vector<std::uint32_t> number(raster.values.size(), 0);  // of a hole's cell, from 1
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < number.size(); ++cell) {
    if (!std::isnan(raster.values[cell]) || !is_wanted(cell)) continue;
    cells.push_back(cell);
    number[cell] = static_cast<std::uint32_t>(cells.size());
  }
  if (cells.empty()) return {};
  const auto& g = raster.file_from_cell;
  std::vector<Sum> sums(cells.size());
  std::vector<Seen> ahead(cells.size());
  constexpr std::size_t half = about.size() / 2;
  for (std::size_t line = 0; line < half; ++line) {
    const Step step = about[line], back = about[line + half];
    const double length =
        std::hypot(step.columns * g[1] + step.rows * g[2], step.columns * g[4] + step.rows * g[5]);
    const auto take = [&](Sum& sum, const Seen& seen) {
      if (seen.steps < 0) return;
      sum.all.add(seen.value, 1 / (seen.steps * length));
      ++sum.count;
    };
    look(raster, step, [&](std::size_t cell, const Seen& seen) {
      if (number[cell] == 0) return;
      ahead[number[cell] - 1] = seen;
      take(sums[number[cell] - 1], seen);
    });
    look(raster, back, [&](std::size_t cell, const Seen& seen) {
      if (number[cell] == 0) return;
      Sum& sum = sums[number[cell] - 1];
      take(sum, seen);
      const Seen& other = ahead[number[cell] - 1];
      if (seen.steps < 0 || other.steps < 0) return;
      sum.both_ways.add(seen.value, 1 / (seen.steps * length));
      sum.both_ways.add(other.value, 1 / (other.steps * length));
    });
  }
  std::vector<std::size_t> filled;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (sums[i].count < most) continue;
    const Mean& mean = sums[i].both_ways.weights > 0 ? sums[i].both_ways : sums[i].all;
    raster.values[cells[i]] = mean.weighed / mean.weights;
    filled.push_back(cells[i]);
  }
  return filled;
}

}  // namespace sunload
