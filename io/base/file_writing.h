// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Bytes written to files of the system, and what is said where they cannot be.
#pragma once

#include <string>
#include <string_view>

#include "geo/base/check.h"

namespace sunload {

/// Writes all of the bytes to an open file, whatever interrupts it. Returns the number of the
/// error, or 0.
int write_all(int file, std::string_view bytes);

/// Where something was written is nothing any more: somebody removes files or folders meanwhile, or
/// the folder never was there.
class VanishedError : public MachineError {
  using MachineError::MachineError;
};

/// MachineError "cannot write `path`: <text of the error number>"; VanishedError of a file or
/// folder that is not there.
[[noreturn]] void throw_cannot_write(const std::string& path, int error_number);

}  // namespace sunload
