// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Lengths as tables of plan data have them: `12`, `12.5 m`, `40 ft`, `39'6"`.
#pragma once

#include <optional>
#include <string>

namespace sunload {

/// A number and what is written behind it: nothing, m, ft or '.
struct WrittenLength {
  double value = 0;
  std::string unit;

  bool is_in_feet() const { return unit == "ft" || unit == "'"; }
};
/// Inches are part of the feet. Nothing where it is no length.
std::optional<WrittenLength> written_length(const std::string& text);

/// With a point in the place of a comma that can be nothing but a decimal one: `12,5`, not `1,500`.
std::string with_decimal_point(std::string text);

}  // namespace sunload
