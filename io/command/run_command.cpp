// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/run_command.h"

#include "io/command/sub_commands.h"

namespace sunload {

int run_command(int argc, char** argv) {
  CommandLine line("sunload: how much sun and sky light falls on every patch of a city",
                   "Begin with:\n  sunload init MODEL            a study of a model\n"
                   "  sunload init --example street a study that comes with the program\n"
                   "Options of a command: sunload COMMAND --help");
  for (const auto add : {add_init, add_check, add_run, add_merge, add_sun, add_sky, add_horizon,
                         add_info, add_compare, add_explain, add_render, add_view, add_export,
                         add_scene, add_materials, add_doctor, add_manual})
    add(line);
  return line.run(argc, argv);
}

}  // namespace sunload
