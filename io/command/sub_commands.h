// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// All commands: each function adds one to the command line, with its options and examples.
#pragma once

#include "io/command/command_line.h"

namespace sunload {

// Studies: study_commands.cpp
void add_init(CommandLine& line);
void add_check(CommandLine& line);
void add_run(CommandLine& line);
void add_merge(CommandLine& line);
void add_scene(CommandLine& line);

// The site of a study: site_commands.cpp
void add_sun(CommandLine& line);
void add_sky(CommandLine& line);
void add_horizon(CommandLine& line);

// Results in words and numbers: result_commands.cpp
void add_info(CommandLine& line);
void add_compare(CommandLine& line);
void add_explain(CommandLine& line);

// Results for the eye and for other programs: picture_commands.cpp
void add_render(CommandLine& line);
void add_view(CommandLine& line);
void add_export(CommandLine& line);

// The program itself: about_commands.cpp
void add_materials(CommandLine& line);
void add_doctor(CommandLine& line);
void add_manual(CommandLine& line);

}  // namespace sunload
