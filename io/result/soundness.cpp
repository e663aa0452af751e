// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/soundness.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geo/base/check.h"
#include "geo/base/coordinates.h"
#include "geo/base/units.h"
#include "geo/mesh/mesh.h"
#include "geo/time/time.h"
#include "io/result/schema.h"
#include "solver/light/band.h"

namespace sunload {
namespace {

constexpr std::size_t coordinates = 3;
// Unit vectors as doubles are unit to 1e-15; as floats, which another program may have made of
// them, to 1e-7.
constexpr double unit_tolerance = 1e-6;
// What is placed at the largest coordinate reaches beyond it.
constexpr double farthest_m = 2 * largest_coordinate_m;
// Years 1 … 9999, by the clock of any zone.
constexpr UnixTime first_time = -62135596800 - seconds_per_day,
                   last_time = 253402300799 + seconds_per_day;

/// Where indices point to: entries of a dimension, or one of so many flags.
struct Pointer {
  const char* dataset;
  const char* into;  ///< dimension; empty: flags
  std::size_t flags = 0;
  bool may_be_none = false;  ///< -1
};
constexpr std::array pointers{
    Pointer{"patch_vertices", "vertex"},
    Pointer{"input_triangle_vertices", "vertex"},
    Pointer{"patch_object", "object"},
    Pointer{"patch_facade", "facade", 0, true},
    Pointer{"patch_material", "material", 0, true},
    Pointer{"patch_input_triangle", "input_triangle"},
    Pointer{"patch_surface", "", surface_names.size()},
    Pointer{"patch_side", "", 2},
    Pointer{"patch_selected", "", 2},
};

/// What all values of a dataset must be.
struct Range {
  const char* dataset;
  double least, largest;
  const char* words;
};
constexpr Range positions_in(const char* dataset) {
  return {dataset, -farthest_m, farthest_m, "no position"};
}
// Energy that the sun does not have: a series that float holds.
constexpr double largest_irradiance = 1e30;
constexpr std::array ranges{
    positions_in("vertex_position"),
    positions_in("patch_centroid"),
    positions_in("sensor_position"),
    Range{"patch_area", 1e-300, farthest_m* farthest_m, "no area"},
    Range{"facade_area", 0, farthest_m* farthest_m, "no area"},
    Range{"selection_area", 0, farthest_m* farthest_m, "no area"},
    Range{"facade_azimuth", -360, 360, "no azimuth"},
    Range{"time", first_time, last_time, "no time of the years 1 … 9999"},
    Range{"time_bounds", first_time, last_time, "no time of the years 1 … 9999"},
    Range{"sun_azimuth", -360, 360, "no azimuth"},
    Range{"sun_elevation", -90, 90, "no elevation"},
    Range{"dni", 0, largest_irradiance, "no irradiance"},
    Range{"dhi", 0, largest_irradiance, "no irradiance"},
    Range{"ghi", 0, largest_irradiance, "no irradiance"},
    Range{"direct_normal_illuminance", 0, largest_irradiance, "no illuminance"},
    Range{"diffuse_horizontal_illuminance", 0, largest_irradiance, "no illuminance"},
    Range{"global_horizontal_illuminance", 0, largest_irradiance, "no illuminance"},
};

/// Names as labels of their dimension: `band`, `facade` … Results made before there were labels
/// have a scale without values in their place.
bool is_label(const ResultVariable& variable) {
  return is_coordinate_of_itself(variable) && variable.type == h5::Type::text;
}

/// Whether no command does without it: times, sun and patches, but not what only some studies have.
bool is_indispensable(const ResultVariable& variable) {
  const bool is_of_all_results = variable.part == ResultPart::coordinate ||
                                 variable.part == ResultPart::geometry ||
                                 variable.part == ResultPart::sun;
  return is_of_all_results && !is_label(variable) && variable.name != "mesh" &&
         variable.name != "study_seasons" && !variable.name.starts_with("vertex_x") &&
         !variable.name.starts_with("vertex_y") && !variable.name.starts_with("vertex_z") &&
         !variable.name.starts_with("sensor_") && !variable.dims.starts_with("selection") &&
         !variable.name.ends_with("_illuminance");
}

/// Whether what is derived from a result has it, too: geometry and names of the base's patches.
bool is_of_derived_patches(const ResultVariable& variable) {
  const bool is_of_patches = variable.dims.starts_with("patch") || variable.dims == "vertex,xyz";
  return (is_of_patches && is_indispensable(variable) && variable.name != "patch_input_triangle") ||
         variable.name == "object_name" || variable.name == "material_name";
}

h5::ValueKind kind_of(const ResultVariable& variable) {
  switch (variable.type) {
    case h5::Type::text:
      return h5::ValueKind::text;
    case h5::Type::float32:
    case h5::Type::float64:
      return h5::ValueKind::real;
    default:
      return h5::ValueKind::integer;
  }
}

std::string size_words(const std::vector<std::size_t>& shape) {
  return shape.empty() ? "one value" : fmt::format("{}", fmt::join(shape, " × "));
}

/// One file, dataset by dataset; problems are gathered.
class Examination {
 public:
  Examination(const std::string& path, const h5::File& file) : path_(path), file_(file) {
    quantity_ = file.text("quantity").value_or("") == "illuminance" ? Quantity::illuminance
                                                                    : Quantity::irradiance;
    is_rgb_ = file.has("band");
    const auto format = file.text("sunload_format").value_or("");
    if (format == comparison_format)
      derived_ =
          comparison_schema(quantity_, file.text("compared").value_or(std::string(usual_compared)));
    if (format == place_map_format) derived_ = place_map_schema(quantity_);
  }

