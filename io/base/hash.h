// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// SHA-256 (OpenSSL) of texts and files.
#pragma once

#include <string>

namespace sunload {

/// Lower-case hexadecimal SHA-256.
std::string sha256(const std::string& bytes);
/// Of a file's bytes; throws InputError where it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace sunload
