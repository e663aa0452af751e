// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/fresnel.h"

#include <algorithm>
#include <cmath>

namespace sunload {

namespace {

constexpr double squared(double x) { return x * x; }

constexpr PaneShares all_reflected{1, 0};

/// One pane whose faces reflect r each and whose glass lets τ pass.
PaneShares one_pane(double r, double tau) {
  const double between = 1 - squared(r * tau);
  if (between <= 0) return all_reflected;  // r has been rounded to 1: grazing
  const double passed = squared(1 - r) / between;
  return {r + r * squared(tau) * passed, tau * passed};
}

/// Pane 2 behind the stack 1, which looks the same from both of its sides.
PaneShares behind(const PaneShares& stack, const PaneShares& pane) {
  const double between = 1 - stack.reflected * pane.reflected;
  if (between <= 0) return all_reflected;
  return {stack.reflected + squared(stack.transmitted) * pane.reflected / between,
          stack.transmitted * pane.transmitted / between};
}

PaneShares stack_of(const PaneShares& pane, int count) {
  PaneShares stack = pane;
  for (int p = 1; p < count; ++p) stack = behind(stack, pane);
  return stack;
}

}  // namespace

PaneShares pane_shares(const PaneStack& panes, double cos_theta) {
  const double c = std::clamp(cos_theta, 0.0, 1.0), n = panes.refractive_index;
  const double cos_t = std::sqrt(1 - (1 - c * c) / (n * n));  // Snell
  const double r_s = squared((c - n * cos_t) / (c + n * cos_t));
  const double r_p = squared((cos_t - n * c) / (cos_t + n * c));
  const double tau = std::exp(-panes.absorption / cos_t);
  const PaneShares s = stack_of(one_pane(r_s, tau), panes.count);
  const PaneShares p = stack_of(one_pane(r_p, tau), panes.count);
  return {(s.reflected + p.reflected) / 2, (s.transmitted + p.transmitted) / 2};
}

double metal_reflectance(double n, double k, double cos_theta) {
  const double c = std::clamp(cos_theta, 0.0, 1.0), c2 = c * c, s2 = 1 - c2;
  // (a + i b)² = (n + i k)² - sin²θ, the normal component of the refracted wave.
  const double real = n * n - k * k - s2;
  const double modulus = std::hypot(real, 2 * n * k);  // a² + b²
  const double a = std::sqrt(std::max(0.0, (modulus + real) / 2));
  const double R_s = (modulus + c2 - 2 * a * c) / (modulus + c2 + 2 * a * c);
  const double along = c2 * modulus + s2 * s2, across = 2 * a * c * s2;
  const double R_p = along + across > 0 ? R_s * (along - across) / (along + across) : 1;
  return (R_s + R_p) / 2;
}

}  // namespace sunload
