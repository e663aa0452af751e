// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/base/pattern.h"

#include <regex>

namespace sunload {

struct Pattern::Compiled {
  std::regex regex;
};

namespace {
std::vector<Pattern::Part> parts_of(const std::smatch& match) {
  std::vector<Pattern::Part> parts;
  for (const auto& part : match) parts.push_back({part.matched, part.str()});
  return parts;
}
}  // namespace

Pattern::Pattern(const std::string& expression, Letters letters)
    : compiled_(std::make_shared<const Compiled>(Compiled{std::regex(
          expression, letters == Letters::of_any_case ? std::regex::ECMAScript | std::regex::icase
                                                      : std::regex::ECMAScript)})) {}

std::optional<std::vector<Pattern::Part>> Pattern::whole(const std::string& text) const {
  std::smatch match;
  if (!std::regex_match(text, match, compiled_->regex)) return std::nullopt;
  return parts_of(match);
}

std::optional<std::vector<Pattern::Part>> Pattern::first(const std::string& text) const {
  std::smatch match;
  if (!std::regex_search(text, match, compiled_->regex)) return std::nullopt;
  return parts_of(match);
}

}  // namespace sunload
