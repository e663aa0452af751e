// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/half_float.h"

#include <gtest/gtest.h>

#include "io/base/base64.h"

#include <cmath>
#include <limits>
#include <string>

namespace sunload {
namespace {

/// What a half's bits stand for (IEEE 754-2019, 3.4).
double half_value(unsigned bits) {
  const int exponent = static_cast<int>(bits >> 10 & 31U);
  const double mantissa = bits & 1023U, sign = (bits & 0x8000U) != 0 ? -1 : 1;
  if (exponent == 31)
    return mantissa != 0 ? std::numeric_limits<double>::quiet_NaN()
                         : sign * std::numeric_limits<double>::infinity();
  return sign * (exponent == 0 ? std::ldexp(mantissa, -24)
                               : std::ldexp(1 + mantissa / 1024, exponent - 15));
}

TEST(HalfFloat, EveryHalfComesBack) {
  for (unsigned bits = 0; bits < 0x10000U; ++bits) {
    const double value = half_value(bits);
    if (std::isnan(value))
      EXPECT_TRUE(std::isnan(half_value(half_bits(static_cast<float>(value)))));
    else
      EXPECT_EQ(half_bits(static_cast<float>(value)), bits);
  }
}

TEST(HalfFloat, GoesToTheNearestWithTiesToEven) {
  for (unsigned bits = 0; bits < 0x7c00U - 1; ++bits) {
    const double low = half_value(bits), high = half_value(bits + 1), middle = (low + high) / 2;
    const unsigned even = bits % 2 == 0 ? bits : bits + 1;
    EXPECT_EQ(half_bits(static_cast<float>(middle)), even) << bits;
    EXPECT_EQ(half_bits(std::nextafter(static_cast<float>(middle), 0.0F)), bits);
    EXPECT_EQ(half_bits(std::nextafter(static_cast<float>(middle), 1e9F)), bits + 1);
  }
  EXPECT_EQ(half_bits(static_cast<float>(largest_half)), 0x7bffU);
  EXPECT_EQ(half_bits(65519.0F), 0x7bffU);
  EXPECT_EQ(half_bits(65520.0F), 0x7c00U);
}

// RFC 4648, section 10.
TEST(Base64, TestVectors) {
  const auto coded = [](const std::string& text) {
    return base64({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
  };
  EXPECT_EQ(coded(""), "");
  EXPECT_EQ(coded("f"), "Zg==");
  EXPECT_EQ(coded("fo"), "Zm8=");
  EXPECT_EQ(coded("foo"), "Zm9v");
  EXPECT_EQ(coded("foob"), "Zm9vYg==");
  EXPECT_EQ(coded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(coded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(coded(std::string("\xff\xfe\xfd", 3)), "//79");
}

}  // namespace
}  // namespace sunload
