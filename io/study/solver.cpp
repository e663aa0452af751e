// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sections `solver` and `output` of a study, and what later versions will read.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "io/study/sections.h"
#include "io/study/words.h"
#include "solver/base/random_blocks.h"
#include "solver/light/sun_samples.h"

namespace sunload::study_sections {

namespace {

constexpr int most_lines = 1'000'000, most_realizations = 1024;
constexpr int most_batch_suns = 65536;
constexpr int fewest_realizations = 2;  // one has no spread
constexpr int strongest_compression = 9;
constexpr Range watts{0, 1e12, Range::Low::excluded};
constexpr Range relative_errors{1e-4, 1};  // below, no number of lines would do

/// Each realization gets its equal share.
void check_shares(YamlMap& map, const std::string& key, int count, int realizations) {
  if (count % realizations == 0) return;
  const int below = count / realizations * realizations, above = below + realizations;
  const std::string near =
      below > 0 ? fmt::format("{} or {}", below, above) : std::to_string(above);
  map.problem(key, fmt::format("{} cannot be shared by {} realizations", count, realizations),
              "each gets the same number", "write " + near);
}

std::vector<std::string> read_series(YamlMap& map, std::vector<std::string> absent) {
  const std::vector<std::string> known = absent;
  if (!map.has("series")) {
    map.tree("series");
    return absent;
  }
  std::vector<std::string> series;
  if (map.kind("series") == YamlNode::Kind::text) {
    map.word("series", {"none"}, "none");
    return series;
  }
  for (const auto& [text, where] : map.texts("series")) {
    if (std::find(known.begin(), known.end(), text) == known.end()) {
      map.reading().problem(where, "output.series: '" + text + "' is not known",
                            fmt::format("{}", fmt::join(known, ", ")));
    } else if (std::find(series.begin(), series.end(), text) != series.end()) {
      map.reading().problem(where, "output.series: '" + text + "' is written twice");
    } else {
      series.push_back(text);
    }
  }
  return series;
}

/// Absent: auto.
std::optional<std::vector<PartKind>> read_totals(YamlMap& map) {
  const std::string key = "totals";
  if (!map.has(key)) {
    map.tree(key);
    return {};
  }
  std::vector<PartKind> kinds;
  if (map.kind(key) == YamlNode::Kind::text) {
    if (map.word(key, {"auto", "none"}, "auto") == "auto") return {};
    return kinds;
  }
  for (const auto& [text, where] : map.texts(key)) {
    const auto name = std::find(part_kind_names.begin(), part_kind_names.end(), text);
    const auto kind = static_cast<PartKind>(name - part_kind_names.begin());
    if (name == part_kind_names.end()) {
      map.reading().problem(where, "output.totals: '" + text + "' is not known",
                            fmt::format("{}, or auto or none in place of the list",
                                        fmt::join(part_kind_names, ", ")));
    } else if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) {
      map.reading().problem(where, "output.totals: '" + text + "' is written twice");
    } else {
      kinds.push_back(kind);
    }
  }
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

/// Gathering has no samples of power.
void read_shooting(YamlMap& map, SolverStudy& solver) {
  solver.jacobi = map.choice("jacobi", solver.jacobi);
  const std::string key = "power_per_sample_w";
  if (map.kind(key) != YamlNode::Kind::text || map.text(key, "") != "auto")
    solver.power_per_sample_w = map.number(key, watts);
  if (solver.transport == Transport::shoot) return;  // gathering and the matrix have no samples
  for (const std::string& unused : {std::string("jacobi"), key})
    if (map.has(unused)) map.warn(unused, "is not used", "it belongs to transport: shoot");
}

}  // namespace

namespace {

/// `accuracy` and the most that it may raise the counts to.
void read_accuracy(YamlMap& map, SolverStudy& solver) {
  const bool describe = map.reading().purpose == YamlReading::Purpose::describe;
  map.tree("accuracy");
  if (map.has("accuracy") && solver.transport == Transport::matrix)
    map.problem("accuracy", "cannot go with transport: matrix",
                "no pilot tells how many lines its first light needs",
                "write lines_per_patch and direct_samples, or transport: gather");
  if (map.has("accuracy") || describe) {
    map.section("accuracy", [&](YamlMap& section) {
      solver.accuracy = {section.number("light_load_relative", relative_errors),
                         section.number("irradiance_relative", relative_errors)};
      if (!section.has("irradiance_relative"))
        section.require("light_load_relative", "an accuracy has a goal",
                        "write it, or irradiance_relative");
    });
  }
  solver.max_lines_per_patch =
      map.integer("max_lines_per_patch", 1, most_lines, solver.max_lines_per_patch);
  if (map.has("max_lines_per_patch") && !solver.accuracy)
    map.warn("max_lines_per_patch", "is not used", "it belongs to accuracy");
  const int least = std::max(solver.lines_per_patch, solver.direct_samples);
  if (solver.accuracy && solver.max_lines_per_patch < least)
    map.problem("max_lines_per_patch",
                fmt::format("{} is below the least counts", solver.max_lines_per_patch),
                fmt::format("lines_per_patch and direct_samples ask for up to {}", least));
}

/// What other transports do not have.
void expect_gathering(YamlMap& map, const SolverStudy& solver) {
  if (solver.bands == Bands::rgb && solver.transport != Transport::gather)
    map.problem("bands", "rgb cannot go with transport: " + word_of(solver.transport),
                "bands share the lines of gathering", "write transport: gather");
  if (solver.year == Year::modes && solver.transport != Transport::gather)
    map.problem("year", "modes cannot go with transport: " + word_of(solver.transport),
                "they share solutions of light that is gathered",
                "write auto or each, or leave it out");
}

/// Absent: auto.
std::optional<int> read_number_or_auto(YamlMap& map, const std::string& key, int most,
                                       std::optional<int> otherwise) {
  if (map.kind(key) == YamlNode::Kind::text && map.text(key, "") == "auto") return {};
  const int number = map.integer(key, 1, most, otherwise.value_or(1));
  return map.has(key) ? std::optional(number) : otherwise;
}

}  // namespace

SolverStudy read_solver(YamlMap& map) {
  SolverStudy solver;
  solver.transport = map.choice("transport", solver.transport);
  read_shooting(map, solver);
  solver.bounces = map.integer("bounces", 0, most_reflections, solver.bounces);
  solver.unshot = map.number("unshot", shares, solver.unshot);
  solver.unfollowed = map.choice("unfollowed", solver.unfollowed);
  solver.year = map.choice("year", solver.year);
  solver.short_intervals = map.choice("short_intervals", solver.short_intervals);
  solver.lines_per_patch = map.integer("lines_per_patch", 1, most_lines, solver.lines_per_patch);
  solver.direct_samples = map.integer("direct_samples", 1, most_lines, solver.direct_samples);
  solver.sun_samples_per_interval =
      read_number_or_auto(map, "sun_samples_per_interval", static_cast<int>(most_sun_samples), 1);
  const int unread = map.has("realizations") ? 0 : solver.realizations;
  const int realizations =
      map.integer("realizations", fewest_realizations, most_realizations, unread);
  solver.mirror_depth = map.integer("mirror_depth", 0, most_reflections, solver.mirror_depth);
  solver.bands = map.choice("bands", solver.bands);
  expect_gathering(map, solver);
  solver.batch_suns = read_number_or_auto(map, "batch_suns", most_batch_suns, {});
  solver.isa = map.word("isa", {"auto", "sse4.2", "avx2", "avx512"}, solver.isa);
  const auto seed = map.integer("seed", std::int64_t{0}, std::numeric_limits<std::int64_t>::max(),
                                static_cast<std::int64_t>(solver.seed));
  solver.seed = static_cast<std::uint64_t>(seed);
  read_accuracy(map, solver);
  if (realizations > 0) {
    solver.realizations = realizations;
    check_shares(map, "lines_per_patch", solver.lines_per_patch, realizations);
    check_shares(map, "direct_samples", solver.direct_samples, realizations);
  }
  return solver;
}

namespace {

/// none: auto; absent: off, all of them.
std::optional<int> read_significant_bits(YamlMap& map) {
  const std::string key = "significant_bits";
  const bool is_word = map.kind(key) == YamlNode::Kind::text;
  const std::string word = is_word ? map.text(key, "") : "";
  if (word == "auto") return {};
  if (word == "off") return float_mantissa_bits;
  return map.integer(key, 1, float_mantissa_bits, float_mantissa_bits);
}

}  // namespace

namespace {

/// "60 min": its number; none of other texts.
std::optional<int> minutes_of(const std::string& text) {
  constexpr std::string_view unit = " min";
  constexpr std::size_t most_digits = 4;
  if (!text.ends_with(unit)) return {};
  const std::string digits = text.substr(0, text.size() - unit.size());
  const bool is_number =
      !digits.empty() && digits.size() <= most_digits && digits.front() != '0' &&
      std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  return is_number ? std::optional(std::stoi(digits)) : std::nullopt;
}

SeriesStepStudy read_series_step(YamlMap& map) {
  using Unit = SeriesStepStudy::Unit;
  constexpr int minutes_of_day = 1440;
  const std::string key = "series_step";
  SeriesStepStudy step;
  step.where = map.where(key);
  const std::string text = map.text(key, "interval");
  if (text == "interval") return step;
  if (text == "day" || text == "month") {
    step.unit = text == "day" ? Unit::day : Unit::month;
    return step;
  }
  const auto minutes = minutes_of(text);
  if (!minutes) {
    map.reading().problem(step.where, "output.series_step: '" + text + "' is not known", "",
                          "write interval, day, month or minutes as 60 min");
    return step;
  }
  if (*minutes >= minutes_of_day || minutes_of_day % *minutes != 0) {
    map.reading().problem(step.where, "output.series_step: " + text + " does not divide a day",
                          "steps begin at midnight",
                          *minutes >= minutes_of_day ? "write day, month, or 60 min"
                                                     : "write 15 min, 30 min, 60 min or 120 min");
    return step;
  }
  step.unit = Unit::minutes;
  step.minutes = *minutes;
  return step;
}

}  // namespace

OutputStudy read_output(YamlMap& map) {
  OutputStudy output;
  output.folder = map.text("folder", output.folder);
  if (output.folder.starts_with('~'))
    map.problem("folder", "'" + output.folder + "' begins with ~",
                "a shell takes that for the home folder, a study for a folder of that name",
                "write the path in full, or ./" + output.folder);
  output.series = read_series(map, output.series);
  output.standard_error = map.choice("standard_error", output.standard_error);
  output.compression = map.integer("compression", 0, strongest_compression, output.compression);
  output.totals = read_totals(map);
  output.totals_where = map.where("totals");
  output.series_step = read_series_step(map);
  if (!output.series_step.is_interval() && output.standard_error == StandardErrors::instants)
    map.problem("series_step", "cannot go with standard_error: instants",
                "suns share lines: errors of a step do not follow from those of its instants",
                "write standard_error: totals (totals: [month] and [day] have errors of their "
                "own), or series_step: interval");
  output.significant_bits = read_significant_bits(map);
  return output;
}

std::vector<LaterKey> later_keys() { return {}; }

}  // namespace sunload::study_sections
