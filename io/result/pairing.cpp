// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/pairing.h"

#include <algorithm>
#include <array>
#include <string>

#include "io/result/time.h"

namespace sunload {

bool are_pairs(const ResultReader& base, const ResultReader& variant) {
  const auto same_text = [&](const char* name) {
    return base.text_attribute(name) == variant.text_attribute(name);
  };
  const auto same_number = [&](const char* name) {
    return base.number_attribute(name) == variant.number_attribute(name);
  };
  if (base.text_attribute("pairing_id").empty() || variant.text_attribute("pairing_id").empty())
    return false;
  if (same_text("pairing_id")) return true;
  // Of the whole period the identifier has said it.
  if (!base.chosen().any() || !have_same_times(base, variant)) return false;
  constexpr std::array counts{"seed", "realizations", "lines_per_patch", "direct_samples"};
  return same_text("transport") && std::all_of(counts.begin(), counts.end(), same_number);
}

}  // namespace sunload
