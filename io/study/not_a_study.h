// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Files that are given where a study belongs: a model, a weather file, a result.
#pragma once

#include <string>

namespace sunload {

/// Throws InputError, with a study to begin with, where the file is one of those by its first
/// bytes. Reads regular files only.
void refuse_other_files(const std::string& path);

}  // namespace sunload
