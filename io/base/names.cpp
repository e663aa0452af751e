// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/names.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>

namespace sunload {
namespace {

constexpr std::uint32_t delete_sign = 0x7F;
constexpr unsigned char first_continuation = 0x80, last_continuation = 0xBF;

/// Characters 0x80 … 0x9F of Windows-1252 (Unicode Consortium, CP1252.TXT).
constexpr std::array<std::uint16_t, 32> windows_1252{
    0x20AC, 0xFFFD, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0xFFFD, 0x017D, 0xFFFD, 0xFFFD, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0xFFFD, 0x017E, 0x0178};

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< that it took
};

/// Bytes of a character of UTF-8 by its first one, and the bounds of its second (RFC 3629, 4).
struct Form {
  std::size_t bytes = 0;  ///< 0: no character begins so
  unsigned char low = first_continuation, high = last_continuation;
};

Form form_of(unsigned char first) {
  if (first < 0x80) return {1};
  if (first < 0xC2) return {};
  if (first < 0xE0) return {2};
  if (first == 0xE0) return {3, 0xA0, last_continuation};
  if (first == 0xED) return {3, first_continuation, 0x9F};
  if (first < 0xF0) return {3};
  if (first == 0xF0) return {4, 0x90, last_continuation};
  if (first < 0xF4) return {4};
  if (first == 0xF4) return {4, first_continuation, 0x8F};
  return {};
}

/// The first character of `bytes`, which are not empty.
Character first_of(std::string_view bytes) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(bytes[k]); };
  const unsigned char first = byte(0);
  const Form form = form_of(first);
  const Character single{
      first >= 0x80 && first < 0xA0 ? windows_1252[first - 0x80U] : std::uint32_t{first}, 1};
  if (form.bytes <= 1 || bytes.size() < form.bytes) return single;
  constexpr std::array<unsigned, 5> first_bits{0, 0x7F, 0x1F, 0x0F, 0x07};
  std::uint32_t code = first & first_bits[form.bytes];
  for (std::size_t k = 1; k < form.bytes; ++k) {
    const unsigned char low = k == 1 ? form.low : first_continuation;
    const unsigned char high = k == 1 ? form.high : last_continuation;
    if (byte(k) < low || byte(k) > high) return single;
    code = code << 6 | (byte(k) & 0x3FU);
  }
  return {code, form.bytes};
}

void append(std::string& text, std::uint32_t code) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return add(code);
  if (code < 0x800) return add(0xC0 | code >> 6), add(0x80 | (code & 0x3F));
  if (code < 0x10000) {
    add(0xE0 | code >> 12);
  } else {
    add(0xF0 | code >> 18);
    add(0x80 | (code >> 12 & 0x3F));
  }
  add(0x80 | (code >> 6 & 0x3F));
  add(0x80 | (code & 0x3F));
}

bool is_control(std::uint32_t code) { return code < 0x20 || (code >= delete_sign && code < 0xA0); }

/// Characters one by one; `stays`: control characters that are not written out.
template <class Stays>
std::string rewritten(std::string_view bytes, Stays&& stays) {
  std::string text;
  text.reserve(bytes.size());
  while (!bytes.empty()) {
    const Character c = first_of(bytes);
    if (is_control(c.code) && !stays(c.code))
      text += fmt::format("\\x{:02x}", c.code);
    else
      append(text, c.code);
    bytes.remove_prefix(c.bytes);
  }
  return text;
}

}  // namespace

std::string utf8_text(std::string_view bytes) {
  return rewritten(bytes, [](std::uint32_t) { return true; });
}

std::string without_controls(std::string_view bytes) {
  return rewritten(bytes, [](std::uint32_t code) { return code == '\n' || code == '\t'; });
}

std::string clean_name(std::string_view bytes) {
  return rewritten(bytes, [](std::uint32_t) { return false; });
}

}  // namespace sunload
