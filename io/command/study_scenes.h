// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes of studies before any light, for the commands that show them: view and render.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "io/run/scene_file.h"
#include "io/study/study.h"

namespace sunload {

/// The scene of each of these variants as a file that reads like a result without light, beside
/// `output`; tells the warnings of study and scenes. Throws InputError, also where `output` is a
/// file that the study reads.
std::deque<SceneFile> study_scenes(const StudyFile& file, const std::vector<Study>& variants,
                                   const std::string& output);

}  // namespace sunload
