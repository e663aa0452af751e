// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/late_library.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "geo/base/check.h"
#include "tests/support/refusal_of.h"

namespace sunload::test {
namespace {

constexpr const char* c_mathematics = "libm.so.6";

TEST(LateLibrary, FunctionsAreCalledAsIfTheyWereLinked) {
  LateFunction<double(double, double)> power(c_mathematics, "pow");
  EXPECT_EQ(power(2.0, 10.0), 1024.0);
  EXPECT_EQ(power(2, -1), 0.5);  // arguments are converted as in any call
}

TEST(LateLibrary, WhatIsNotThereIsToldByName) {
  LateFunction<void()> of_no_library("libnobody_has.so.7", "anything");
  const std::string no_library = refusal_of<MachineError>([&] { of_no_library(); });
  EXPECT_NE(no_library.find("cannot load the library libnobody_has.so.7"), std::string::npos)
      << no_library;
  LateFunction<void()> no_function(c_mathematics, "function_that_nobody_has");
  const std::string lacking = refusal_of<MachineError>([&] { no_function(); });
  EXPECT_NE(lacking.find("libm.so.6 is another edition"), std::string::npos) << lacking;
  EXPECT_NE(lacking.find("function_that_nobody_has"), std::string::npos) << lacking;
  // Nothing is kept of a failure.
  EXPECT_EQ(refusal_of<MachineError>([&] { of_no_library(); }), no_library);
}

}  // namespace
}  // namespace sunload::test
