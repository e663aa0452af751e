// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What tests of lamps beside surfaces have in common.
#pragma once

#include "tests/support/scenes.h"

namespace sunload::test {

inline constexpr auto lamps = static_cast<std::size_t>(Part::lamps);

/// Many samples of each patch, so that errors are known.
inline SolverRules lamp_rules(int bounces) {
  SolverRules rules = test_rules();
  rules.lines_per_patch = 256;
  rules.direct_samples = 16 * 16;
  rules.bounces = bounces;
  return rules;
}

}  // namespace sunload::test
