// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Regular expressions in the grammar of ECMAScript. One source knows <regex>, which costs seconds
/// in each that includes it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sunload {

class Pattern {
 public:
  /// Whether capital and small letters differ.
  enum class Letters { by_case, of_any_case };
  explicit Pattern(const std::string& expression, Letters letters = Letters::by_case);

  /// What a group has matched; part 0 is the whole match.
  struct Part {
    bool matched = false;  ///< false for a group that the match went without
    std::string text;
  };
  /// The match and its groups in their order; nothing where `text` as a whole does not match.
  std::optional<std::vector<Part>> whole(const std::string& text) const;
  /// The same for the first place in `text` that matches.
  std::optional<std::vector<Part>> first(const std::string& text) const;

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace sunload
