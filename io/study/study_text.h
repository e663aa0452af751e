// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Studies that are no files of their own: results keep the text of theirs.
#pragma once

#include <string>

#include "io/study/study.h"

namespace sunload {

/// As `read_study` of a file of that name with that text.
StudyFile study_of_text(const std::string& path, const std::string& yaml);

}  // namespace sunload
