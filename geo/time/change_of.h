// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geo/time/time.h"

namespace sunload {

/// The first instant after `a` at which `holds(t)` is not what it is at `a`, to the last bit, where
/// it changes once before `b`: bisection, some fifty calls.
template <class Predicate>
UnixTime change_of(const Predicate& holds, UnixTime a, UnixTime b) {
  const bool before = holds(a);
  while (true) {
    const UnixTime middle = a + (b - a) / 2;
    if (middle <= a || middle >= b) return b;
    (holds(middle) == before ? a : b) = middle;
  }
}

}  // namespace sunload
