// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Version and commit of this build, and the wall clock for attributes.
#pragma once

#include "geo/time/time.h"

namespace sunload {

extern const char* const version;
extern const char* const commit;
/// The present time; only ever an attribute, never part of a number.
UnixTime now();

}  // namespace sunload
