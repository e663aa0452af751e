// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "geo/base/check.h"

namespace sunload::test {

/// What the user is told where `work` refuses its input (or fails with another `Error`); empty
/// where it does not.
template <class Error = InputError, class Work>
std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// From `name` on, which the message must have: without the folder of a file.
inline std::string from_name_on(const std::string& message, const std::string& name) {
  const auto at = message.find(name);
  return at == std::string::npos ? message : message.substr(at);
}

}  // namespace sunload::test
