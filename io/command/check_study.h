// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// `sunload check`: everything that is known before computing.
#pragma once

#include <string>

#include "io/command/check_meshes.h"
#include "io/run/options.h"

namespace sunload {

enum class CheckFormat { text, json };
/// Whether triangles that cut through others are sought: some 10 s for a million.
enum class SearchIntersections { no, yes };
struct CheckRules {
  CheckFormat format = CheckFormat::text;
  SearchIntersections search = SearchIntersections::no;
  CheckMesh mesh = CheckMesh::refined;
};
/// Reads everything, reports scene, sun path, work, memory, disk on stdout; what takes its
/// time on the standard error.
int check_study(const std::string& study, const RunOptions& options, const CheckRules& rules = {});

}  // namespace sunload
