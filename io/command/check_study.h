// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// `sunload check`, `sun` and `sky`: everything that is known before computing.
#pragma once

#include <optional>
#include <string>

#include "io/plan/sky_dome.h"
#include "io/run/options.h"

namespace sunload {

enum class CheckFormat { text, json };
/// Whether triangles that cut through others are sought: some 10 s for a million.
enum class SearchIntersections { no, yes };
/// Whether the mesh is refined as a run would do it, or told without: seconds, or much less.
enum class CheckMesh { refined, unrefined };
struct CheckRules {
  CheckFormat format = CheckFormat::text;
  SearchIntersections search = SearchIntersections::no;
  CheckMesh mesh = CheckMesh::refined;
};
/// Reads everything, reports scene, sun path, work, memory, disk on stdout; what takes its
/// time on the standard error.
int check_study(const std::string& study, const RunOptions& options, const CheckRules& rules = {});

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
