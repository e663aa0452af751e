// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the project and its program are. One source knows these paths, so that all others compile
/// to the same objects in every checkout.
#pragma once

#include <string>

namespace sunload::test {

std::string source_folder();  ///< of the project, without a slash at the end
std::string shared_folder();  ///< of large real models, beside the project; may be missing
std::string program_path();   ///< of the sunload that is tested

}  // namespace sunload::test
