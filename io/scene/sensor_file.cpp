// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/sensor_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "geo/base/check.h"
#include "io/base/table_line.h"
#include "io/scene/base/from_file.h"

namespace sunload {

namespace {

constexpr std::array<std::string_view, 6> column_names{"x", "y", "z", "nx", "ny", "nz"};
constexpr std::size_t most_problems = 20;  // of a file with another meaning, the first will do

using Fields = std::vector<std::string_view>;
using SensorColumns = std::array<std::size_t, column_names.size()>;

/// Without quotes, in lower case.
std::string plain(std::string_view field) {
  if (field.size() > 1 && field.front() == '"' && field.back() == '"')
    field = field.substr(1, field.size() - 2);
  return lower_case(std::string(field));
}

/// The table of one file while it is read.
class SensorTable {
 public:
  explicit SensorTable(const std::string& path) : path_(path) {}

  void read(std::string_view text) {
    text = without_byte_order_mark(text);
    for (int line = 1; !text.empty() && problems_.list().size() < most_problems; ++line) {
      const auto end = std::min(text.find('\n'), text.size());
      const std::string_view written = text.substr(0, end);
      const Fields fields = table_fields(written);
      if (may_have_decimal_commas(written))
        problems_.add(decimal_commas({path_, line}));
      else if (!fields.empty())
        row(line, fields);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (points_.empty() && problems_.empty())
      problems_.add({path_}, "holds no sensors", "a row is x y z nx ny nz");
    problems_.throw_if_any();
  }
  std::vector<SensorPoint> points() && { return std::move(points_); }

 private:
  void row(int line, const Fields& fields) {
    const bool is_first = !columns_;
    if (is_first) columns_ = header(line, fields);
    if (is_first && !table_number(fields[0])) return;
    if (!has_all_columns(fields)) {
      problems_.add(
          {path_, line}, fmt::format("the row has {} fields, not {}", fields.size(), column_count_),
          "a sensor is x y z nx ny nz",
          fields.size() > column_count_ ? "decimal commas are not read: write points" : "");
      return;
    }
    std::array<double, column_names.size()> values{};
    for (std::size_t c = 0; c < values.size(); ++c) {
      const auto field = fields[(*columns_)[c]];
      const auto value = table_number(field);
      if (!value) {
        problems_.add({path_, line}, fmt::format("{}: '{}' is no number", column_names[c], field));
        return;
      }
      values[c] = *value;
    }
    add(line, {{values[0], values[1], values[2]}, {values[3], values[4], values[5]}});
  }

  /// Below a header names may have blanks in them; more numbers than it has columns are none of it.
  bool has_all_columns(const Fields& fields) const {
    if (!has_header_) return fields.size() == column_count_;
    const std::size_t needed = *std::max_element(columns_->begin(), columns_->end()) + 1;
    return fields.size() >= needed &&
           (fields.size() <= column_count_ ||
            !std::all_of(fields.begin(), fields.end(), [](auto f) { return table_number(f); }));
  }

  /// Columns of a first row; without a header they follow one another.
  SensorColumns header(int line, const Fields& fields) {
    SensorColumns columns{0, 1, 2, 3, 4, 5};
    if (table_number(fields[0])) return columns;
    has_header_ = true;
    column_count_ = fields.size();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto found = std::find_if(fields.begin(), fields.end(),
                                      [&](auto f) { return plain(f) == column_names[c]; });
      if (found == fields.end())
        throw InputError({path_, line},
                         fmt::format("the header names no column {}", column_names[c]),
                         "sensors are x, y, z, nx, ny, nz");
      columns[c] = static_cast<std::size_t>(found - fields.begin());
    }
    return columns;
  }

  void add(int line, const SensorPoint& point) {
    if (!is_usable(point.position))
      problems_.add({path_, line}, "the position lies beyond any map projection of the Earth");
    else if (norm(point.normal) < shortest_normal)
      problems_.add({path_, line}, "the normal has no length", "it tells where the sensor looks");
    else
      points_.push_back(point);
  }

  std::string path_;
  std::optional<SensorColumns> columns_;
  bool has_header_ = false;
  std::size_t column_count_ = column_names.size();  ///< as the header has them
  std::vector<SensorPoint> points_;
  Problems problems_;
};

}  // namespace

std::vector<SensorPoint> read_sensor_file(const std::string& path) {
  SensorTable table(path);
  table.read(read_whole_file(path));
  return std::move(table).points();
}

}  // namespace sunload
