// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The files that belong to a study.
#pragma once

#include <string>
#include <vector>

#include "io/study/study.h"

namespace sunload {

/// The study itself, and every file that one of its values names, whatever the key: scenes,
/// weather, horizons, sensors. Not the files that those name in turn.
std::vector<std::string> named_files(const StudyFile& study);

}  // namespace sunload
