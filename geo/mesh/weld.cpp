// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "geo/base/keys.h"

namespace sunload {

namespace {

// Cells this many tolerances wide: few points near a border, few points in one cell.
constexpr double cell_tolerances = 16;

/// Lists of representatives by hashed cell; different cells may share a list,
/// which only costs comparisons.
class CellLists {
 public:
  explicit CellLists(std::size_t count) : first_(std::bit_ceil(2 * count + 1), -1) {}

  void add(std::uint64_t hash, std::int32_t item) {
    auto& first = first_[hash & (first_.size() - 1)];
    next_.push_back(first);  // item == next_.size() before the call
    first = item;
  }
  std::int32_t first(std::uint64_t hash) const { return first_[hash & (first_.size() - 1)]; }
  std::int32_t next(std::int32_t item) const { return next_[static_cast<std::size_t>(item)]; }

 private:
  std::vector<std::int32_t> first_, next_;
};

std::uint64_t cell_hash(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return mixed(mixed(mixed(x) ^ y) ^ z);
}

std::uint64_t hash_of_equal(Vec3 p) {
  // + 0.0 turns -0 into 0.
  return cell_hash(std::bit_cast<std::uint64_t>(p.x + 0.0), std::bit_cast<std::uint64_t>(p.y + 0.0),
                   std::bit_cast<std::uint64_t>(p.z + 0.0));
}

struct Range {
  std::int64_t low, high;
};

/// Where a tiny scene lies far off, cells are smaller than the spacing of its coordinates: any
/// number does for those beyond 64 bits, as long as equal coordinates have the same.
std::int64_t cell_number(double quotient) {
  constexpr double beyond = 9e18;
  return static_cast<std::int64_t>(std::clamp(std::floor(quotient), -beyond, beyond));
}

Range cells_near(double x, double tolerance, double width) {
  return {cell_number((x - tolerance) / width), cell_number((x + tolerance) / width)};
}

std::uint64_t hash_of_cell(std::int64_t x, std::int64_t y, std::int64_t z) {
  return cell_hash(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y),
                   static_cast<std::uint64_t>(z));
}

std::uint64_t home_hash(Vec3 p, double tolerance) {
  if (tolerance == 0) return hash_of_equal(p);
  const double width = cell_tolerances * tolerance;
  return hash_of_cell(cells_near(p.x, 0, width).low, cells_near(p.y, 0, width).low,
                      cells_near(p.z, 0, width).low);
}

/// The nearest representative seen so far, the earlier one where two are as near.
struct Nearest {
  double distance2;
  std::int32_t item = -1;

  void look(const CellLists& lists, std::uint64_t hash, Vec3 p, const std::vector<Vec3>& vertices) {
    for (auto i = lists.first(hash); i >= 0; i = lists.next(i)) {
      const Vec3 d = vertices[static_cast<std::size_t>(i)] - p;
      const double d2 = dot(d, d);
      if (d2 < distance2 || (d2 == distance2 && (item < 0 || i < item))) {
        distance2 = d2;
        item = i;
      }
    }
  }
};

std::int32_t representative(const CellLists& lists, Vec3 p, double tolerance,
                            const std::vector<Vec3>& vertices) {
  Nearest nearest{tolerance * tolerance};
  if (tolerance == 0) {
    nearest.look(lists, hash_of_equal(p), p, vertices);
    return nearest.item;
  }
  const double width = cell_tolerances * tolerance;
  const Range xs = cells_near(p.x, tolerance, width), ys = cells_near(p.y, tolerance, width),
              zs = cells_near(p.z, tolerance, width);
  for (auto x = xs.low; x <= xs.high; ++x) {
    for (auto y = ys.low; y <= ys.high; ++y) {
      for (auto z = zs.low; z <= zs.high; ++z) {
        nearest.look(lists, hash_of_cell(x, y, z), p, vertices);
      }
    }
  }
  return nearest.item;
}

}  // namespace

Welded weld(const std::vector<Vec3>& points, const std::vector<std::uint8_t>& is_used,
            double tolerance) {
  Welded result;
  result.new_index.assign(points.size(), -1);
  CellLists lists(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_used[i]) continue;
    auto item = representative(lists, points[i], tolerance, result.vertices);
    if (item >= 0) {
      ++result.merged;
    } else {
      item = static_cast<std::int32_t>(result.vertices.size());
      lists.add(home_hash(points[i], tolerance), item);
      result.vertices.push_back(points[i]);
    }
    result.new_index[i] = item;
  }
  return result;
}

}  // namespace sunload
