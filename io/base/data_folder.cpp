// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/data_folder.h"

#include <filesystem>

namespace sunload {

std::string data_folder() {
  namespace fs = std::filesystem;
  std::error_code unknown;
  fs::path folder = fs::read_symlink("/proc/self/exe", unknown).parent_path();
  // From PREFIX/bin, or from build/io of the sources, upward.
  for (; !folder.empty(); folder = folder.parent_path()) {
    for (const fs::path& place : {folder / "share" / "sunload", folder})
      if (fs::exists(place / "configs" / "study.schema.json", unknown)) return place.string();
    if (folder == folder.parent_path()) break;
  }
  return {};
}

}  // namespace sunload
