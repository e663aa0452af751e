// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/half_float.h"

#include <bit>
#include <cmath>

namespace sunload {
namespace {

constexpr int half_mantissa_bits = 10, half_bias = 15, float_mantissa_bits = 23, float_bias = 127;
constexpr std::uint16_t half_infinity = 0x7c00, half_nan = 0x7e00;
// Halfway between the largest half and the next power of two: from here on infinity is nearer.
constexpr float overflow = 65520.0F;
constexpr float smallest_normal = 0x1p-14F, subnormal_step = 0x1p-24F;

}  // namespace

std::uint16_t half_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000U);
  if (std::isnan(value)) return half_nan;
  const float size = std::fabs(value);
  if (size >= overflow) return sign | half_infinity;
  // Equally spaced below the normal numbers: the rounding of the machine is to even.
  if (size < smallest_normal)
    return sign | static_cast<std::uint16_t>(std::nearbyint(size / subnormal_step));
  constexpr int dropped = float_mantissa_bits - half_mantissa_bits;
  const std::uint32_t magnitude = bits & 0x7fffffffU;
  const std::uint32_t odd = magnitude >> dropped & 1U;
  // A carry out of the mantissa goes on into the exponent, as it should.
  const std::uint32_t rounded = magnitude + ((1U << (dropped - 1)) - 1) + odd;
  constexpr std::uint32_t bias = static_cast<std::uint32_t>(float_bias - half_bias)
                                 << half_mantissa_bits;
  return sign | static_cast<std::uint16_t>((rounded >> dropped) - bias);
}

std::string base64(std::span<const unsigned char> bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? digits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

}  // namespace sunload
