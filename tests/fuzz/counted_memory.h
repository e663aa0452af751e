// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Every `new` of an executable that links counted_memory.cpp: none may be for more than a file
/// of less than 1 MB may make a reader ask for.
#pragma once

#include <cstddef>

namespace sunload::fuzz {

/// Requests for more throw std::bad_alloc, which no reader may let out.
inline constexpr std::size_t most_bytes = 1'000'000'000;

}  // namespace sunload::fuzz
