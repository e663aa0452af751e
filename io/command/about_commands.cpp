// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>

#include "io/base/exit_code.h"
#include "io/command/doctor.h"
#include "io/command/manual.h"
#include "io/command/sub_commands.h"
#include "io/study/material_table.h"

namespace sunload {

void add_materials(CommandLine& line) {
  struct Given {
    bool as_page = false, by_angle = false;
  };
  const auto given = std::make_shared<Given>();
  const Command command = line.command(
      "materials", "list the materials that studies may name without defining them", [given] {
        std::cout << (given->by_angle  ? angle_listing()
                      : given->as_page ? material_page()
                                       : material_listing());
        return exit_code::done;
      });
  const Option as_page =
      command.flag("--markdown", given->as_page, "as the page docs/materials.md");
  command.flag("--angles", given->by_angle, "what they reflect and let pass, by angle of incidence")
      .excludes(as_page);
}

void add_doctor(CommandLine& line) {
  line.command("doctor", "what this build has, what this machine gives, and a self-test of seconds",
               [] { return doctor(); })
      .examples("sunload doctor");
}

void add_manual(CommandLine& line) {
  const auto folder = std::make_shared<std::string>();
  const Command command =
      line.command("manual", "write pages of man and completions of shells", [&line, folder] {
        write_manual(*folder, line.words());
        return exit_code::done;
      });
  command.option("-o,--output", *folder, "folder for man1 and completion").required();
  command.examples("sunload manual -o manual && man -l manual/man1/sunload-run.1");
}

}  // namespace sunload
