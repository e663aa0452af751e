// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// `sunload sun` and `sky`: the sources of light alone.
#pragma once

#include <optional>
#include <string>

#include "io/plan/sky_dome.h"

namespace sunload {

/// The sun path as CSV on stdout (docs/developer/design.md, Commands and exit codes), or as a
/// sun-path diagram where `picture` names one.
int print_sun(const std::string& study, const std::string& picture = {});

struct SkyOptions {
  std::string time;
  std::string picture;                     ///< fisheye instead of CSV
  std::optional<Subdivision> subdivision;  ///< of the CSV
  SkyPictureRules rules;
};
/// The sky dome of the first variant at one instant, as CSV on stdout or as a picture.
int print_sky(const std::string& study, const SkyOptions& options);

}  // namespace sunload