  void shapes() {
    for (const auto& variable : result_schema(quantity_)) {
      const std::string name(variable.name);
      if (file_.has(name) && is_bare_scale(variable)) continue;
      if (file_.has(name))
        shape(variable, file_.dataset(name));
      else if (is_derived() ? is_of_derived_patches(variable) : is_indispensable(variable))
        add("there is no dataset " + name, "every result has one");
    }
    for (const std::string& name : file_.names()) {
      const ResultVariable* of = find_result_variable(name, quantity_);
      if (!of || of->name == name || is_derived()) continue;
      ResultVariable measure = *of;
      measure.name = name;
      if (name.ends_with(measure_spans_end)) measure.type = h5::Type::text;
      shape(measure, file_.dataset(name));
    }
    for (const auto& variable : derived_) {
      const std::string name(variable.name);
      if (file_.has(name))
        shape(variable, file_.dataset(name));
      else if (variable.dims == "patch")
        add("there is no dataset " + name, "every file of its format has one");
    }
  }

  void values() {
    for (const Pointer& pointer : pointers) indices(pointer);
    for (const Range& range : ranges) numbers(range);
    for (const char* name : {"patch_normal", "sensor_normal", "sun_direction"}) units(name);
    times();
  }

  void attributes() {
    if (const auto origin = file_.numbers("origin")) {
      const bool is_point = origin->size() == coordinates &&
                            std::all_of(origin->begin(), origin->end(),
                                        [](double c) { return std::abs(c) <= farthest_m; });
      if (!is_point) add("the attribute origin is no position", "three numbers in metres");
    }
    try {
      if (const auto zone = file_.text("timezone"); zone && !zone->empty()) TimeZone{*zone};
    } catch (const InputError& error) {
      add("the attribute timezone is no time zone", error.what());
    }
    for (const auto& [name, largest] : {std::pair{"latitude_deg", 90.0},
                                        {"longitude_deg", 360.0},
                                        {"north_deg", 360.0},
                                        {"elevation_m", farthest_m}})
      if (const auto values = file_.numbers(name);
          values && !(values->size() == 1 && std::abs(values->front()) <= largest))
        add(fmt::format("the attribute {} is {}", name, fmt::join(*values, ", ")),
            fmt::format("it lies within ±{}", largest));
  }

  void throw_if_any() const { problems_.throw_if_any(); }

 private:
  bool is_derived() const { return !derived_.empty(); }

  void add(const std::string& what, const std::string& why) {
    problems_.add({path_}, what, why, "another program has changed it: run the study again");
  }

  bool is_bare_scale(const ResultVariable& variable) const {
    return is_label(variable) && variable.name != "band" &&
           file_.dataset(std::string(variable.name)).kind() == h5::ValueKind::real;
  }

  std::vector<std::vector<std::string>> allowed_dims(const ResultVariable& variable) const {
    const auto banded = [&](const std::vector<std::string>& dims) {
      return is_rgb_ && has_bands(variable) ? with_band(dims) : dims;
    };
    const auto dims = banded(dimension_names(variable));
    // Standard errors of the ledger: of the time sum, or of every instant.
    if (variable.part == ResultPart::ledger && variable.name.ends_with("_se"))
      return {dims, banded({"time"})};
    return {dims};
  }

  void shape(const ResultVariable& variable, const h5::Dataset& data) {
    const std::string name(variable.name);
    const h5::ValueKind wanted = kind_of(variable), found = data.kind();
    const bool is_number = wanted == h5::ValueKind::real && found == h5::ValueKind::integer;
    if (wanted != found && !is_number)
      return add("dataset " + name + " holds " + std::string(h5::kind_words(found)),
                 std::string(h5::kind_words(wanted)) + " belong there");
    const auto sizes = data.shape();
    const auto allowed = allowed_dims(variable);
    const auto dims = std::find_if(allowed.begin(), allowed.end(),
                                   [&](const auto& names) { return names.size() == sizes.size(); });
    if (dims == allowed.end())
      return add(fmt::format("dataset {} is {}", name, size_words(sizes)),
                 allowed.front().empty()
                     ? "it is one value"
                     : fmt::format("its dimensions are {}", fmt::join(allowed.front(), ", ")));
    for (std::size_t axis = 0; axis < sizes.size(); ++axis)
      size(name, (*dims)[axis], sizes[axis], sizes);
    sound_.insert(name);
  }

