// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/common_options.h"

namespace sunload {

void add_study(const Command& command, std::string& study) {
  command.option("STUDY", study, "study file (YAML)").read().required();
}

void add_place(const Command& command, RunOptions& options) {
  command.option("--variant", options.variants, "only these variants (repeatable)").repeatable();
  command.option("--output", options.output, "folder for results, replaces output.folder")
      .not_empty();
  command
      .option("--threads", options.threads,
              "threads (default: the processors this process may use)")
      .from_environment("SUNLOAD_THREADS")
      .within(1, 4096);
}

void add_result(const Command& command, std::string& result) {
  command.option("RESULT", result, "result file (.h5)").read().required().single();
}

void add_named(const Command& command, NamedParts& parts, const std::string& only,
               const std::string& only_facades) {
  command
      .option("--facade", parts.facades,
              (only_facades.empty() ? only : only_facades) +
                  " the facade of that name, or those of a pattern: 'house_3/*' "
                  "(repeatable)")
      .repeatable();
  command.option("--object", parts.objects, only + " the object of that name or pattern")
      .repeatable();
  command
      .option("--selection", parts.selections,
              only + " the study's selection of that name or pattern")
      .repeatable();
}

void add_band(const Command& command, std::string& band) {
  command
      .option("--band", band,
              "of a result with solver.bands: rgb: red, green or blue (default: their mean)")
      .completed_by({"red", "green", "blue"});
}

void add_period(const Command& command, PeriodChoice& period) {
  const auto add = [&](const char* option, std::string& words, const char* meaning) {
    return command.option(option, words, meaning)
        .under("Part of the period (civil time of the site; all that is given holds)");
  };
  add("--month", period.month, "totals of a month: 1 to 12, or 2026-06");
  add("--season", period.season, "of a season of the study, or spring, summer, autumn, winter")
      .completed_by({"spring", "summer", "autumn", "winter"});
  add("--day", period.day, "of a day: 2026-06-21");
  add("--hours", period.hours, "of hours of day: 8-12, from 8:00 to 12:00");
  add("--from", period.from, "from a date or time on: 2026-06-01, 2026-06-21T12:00");
  add(command.has("--to") ? "--until" : "--to,--until", period.to,
      "up to a date or time, exclusive");
}

}  // namespace sunload
