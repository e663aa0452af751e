// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which part of the patches of two results lies in the same place.
#pragma once

#include <vector>

#include "io/result/reader.h"

namespace sunload {

/// Area [m2] that patches have in common with those of another result: in the same plane, seen from
/// the same side, of objects of the same name. Patches that are cut otherwise share what they
/// overlap. Exact but for a thousandth of a patch, which is rounding; planes are the same within a
/// millimetre.
struct CommonArea {
  std::vector<double> base, variant;  ///< per patch
};

/// Some microseconds a patch; nothing where both have the same mesh.
CommonArea common_area(const ResultReader& base, const ResultReader& variant);

}  // namespace sunload
