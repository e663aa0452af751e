// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/base/check.h"

#include <algorithm>

namespace sunload {

std::string message(const Where& where, const std::string& what, const std::string& why,
                    const std::string& hint) {
  std::string text = where.file;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
  if (!text.empty()) text += ": ";
  text += what;
  if (!why.empty()) text += " (" + why + ")";
  if (!hint.empty()) text += "; " + hint;
  return text;
}

InputError::InputError(std::vector<std::string> problems) : problems_(std::move(problems)) {
  for (const auto& problem : problems_) joined_ += (joined_.empty() ? "" : "\n") + problem;
}

InputError::InputError(std::string problem) : InputError(std::vector{std::move(problem)}) {}

InputError::InputError(const Where& where, const std::string& what, const std::string& why,
                       const std::string& hint)
    : InputError(message(where, what, why, hint)) {}

void Problems::add(const Where& where, const std::string& what, const std::string& why,
                   const std::string& hint) {
  list_.push_back(message(where, what, why, hint));
}

void Problems::add(const InputError& error) {
  for (const std::string& problem : error.problems())
    if (std::find(list_.begin(), list_.end(), problem) == list_.end()) list_.push_back(problem);
}

void Problems::throw_if_any() const {
  if (!list_.empty()) throw InputError(list_);
}

void contract_failed(const char* condition, const char* file, int line,
                     const std::string& context) {
  throw std::logic_error(std::string(file) + ":" + std::to_string(line) + ": " + context +
                         " (broken promise: " + condition + ")");
}

}  // namespace sunload
