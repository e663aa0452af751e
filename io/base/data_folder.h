// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Where files that come with the program are: studies to begin with, their schema, scripts.
#pragma once

#include <string>

namespace sunload {

/// The folder that has `configs/` and `scripts/`: share/sunload of the prefix that the program was
/// installed to, or the sources that it was built in. Empty where neither is found.
std::string data_folder();

}  // namespace sunload
