// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/writing_behind.h"

#include <system_error>

namespace sunload {

void WritingBehind::begin(const Write& write) {
  finish();
  try {
    written_ = std::async(std::launch::async, write);
  } catch (const std::system_error&) {
    write();  // the machine has no threads left
  }
}

void WritingBehind::finish() {
  if (written_.valid()) written_.get();
}

}  // namespace sunload
