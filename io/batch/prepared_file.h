// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What does not depend on the batch, kept beside the batches: the traced lines.
///
/// Shards and ranks read them instead of tracing again. The file is checked by
/// content hash, length and checksum, safe to delete, rebuilt if missing; the
/// numbers are the same bits either way.
#pragma once

#include <optional>
#include <string>

#include "solver/lines/lines.h"

namespace sunload {

/// Written aside and renamed. Throws MachineError.
void write_prepared(const std::string& path, const std::string& content_hash, const Lines& lines);

/// None where the file is missing, of another hash, or damaged.
std::optional<Lines> read_prepared(const std::string& path, const std::string& content_hash);

}  // namespace sunload
