// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The text of a study to begin with: every line says where it comes from.
#pragma once

#include <string>

#include "io/init/findings.h"

namespace sunload {

/// Marks lines that are guesses, or that need the user.
inline constexpr const char* mark = "<<<";

/// What the first picture is made with.
struct FirstPicture {
  double max_edge_m = 1;
};

/// How the period was chosen.
enum class FirstPeriod {
  days,       ///< three days, of clear sky or of the weather
  year,       ///< all of the weather
  positions,  ///< places of the sun: where the scene stands is not known
};
FirstPeriod first_period(const Findings& found);

/// `folder`: of the study, which the paths in it are relative to.
std::string study_text(const std::string& name, const InitRules& rules, const Findings& found,
                       const FirstPicture& picture, const std::string& folder);

/// A path as a study in that folder writes it. Throws InputError for one that is not in UTF-8.
std::string path_in_study(const std::string& path, const std::string& folder);

/// A name that a study may have, of the stem of a file.
std::string study_name(const std::string& path);

}  // namespace sunload
