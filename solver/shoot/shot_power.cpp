// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shoot/shot_power.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "geo/base/check.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

struct Sum {
  SunTotals of{};
  Sum& operator+=(const Sum& other) {
    for (std::size_t k = 0; k < block_width; ++k) of[k] += other.of[k];
    return *this;
  }
};

}  // namespace

SunTotals total_power(const DoubleColumns& power) {
  return ordered_sum(power.size() / block_width, receivers_per_chunk, Sum{},
                     [&](std::size_t begin, std::size_t end) {
                       Sum sum;
                       for (std::size_t i = begin; i < end; ++i)
                         for (std::size_t k = 0; k < block_width; ++k)
                           sum.of[k] += power[i * block_width + k];
                       return sum;
                     })
      .of;
}

void refuse_samples(double samples) {
  std::ostringstream text;
  text << std::scientific << std::setprecision(1) << "solver.power_per_sample_w asks for "
       << samples << " samples in one shot (at most " << most_samples
       << "); write a larger one, or auto";
  throw InputError(text.str());
}

std::vector<std::uint32_t> sample_counts(const DoubleColumns& power, const SunTotals& total,
                                         double samples, double offset) {
  if (!(samples <= most_samples)) refuse_samples(samples);
  const std::size_t patches = power.size() / block_width;
  SunTotals share{};  // of a watt of each sun in the mixture
  int suns = 0;
  for (const double P_T : total) suns += P_T > 0;
  for (std::size_t k = 0; k < block_width; ++k)
    if (total[k] > 0) share[k] = 1 / (suns * total[k]);

  std::vector<std::uint32_t> counts(patches, 0);
  double cumulated = 0, previous = 0;
  for (std::size_t i = 0; i < patches; ++i) {
    double q = 0;
    for (std::size_t k = 0; k < block_width; ++k) q += power[i * block_width + k] * share[k];
    if (q <= 0) continue;
    cumulated += q;
    const double up_to_here = std::floor(samples * cumulated + offset);
    counts[i] = static_cast<std::uint32_t>(std::max(1.0, up_to_here - previous));
    previous = up_to_here;
  }
  return counts;
}

}  // namespace sunload
