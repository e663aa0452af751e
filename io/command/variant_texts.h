// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Variants told one after the other: the first in full, the others by what differs.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sunload {

/// What is told of a variant, under headings, all of them in order whether they have words or not;
/// that of warnings is empty.
struct CheckText {
  std::string head;
  std::vector<std::pair<std::string, std::string>> sections;
};

/// Variants in the order of the study, on the standard output.
class VariantTexts {
 public:
  void print(const std::string& name, CheckText text);

 private:
  std::optional<CheckText> first_;
  std::string first_name_;
};

}  // namespace sunload
