// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Columns of values that are not negative, in 16 bits each, with a factor for every row and one
/// for every column of a block.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/light/sun_block.h"

namespace sunload {

/// The factor of a column is its largest value. As a share of this, each value is known to half of
/// 1/65535 of the largest share in its row: far finer than the errors of samples of few rays, or of
/// skies and suns that are made up of others. Where all columns but one are empty, values are known
/// to a rounding of a float. A row takes 36 bytes instead of 64.
class PackedColumns {
 public:
  PackedColumns() = default;
  /// Values below 0 count as 0.
  explicit PackedColumns(const Columns& values);

  bool empty() const { return of_row_.empty(); }
  std::size_t rows() const { return of_row_.size(); }
  float at(std::size_t i, std::size_t k) const {
    return static_cast<float>(code_[i * block_width + k]) * (of_row_[i] * of_column_[k]);
  }
  /// A value is a code · of_row(i) · of_column(k).
  const std::uint16_t* codes(std::size_t i) const { return code_.data() + i * block_width; }
  float of_row(std::size_t i) const { return of_row_[i]; }
  float of_column(std::size_t k) const { return of_column_[k]; }
  /// Calls `array` for each array, to write or to read it.
  template <class Self, class Array>
  static void visit(Self& self, Array&& array) {
    array(self.of_column_);
    array(self.of_row_);
    array(self.code_);
  }

 private:
  std::array<float, block_width> of_column_{};
  std::vector<float> of_row_;        ///< [rows]
  LargeVector<std::uint16_t> code_;  ///< [rows][block_width]
};

}  // namespace sunload
