// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Names of a file as everything behind the readers may take them.
#pragma once

#include "geo/mesh/mesh.h"

namespace sunload {

/// Names of objects, kinds and materials, and the CRS, become UTF-8 on one line (io/base/names.h);
/// names of objects stay unique. What was changed is noted, with the first such name.
void make_names_plain(PolygonModel& model);

}  // namespace sunload
