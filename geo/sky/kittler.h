// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The clear sky of Kittler (1967), which is that of the CIE (1973).
#pragma once

#include "geo/sky/sky.h"

namespace sunload {

inline SkyShape kittler_clear_sky() {
  SkyShape shape;
  shape.v = -1;
  shape.b = -0.32;
  shape.f = 0.91;
  shape.c = 10;
  shape.d = -3;
  shape.e = 0.45;
  return shape;
}

}  // namespace sunload
