// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Standard output and error: the only file that writes to them by their numbers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sunload {

/// Opens descriptors 0, 1 and 2 on the null device where they are closed, or the next file that is
/// opened would get their numbers and messages would be written into it. Listings cannot be
/// written there, which is told at the end; messages are swallowed. May be called before anything
/// else of the program has been set up.
void open_closed_streams();

/// Writes a message and the end of its line to the standard error. Control characters but tabs and
/// line ends become visible (`\x1b`), so that names cannot command a terminal. Where it cannot be
/// written it is lost: that is no failure of the work.
void tell(std::string_view message);

/// Tells each of them on a line of its own after "warning: ", and after the name of what they are
/// of where one is given.
void tell_warnings(const std::vector<std::string>& warnings, std::string_view of = {});

/// A message without a line's end and with its control characters: for drawings of our own.
void tell_as_it_is(std::string_view text);

/// Ends the program as who reads its output has closed it, without a word: the end that every
/// filter comes to.
void end_by_closed_pipe();

/// From here on std::cout is this program's own stream: it keeps the first error of writing, and on
/// a terminal control characters are made visible.
void open_listing();

/// What std::cout got has left the program, or MachineError tells why it could not.
void finish_listing();

}  // namespace sunload
