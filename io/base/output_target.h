// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the name of an output stands for: a file that may be replaced, or something that must stay.
#pragma once

#include <string>
#include <vector>

#include "geo/base/check.h"

namespace sunload {

/// Where an output goes, links followed.
struct OutputTarget {
  /// What stands under the name.
  enum class Kind {
    file,        ///< a regular file, there or not: may be replaced
    special,     ///< a device, pipe or socket: is written into
    descriptor,  ///< a file that this process has open (/dev/stdout, /dev/fd/N): is written on
  } kind = Kind::file;
  std::string path;     ///< at the end of all links
  int descriptor = -1;  ///< of `descriptor`
};

/// `-` is the standard output. Throws MachineError for folders and for links that lead round.
OutputTarget output_target(const std::string& path);

/// Copies the bytes of a file into a target that stays; where that is the standard output and
/// nobody reads it any more, the program ends (`end_by_closed_pipe`), the file's folder removed.
/// Throws MachineError that names `path`.
void write_into(const OutputTarget& target, const std::string& from, const std::string& path);

/// Throws InputError where the output is one of the files that are read, by whatever name: it would
/// be destroyed. Empty names and names of nothing are no files. `written_with`: what the user asked
/// for, where the output is a file that goes with it.
void expect_not_read(const std::string& output, const std::vector<std::string>& inputs,
                     const std::string& written_with = {});

}  // namespace sunload
