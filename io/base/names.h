// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Names and other words of strangers' files as text that can be stored, printed and compared.
#pragma once

#include <string>
#include <string_view>

namespace sunload {

/// UTF-8 of bytes that may be something else: what is no character of UTF-8 (RFC 3629) is taken as
/// one of Windows-1252, which is Latin-1 with letters and signs in the place of its second set of
/// controls; bytes without a character there become U+FFFD. UTF-8 stays as it is.
std::string utf8_text(std::string_view bytes);

/// `utf8_text` with control characters (of the first and second set, and DEL) written out as
/// `\x1b`, but for line ends and tabs: nothing in it commands a terminal.
std::string without_controls(std::string_view bytes);

/// A name on one line: `without_controls`, line ends and tabs written out as well.
std::string clean_name(std::string_view bytes);

}  // namespace sunload
