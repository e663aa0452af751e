// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Animated PNG from PNG pictures of one size.
/// W3C (2025), Portable Network Graphics, third edition, 11.3.6 and 4.9.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>

#include "io/base/file_aside.h"

namespace sunload {

/// Pictures are added in their order; the file appears at `finish`. Readers that know no animation
/// show the first. Throws MachineError where it cannot be written.
class AnimatedPng {
 public:
  AnimatedPng(const std::string& path, std::size_t pictures, int milliseconds_each);
  void add(const std::string& png);
  void finish();

 private:
  void chunk(const std::string& type, const std::string& data);
  void frame_control(const std::string& header);

  std::string path_;
  FileAside file_;
  std::ofstream stream_;
  std::size_t pictures_, added_ = 0;
  std::uint32_t sequence_ = 0;
  int milliseconds_;
};

}  // namespace sunload
