// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What becomes of the light of a place, as a waterfall (`sunload explain -o`).
#pragma once

#include <string>

#include "io/explain/explanation.h"

namespace sunload {

/// A row for each of the table's, from what the place would have in the open to what it has. An
/// object's bars begin where those before it ended: to the left what it takes, below it to the
/// right what it gives, in the colours of the ways of light; objects of little weight are one row.
/// Of a difference the rows begin at nothing. Whiskers and numbers have standard errors. Throws
/// MachineError where it cannot be written.
void draw_waterfall(const Explanation& explanation, const std::string& path);

}  // namespace sunload
