// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/file_writing.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "io/base/machine.h"

namespace sunload {

int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

void throw_cannot_write(const std::string& path, int error_number) {
  std::string why = std::strerror(error_number);
  // The same number for bytes and for inodes.
  std::error_code missing;
  if (const std::filesystem::path folder = std::filesystem::path(path).parent_path();
      error_number == ENOSPC && std::filesystem::is_directory(folder, missing))
    if (const std::string problem = folder_problem(folder); !problem.empty()) why += ": " + problem;
  const std::string text = "cannot write " + path + ": " + why;
  if (error_number == ENOENT || error_number == ESTALE) throw VanishedError(text);
  throw MachineError(text);
}

}  // namespace sunload
