// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Results with other values, shapes and kinds inside of valid HDF5. The input is a byte that
// chooses the result, and then seven bytes for each change: what, where (2), element (2), value
// (2).
#include "geo/base/check.h"
#include "tests/fuzz/changed_result.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("result_values", [](std::string_view bytes) {
  constexpr std::size_t most_changes = 6;
  const auto number = [&bytes] {
    const auto low = take_byte(bytes);
    return low + 256U * take_byte(bytes);
  };
  const Valid which = take_byte(bytes) % 2 == 0 ? Valid::broadband : Valid::bands;
  std::vector<ChangeAt> changes;
  while (!bytes.empty() && changes.size() < most_changes) {
    ChangeAt at;
    at.change = static_cast<ResultChange>(take_byte(bytes) % result_changes);
    at.place = number();
    at.element = number();
    at.value = number();
    changes.push_back(at);
  }
  read_by_all(changed_result(which, changes), which);
});

}  // namespace sunload::fuzz
