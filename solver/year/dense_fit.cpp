// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/year/dense_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "geo/base/vector_code.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

constexpr std::size_t lanes = 16;

/// In a fixed order of additions, whatever the vectors of the processor.
SUNLOAD_VECTOR_CODE double dot_product(const float* a, const float* b, std::size_t n) {
  double sum[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes)
    for (std::size_t l = 0; l < lanes; ++l)
      sum[l] += static_cast<double>(a[i + l]) * static_cast<double>(b[i + l]);
  double total = 0;
  for (; i < n; ++i) total += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  for (const double part : sum) total += part;
  return total;
}

}  // namespace

struct DenseFit::Factor {
  Eigen::LLT<Eigen::MatrixXd> normal;
};

DenseFit::DenseFit(std::vector<std::vector<float>> vectors, double price)
    : vectors_(std::move(vectors)) {
  const std::size_t M = vectors_.size();
  const auto rows = static_cast<Eigen::Index>(M);
  Eigen::MatrixXd normal(rows, rows);
  parallel_for(M, [&](std::size_t i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double product =
          dot_product(vectors_[i].data(), vectors_[j].data(), vectors_[i].size());
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      normal(row, column) = normal(column, row) = product + (i == j ? price : 0);
    }
  });
  factor_ = std::make_unique<const Factor>(Factor{Eigen::LLT<Eigen::MatrixXd>(normal)});
}

DenseFit::~DenseFit() = default;
DenseFit::DenseFit(DenseFit&&) noexcept = default;
DenseFit& DenseFit::operator=(DenseFit&&) noexcept = default;

std::vector<double> DenseFit::coefficients(std::span<const float> x) const {
  const auto rows = static_cast<Eigen::Index>(size());
  Eigen::VectorXd products(rows);
  for (Eigen::Index m = 0; m < rows; ++m)
    products[m] = dot_product(vectors_[static_cast<std::size_t>(m)].data(), x.data(), x.size());
  const Eigen::VectorXd c = factor_->normal.solve(products);
  return {c.data(), c.data() + rows};
}

double DenseFit::residual(std::span<const float> x, std::span<const double> c) const {
  std::vector<float> left(x.begin(), x.end());
  for (std::size_t m = 0; m < c.size(); ++m)
    for (std::size_t i = 0; i < left.size(); ++i)
      left[i] -= static_cast<float>(c[m]) * vectors_[m][i];
  return dot_product(left.data(), left.data(), left.size());
}

}  // namespace sunload
