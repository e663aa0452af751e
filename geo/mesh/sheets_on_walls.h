// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Panes and panels that lie on a solid and look into it: drawn the wrong way round.
#pragma once

#include <cstddef>
#include <string>

#include "geo/mesh/mesh.h"
#include "geo/mesh/orient.h"

namespace sunload {

/// Sheets that were turned.
struct TurnedSheets {
  double area_m2 = 0;
  std::size_t triangles = 0;
  std::string largest;  ///< the object that has most of them
};

/// Turns open one-sided bodies over of which more than half looks at the front of a closed body
/// from so near (ten times what touches: 2 cm) that no light could reach what it looks at. Land is
/// left as it is. Cost: one look for each triangle of such bodies at what is near.
TurnedSheets turn_sheets_on_walls(Mesh& mesh, const Bodies& bodies);

}  // namespace sunload
