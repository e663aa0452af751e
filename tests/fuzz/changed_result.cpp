// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/changed_result.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <stdexcept>

#include "geo/base/check.h"
#include "io/export/export.h"
#include "io/picture/render.h"
#include "io/report/compare.h"
#include "io/report/info.h"
#include "io/report/measures.h"
#include "io/result/patches_csv.h"
#include "io/result/reader.h"
#include "io/run/run.h"
#include "io/scene/cityjson/write.h"
#include "io/scene/file.h"
#include "io/view/data.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/small_study.h"

namespace sunload::fuzz {
namespace {

namespace fs = std::filesystem;
using test::ResultPlace;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr std::array numbers{-1.0,         0.0,   std::numeric_limits<double>::quiet_NaN(),
                             2147483647.0, inf,   -2147483648.0,
                             1.0,          1e308, -inf,
                             -1e308,       7.0,   1e30,
                             1e-300,       -1e20, 100000.0,
                             0.5,          1e9,   -0.0};
const std::vector<std::string>& texts() {
  static const std::vector<std::string> all{"",
                                            "x",
                                            "\xff\xfe",
                                            "Europe/Nowhere",
                                            "EPSG:999999",
                                            "\xff\xfe",
                                            "a\x1b[31m,\"<script>\n{",
                                            "[1",
                                            "illuminance",
                                            "+26:00",
                                            "nan",
                                            "kWh m-2",
                                            std::string(5000, 'n')};
  return all;
}

std::string computed(const std::string& name, const std::string& study) {
  const std::string path = file_of(study, name + ".yaml");
  RunOptions options;
  options.output = (fs::path(path).parent_path() / name).string();
  options.progress = ProgressStyle::none;
  options.threads = 1;
  if (run_study(path, options) != 0) throw std::logic_error("the valid result");
  return (fs::path(options.output) / "square" / "baseline.h5").string();
}

/// The square's study with sensors, of two intervals with much light and one in the dark.
std::string study_text(const std::string& scene, const std::string& solver,
                       const std::string& errors) {
  std::string text = test::square_study(errors, solver, "20") +
                     "sensors: {points: [{position_m: [0, 0, 1], normal: [0, 0, 1]},"
                     " {position_m: [1, 0, 1], normal: [0, 1, 0]}]}\n";
  const auto put = [&](const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the study of the valid result: " + from);
    text.replace(at, from.size(), to);
  };
  put("from: \"06:00\", to: \"18:00\", step_min: 60",
      "from: \"00:00\", to: \"24:00\", step_min: 480");
  put("square.obj", scene);
  put("lines_per_patch: 64, direct_samples: 16, realizations: 16",
      "lines_per_patch: 8, direct_samples: 4, realizations: 2");
  return text;
}

/// What one command does may be refused; anything else that it throws is a fault.
bool works(const std::function<void()>& action) {
  try {
    action();
    return true;
  } catch (const InputError& error) {
    if (error.problems().empty()) throw std::logic_error("a refusal without a reason");
    return false;
  }
}

std::vector<std::size_t> other_size(const ResultPlace& place, const ChangeAt& at) {
  auto shape = place.shape;
  if (shape.empty()) return {at.value % 3};
  std::size_t& size = shape[at.element % shape.size()];
  const std::array<std::size_t, 4> sizes{size + 1, size > 0 ? size - 1 : 2, 0, 2 * size + 3};
  size = sizes[at.value % sizes.size()];
  return shape;
}

std::vector<std::size_t> other_rank(const ResultPlace& place, const ChangeAt& at) {
  auto shape = place.shape;
  if (at.value % 2 == 0 || shape.empty())
    shape.push_back(1);
  else
    shape.pop_back();
  return shape;
}

template <class Value>
void set_value(const test::ChangedResult& file, const ResultPlace& place, const ChangeAt& at,
               const Value& value) {
  if (at.change == ResultChange::all_values)
    file.set(place, value);
  else
    file.set(place, value, at.element);
}

void apply(const test::ChangedResult& file, const ResultPlace& place, ChangeAt at) {
  // Attributes have values, and no shape of ours.
  if (!place.attribute.empty() && at.change != ResultChange::removal)
    at.change = ResultChange::one_value;
  switch (at.change) {
    case ResultChange::one_value:
    case ResultChange::all_values:
      if (place.is_text)
        set_value(file, place, at, texts()[at.value % texts().size()]);
      else
        set_value(file, place, at, numbers[at.value % numbers.size()]);
      return;
    case ResultChange::size:
      return file.reshape(place, other_size(place, at));
    case ResultChange::rank:
      return file.reshape(place, other_rank(place, at));
    case ResultChange::type:
      return file.retype(place);
    case ResultChange::removal:
      return file.remove(place);
  }
}

}  // namespace

const std::string& valid_model() {
  static const std::string path = [] {
    const std::string model = file_of("", "square.city.json");
    write_cityjson(read_scene_file(file_of(test::square_obj, "square.obj"), {}), model);
    return model;
  }();
  return path;
}

const std::string& valid_result(Valid which) {
  if (which == Valid::broadband) {
    static const std::string path = [] {
      file_of(test::square_obj, "square.obj");
      return computed("broadband", study_text("square.obj", "", "instants"));
    }();
    return path;
  }
  static const std::string path = [] {
    valid_model();
    return computed("bands", study_text("square.city.json", ", bands: rgb", "totals"));
  }();
  return path;
}

const std::vector<ResultPlace>& places_of(Valid which) {
  const auto read_places = [](const std::string& path) {
    auto places = test::places_of(path);
    // Of attributes of datasets only the unit is read, and the rest is for other programs.
    std::erase_if(places, [](const ResultPlace& place) {
      return !place.dataset.empty() && !place.attribute.empty() && place.attribute != "units" &&
             !place.attribute.starts_with("time_");
    });
    return places;
  };
  static const std::array places{read_places(valid_result(Valid::broadband)),
                                 read_places(valid_result(Valid::bands))};
  return places[static_cast<std::size_t>(which)];
}

std::size_t changed_values(const ResultPlace& place) {
  return place.is_text ? texts().size() : numbers.size();
}

std::string changed_result(Valid which, const std::vector<ChangeAt>& changes) {
  const std::string path = file_of("", "changed.h5");
  fs::copy_file(valid_result(which), path, fs::copy_options::overwrite_existing);
  const auto& of_file = places_of(which);
  std::vector<char> is_changed(of_file.size(), 0);
  const test::ChangedResult file(path);
  for (const ChangeAt& at : changes) {
    const std::size_t place = at.place % of_file.size();
    if (is_changed[place]) continue;  // its shape may be another one by now
    for (std::size_t p = 0; p < of_file.size(); ++p)
      if (of_file[p].dataset == of_file[place].dataset) is_changed[p] = 1;
    apply(file, of_file[place], at);
  }
  return path;
}

void tables(const ResultReader& result, TableOf of) {
  const GroupTable table = group_table(result, of, {});
  group_table_csv(table);
  group_table_text(result, table);
  group_table_json(result, table);
}

std::size_t read_by_all(const std::string& path, Valid which) {
  const ResultReader result(path), base(valid_result(which));
  std::vector<std::function<void()>> commands{[&] { info_text(result); },
                                              [&] { patches_csv(result); },
                                              [&] { tables(result, TableOf::facades); },
                                              [&] { tables(result, TableOf::objects); },
                                              [&] { tables(result, TableOf::sensors); },
                                              [&] {
                                                ViewBlocks blocks;
                                                view_data(result, 1, blocks);
                                              }};
  for (const auto& [a, b] : {std::pair(&base, &result), {&result, &base}})
    commands.emplace_back([a = a, b = b] {
      Comparison comparison = compare_results(*a, *b);
      comparison.measures = measure_changes(verdicts_of_both(*a, *b), {});
      comparison_table(comparison);
      comparison_csv(comparison);
      comparison_json(comparison);
      write_comparison_hdf5(comparison, *a, *b, file_of("", "comparison.h5"));
    });
  commands.emplace_back([&] {
    for (const auto& measure : measure_names(result))
      write_comparison_hdf5(compare_results(base, result, {.dataset = "measure_" + measure}), base,
                            result, file_of("", "comparison.h5"));
  });
  const auto exports = [&](const ExportRules& rules) {
    commands.emplace_back(
        [&result, rules] { export_result(result, rules, file_of("", "exported")); });
  };
  const std::string series =
      result.quantity() == Quantity::illuminance ? "illuminance" : "irradiance";
  for (const char* format :
       {"csv", "vtk", "glb", "vrml", "ply", "cityjson", "gpkg", "energyplus", "xdmf"}) {
    ExportRules rules;
    rules.format = format;
    exports(rules);
    rules.quantity = series;
    exports(rules);
  }
  for (const char* format : {"glb", "vrml"}) {
    ExportRules rules;
    rules.format = format;
    rules.interpolate = true;
    exports(rules);
  }
  ExportRules rules;
  rules.format = "csv";
  rules.quantity = "series";
  exports(rules);
  rules = {};
  rules.format = "cityjson";
  rules.model = valid_model();
  exports(rules);
  RenderRules picture;
  picture.width = 320;
  picture.height = 320;
  commands.emplace_back([&result, picture] { render_png(result, picture, file_of("", "p.png")); });
  picture.view = View::sun;
  picture.quantity = series;
  picture.interpolate = true;
  commands.emplace_back([&result, picture] { render_png(result, picture, file_of("", "p.png")); });
  std::size_t working = 0;
  for (const auto& command : commands) working += works(command) ? 1u : 0u;
  return working;
}

}  // namespace sunload::fuzz
