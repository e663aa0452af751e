// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tests/support/program.h"
#include "tests/support/small_study.h"

namespace sunload::test {

/// A folder with the square of tests/support/small_study.h and a study of it.
struct SquareFolder {
  WorkFolder folder;
  explicit SquareFolder(const std::string& study = square_study()) {
    folder.write("square.obj", square_obj);
    write_study(study);
  }
  void write_study(const std::string& study) const { folder.write("square.yaml", study); }
  /// `sunload run square.yaml --output OUTPUT MORE…`
  Ran run(const std::string& output, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"run", "square.yaml", "--output", output});
    return program(folder, more);
  }
  std::string result(const std::string& output, const std::string& variant = "baseline") const {
    return folder / (output + "/square/" + variant + ".h5");
  }
};

}  // namespace sunload::test
