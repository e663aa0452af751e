// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Large real models and weather files, which a clone does not have: they lie in a folder beside
/// the project (the CMake variable SUNLOAD_SHARED_DIR).
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/paths.h"

namespace sunload::test {

/// Absolute path of something in that folder.
inline std::string shared_path(const std::string& relative_path) {
  return shared_folder() + "/" + relative_path;
}

}  // namespace sunload::test

/// The running test is skipped where that file or folder of real models is not there; stands in
/// functions that return nothing.
#define SUNLOAD_NEEDS_MODEL(relative_path)                                   \
  if (!std::filesystem::exists(::sunload::test::shared_path(relative_path))) \
  GTEST_SKIP() << "NOT RUN: " << (relative_path) << " of the real models is not here"
