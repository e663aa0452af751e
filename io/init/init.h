// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// `sunload init`: from a model to a study that runs.
#pragma once

#include <string>
#include <vector>

#include "io/init/findings.h"

namespace sunload {

/// Writes a study of the model to `path` (empty: the model's name with .yaml, in the working
/// folder), which passes `check`; what is told on the standard output are the next commands. Throws
/// InputError, also where the file is there.
int init_study(const InitRules& rules, const std::string& path);

/// Copies a study that comes with the program, and the files that it names, into `folder` (empty:
/// the working one). Throws InputError for a name that is none, and where a file is there.
int init_example(const std::string& name, const std::string& folder);

/// Names of these studies, sorted; none where they are not beside the program.
std::vector<std::string> example_names();

}  // namespace sunload