  void size(const std::string& dataset, const std::string& dimension, std::size_t found,
            const std::vector<std::size_t>& shape) {
    const auto& [expected, said_by] = sizes_.try_emplace(dimension, found, dataset).first->second;
    const bool is_empty = dimension == "time" && found == 0;
    if (expected == found && !is_empty) return;
    has_sizes_ = false;
    add(fmt::format("dataset {} is {}", dataset, size_words(shape)),
        is_empty ? "a result has an interval"
                 : fmt::format("the dimension {} has {} entries{}", dimension, expected,
                               said_by.empty() ? "" : ", as in " + said_by));
  }

  /// Whether its values can be asked for: it is there, and nothing is wrong with any shape.
  bool is_there(const char* dataset) const { return sound_.contains(dataset) && has_sizes_; }

  template <class Value>
  void first_wrong(const char* dataset, const std::vector<Value>& values, const std::string& why,
                   const std::function<bool(Value)>& is_right) {
    const auto wrong = std::find_if_not(values.begin(), values.end(), is_right);
    if (wrong == values.end()) return;
    const auto others = std::count_if(wrong + 1, values.end(), std::not_fn(is_right));
    add(fmt::format("dataset {} has {} at place {}{}", dataset, *wrong, wrong - values.begin(),
                    others > 0 ? fmt::format(", and {} more such values", others) : ""),
        why);
  }

  void indices(const Pointer& pointer) {
    if (!is_there(pointer.dataset)) return;
    const std::string into = pointer.into;
    const auto known = sizes_.find(into);
    const std::size_t count = into.empty()            ? pointer.flags
                              : known == sizes_.end() ? 0
                                                      : known->second.first;
    const std::int32_t least = pointer.may_be_none ? -1 : 0;
    first_wrong<std::int32_t>(
        pointer.dataset, file_.dataset(pointer.dataset).integers(),
        fmt::format("{} … {} are {}", least, static_cast<std::int64_t>(count) - 1,
                    into.empty() ? "its flags" : "entries of the dimension " + into),
        [&](std::int32_t i) {
          return i >= least && (i < 0 || static_cast<std::size_t>(i) < count);
        });
  }

  void numbers(const Range& range) {
    if (!is_there(range.dataset)) return;
    first_wrong<double>(range.dataset, file_.dataset(range.dataset).doubles(), range.words,
                        [&](double x) { return x >= range.least && x <= range.largest; });
  }

  void units(const char* dataset) {
    if (!is_there(dataset)) return;
    const auto flat = file_.dataset(dataset).doubles();
    std::vector<double> lengths(flat.size() / coordinates);
    for (std::size_t i = 0; i < lengths.size(); ++i)
      lengths[i] = std::hypot(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]);
    first_wrong<double>(dataset, lengths, "the length of a direction is 1",
                        [](double length) { return std::abs(length - 1) <= unit_tolerance; });
  }

  void times() {
    if (!is_there("time") || !is_there("time_bounds") || !problems_.empty()) return;
    const auto time = file_.dataset("time").doubles(),
               bounds = file_.dataset("time_bounds").doubles();
    for (std::size_t i = 0; i < time.size(); ++i) {
      if (i > 0 && !(time[i] > time[i - 1]))
        return add(fmt::format("dataset time has {} at place {}", time[i], i),
                   "times increase from one to the next");
      if (!(bounds[2 * i] < bounds[2 * i + 1]))
        return add(fmt::format("dataset time_bounds has {} … {} at place {}", bounds[2 * i],
                               bounds[2 * i + 1], i),
                   "an interval ends after its begin");
    }
  }

  const std::string& path_;
  const h5::File& file_;
  Quantity quantity_ = Quantity::irradiance;
  bool is_rgb_ = false;
  std::span<const ResultVariable> derived_;  ///< of a comparison or a map of a place; else empty
  Problems problems_;
  std::set<std::string, std::less<>> sound_;  ///< datasets of the right kind and rank
  bool has_sizes_ = true;                     ///< dimensions agree
  /// Of dimensions, and the dataset that told it; none of fixed ones.
  std::map<std::string, std::pair<std::size_t, std::string>> sizes_{{"bounds", {2, ""}},
                                                                    {"xyz", {coordinates, ""}},
                                                                    {"corner", {coordinates, ""}},
                                                                    {"band", {band_count, ""}}};
};

}  // namespace

void expect_sound(const std::string& path, const h5::File& file) {
  Examination examination(path, file);
  examination.shapes();
  examination.values();
  examination.attributes();
  examination.throw_if_any();
}

}  // namespace sunload
