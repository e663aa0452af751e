// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One thread each: callers solve realizations side by side, and bits do not depend on threads.
#define EIGEN_DONT_PARALLELIZE
#include "solver/matrix/dense_solve.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geo/base/check.h"

namespace sunload {

std::vector<float> all_reflections(const std::vector<float>& F, const std::vector<float>& rho) {
  // Light that is reflected more often than this in the mean leaves nowhere that matters.
  constexpr double most_reflections = 1e4;
  const auto n = static_cast<Eigen::Index>(rho.size());
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::MatrixXd factors = Eigen::Map<const RowMajor>(F.data(), n, n).cast<double>();
  const Eigen::VectorXd shares = Eigen::Map<const Eigen::VectorXf>(rho.data(), n).cast<double>();
  Eigen::MatrixXd system = -factors * shares.asDiagonal();
  system.diagonal().array() += 1;
  const Eigen::MatrixXd all = Eigen::PartialPivLU<Eigen::MatrixXd>(system).solve(factors);
  const double largest = all.cwiseAbs().rowwise().sum().maxCoeff();
  if (!(largest <= most_reflections))
    throw InputError({}, "the surfaces of the scene reflect nearly all light, and none leaves it",
                     "transport: matrix follows all reflections, and here they do not end",
                     "lower scene.materials.*.diffuse, or write solver.unfollowed: leave");
  std::vector<float> out(F.size());
  Eigen::Map<RowMajor>(out.data(), n, n) = all.cwiseMax(0.0).cast<float>();  // below 0: rounding
  return out;
}

}  // namespace sunload
