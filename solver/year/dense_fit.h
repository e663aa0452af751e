// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Least squares on few vectors, with a price on large coefficients (Tikhonov 1963).
#pragma once

#include <memory>
#include <span>
#include <vector>

namespace sunload {

/// For fixed vectors v_1 … v_M the c that make |x - Σ c_m v_m|² + price |c|² least, for any x.
class DenseFit {
 public:
  /// `vectors`: [M][n], M ≥ 0. `price` > 0. Cost: M² n operations.
  DenseFit(std::vector<std::vector<float>> vectors, double price);
  ~DenseFit();
  DenseFit(DenseFit&&) noexcept;
  DenseFit& operator=(DenseFit&&) noexcept;

  std::size_t size() const { return vectors_.size(); }
  /// c of `x` [n]. Cost: M n operations. From any thread.
  std::vector<double> coefficients(std::span<const float> x) const;
  /// |x - Σ c_m v_m|².
  double residual(std::span<const float> x, std::span<const double> c) const;

 private:
  struct Factor;
  std::vector<std::vector<float>> vectors_;
  std::unique_ptr<const Factor> factor_;
};

}  // namespace sunload
