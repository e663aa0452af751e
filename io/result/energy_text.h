// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The energy ledger of a result in words.
#pragma once

#include <string>

#include "io/result/reader.h"

namespace sunload {

/// The energy ledger of the whole period [kWh]: in, out, residual with its standard error.
std::string energy_text(const ResultReader& result);

/// A line of `info`: a name, padded, and its text; nothing where there is no text.
std::string info_line(const char* name, const std::string& text);

}  // namespace sunload
