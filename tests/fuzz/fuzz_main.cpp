// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The entry of libFuzzer: runs the one target that is linked in.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sunload::fuzz;
  static const Target target = targets().begin()->second;
  run(target, {reinterpret_cast<const char*>(data), size});
  return 0;
}
