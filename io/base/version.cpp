// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/version.h"

#include <ctime>

#include "version_numbers.h"

namespace sunload {

const char* const version = SUNLOAD_VERSION;
const char* const commit = SUNLOAD_COMMIT;

UnixTime now() { return static_cast<UnixTime>(std::time(nullptr)); }

}  // namespace sunload
