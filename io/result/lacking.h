// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What is told of results that are not whole.
#pragma once

#include "io/result/reader.h"

namespace sunload {

/// Warns of a result that was merged before all of it was computed.
void warn_of_lacking(const ResultReader& result);

}  // namespace sunload
