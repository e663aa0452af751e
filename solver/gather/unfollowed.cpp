// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/unfollowed.h"

#include <algorithm>

#include "solver/base/chunks.h"
#include "solver/base/threads.h"
#include "solver/mesh/push_pull.h"

namespace sunload {

namespace {

/// The rest of the series is taken for geometric where so little of it is left, or after so many.
constexpr double little = 1e-3;
constexpr int most_bounces = 200;
/// What is surely below 1, so that a series ends.
constexpr double largest_ratio = 0.999;
/// A place may miss so many times the share that the whole may: what is left is estimated, and the
/// estimate leaves a tenth of it and less.
constexpr double share_of_a_place = 100;
/// Of the patches, that may miss more: cracks and cavities, which have next to no light.
constexpr double few = 1e-3;

template <class Body>
void for_each_patch(std::size_t count, const Body& body) {
  parallel_for(count, body, receivers_per_chunk);
}

/// One column of light that goes from bounce to bounce.
class Bouncing {
 public:
  /// Begins with what a uniform sky sends, and where surfaces emit with the same from all of them.
  Bouncing(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics)
      : mesh_(mesh), lines_(lines), optics_(optics), radiosity_(mesh.element_count(), 0) {
    for (const LineEnds& ends : lines.ends)
      received.push_back(static_cast<double>(ends.fate.escaped) + (optics.any_emission ? 1 : 0));
  }
  void bounce() {
    for_each_patch(received.size(), [&](std::size_t i) {
      radiosity_[i] = static_cast<double>(optics_.diffuse[i]) * received[i];
    });
    pull_up(mesh_, radiosity_);
    gather(lines_.patches, radiosity_, received, Into::replace);
  }
  /// That all patches reflect.
  double power() const {
    return ordered_sum(
        received.size(), receivers_per_chunk, 0.0, [&](std::size_t begin, std::size_t end) {
          double sum = 0;
          for (std::size_t i = begin; i < end; ++i)
            sum += mesh_.area()[i] * static_cast<double>(optics_.diffuse[i]) * received[i];
          return sum;
        });
  }
  std::vector<double> received;  ///< [N]

 private:
  const Hierarchy& mesh_;
  const LineSet& lines_;
  const PatchOptics& optics_;
  std::vector<double> radiosity_;
};

/// Patches to which a bounce brings more than that share of what they had before.
std::size_t missing(const std::vector<double>& brought, const std::vector<double>& before,
                    double share) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < brought.size(); ++i)
    if (brought[i] > share * before[i]) ++count;
  return count;
}

/// Sum of q + q² + …
double geometric(double power, double power_before) {
  if (power <= 0 || power_before <= 0) return 0;
  const double q = std::min(power / power_before, largest_ratio);
  return q / (1 - q);
}

}  // namespace

int bounces_needed(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                   int bounces, double unshot) {
  if (lines.all_reflections || optics.any_emission) return bounces;
  Bouncing light(mesh, lines, optics);
  std::vector<double> all = light.received;  // of all bounces until then
  double in = 0;
  for (std::size_t i = 0; i < all.size(); ++i) in += mesh.area()[i] * all[i];
  const double few_patches = few * static_cast<double>(all.size());
  for (int b = 0; b < bounces; ++b) {
    const bool is_enough_of_all = light.power() <= unshot * in;
    light.bounce();
    if (is_enough_of_all &&
        static_cast<double>(missing(light.received, all, share_of_a_place * unshot)) <= few_patches)
      return b;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += light.received[i];
  }
  return bounces;
}

std::vector<float> light_beyond(const Hierarchy& mesh, const LineSet& lines,
                                const PatchOptics& optics, int bounces) {
  if (bounces == 0) return {};
  Bouncing light(mesh, lines, optics);
  std::vector<double> last(lines.ends.size(), 0);  // that the last two bring
  for (int b = 0; b < bounces; ++b) {
    light.bounce();
    if (b + 2 < bounces) continue;
    for (std::size_t i = 0; i < last.size(); ++i) last[i] += light.received[i];
  }
  const double power_of_last = light.power();

  std::vector<double> sum(last.size(), 0);
  double power_before = power_of_last, power = power_of_last, power_beyond = 0;
  for (int b = 0; b < most_bounces; ++b) {
    light.bounce();
    power_before = power;
    power = light.power();
    power_beyond += power;
    for_each_patch(sum.size(), [&](std::size_t i) { sum[i] += light.received[i]; });
    if (power <= little * power_of_last) break;
  }
  const double rest = geometric(power, power_before);
  power_beyond += rest * power;
  const double of_all = power_of_last > 0 ? power_beyond / power_of_last : 0;
  std::vector<float> beyond(last.size());
  for (std::size_t i = 0; i < beyond.size(); ++i)
    beyond[i] =
        static_cast<float>(last[i] > 0 ? (sum[i] + rest * light.received[i]) / last[i] : of_all);
  return beyond;
}

namespace {

/// What was there before the last two bounces, or the only one.
template <class Light>
const auto& before_last(const Light& reflected) {
  return reflected.two_before.empty() ? reflected.before : reflected.two_before;
}

}  // namespace

Columns unfollowed(const Reflected& reflected, std::span<const float> beyond) {
  Columns out = columns(beyond.size());
  const Columns& before = before_last(reflected);
  if (before.empty()) return out;  // no bounce
  for_each_patch(beyond.size(), [&](std::size_t i) {
    for (std::size_t k = i * block_width; k < (i + 1) * block_width; ++k)
      out[k] = beyond[i] * std::max(0.0f, reflected.irradiance[k] - before[k]);
  });
  return out;
}

std::vector<double> unfollowed(const ReflectedExposure& reflected, std::span<const float> beyond) {
  std::vector<double> out(beyond.size(), 0);
  const std::vector<double>& before = before_last(reflected);
  if (before.empty()) return out;
  for_each_patch(out.size(), [&](std::size_t i) {
    out[i] = static_cast<double>(beyond[i]) * std::max(0.0, reflected.irradiance[i] - before[i]);
  });
  return out;
}

}  // namespace sunload
