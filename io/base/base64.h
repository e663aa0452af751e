// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Base64 (RFC 4648): how bytes travel in a page.
#pragma once

#include <span>
#include <string>

namespace sunload {

std::string base64(std::span<const unsigned char> bytes);

}  // namespace sunload
