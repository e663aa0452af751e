// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Files packed by gzip, told by their content.
#pragma once

#include <cstddef>
#include <string>

namespace sunload {

inline constexpr std::size_t largest_unpacked_bytes = 2'000'000'000;  ///< as for plain scene files

bool is_gzip(const std::string& bytes);

/// The content of all members of a gzip file (RFC 1952), at most `largest_bytes`.
/// Throws InputError naming `path` where the file is damaged or holds more.
std::string unpack_gzip(const std::string& bytes, const std::string& path,
                        std::size_t largest_bytes = largest_unpacked_bytes);

}  // namespace sunload
