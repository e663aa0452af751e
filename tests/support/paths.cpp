// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/paths.h"

namespace sunload::test {

std::string source_folder() { return SUNLOAD_SOURCE_DIR; }
std::string shared_folder() { return SUNLOAD_SHARED_DIR; }
std::string program_path() { return SUNLOAD_PROGRAM; }

}  // namespace sunload::test
