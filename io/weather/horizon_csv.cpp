// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/weather/horizon_csv.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "geo/base/check.h"
#include "io/base/file_text.h"
#include "io/base/table_line.h"

namespace sunload {

namespace {

constexpr double south_deg = 180;
constexpr std::size_t fewest_points = 2;

struct Line {
  int number = 0;
  std::string_view text;
  std::vector<std::string_view> fields;
};

std::vector<Line> lines_of(std::string_view text) {
  text = without_byte_order_mark(text);
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    lines.push_back({number, line, table_fields(line)});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Columns of the two angles, and azimuth = written + `turn_deg`.
struct HorizonColumns {
  std::size_t azimuth = 0, elevation = 0;
  double turn_deg = 0;
  bool ends_at_empty_line = false;
};

std::optional<std::size_t> column(const Line& line, std::string_view name) {
  const auto found = std::find(line.fields.begin(), line.fields.end(), name);
  if (found == line.fields.end()) return {};
  return static_cast<std::size_t>(found - line.fields.begin());
}

std::optional<HorizonColumns> header_in(const Line& line) {
  const auto azimuth = column(line, "azimuth_deg"), elevation = column(line, "elevation_deg");
  if (azimuth && elevation) return HorizonColumns{*azimuth, *elevation, 0, false};
  const auto a = column(line, "A"), height = column(line, "H_hor");
  if (a && height) return HorizonColumns{*a, *height, south_deg, true};
  return {};
}

double number_in(const std::string& path, const Line& line, std::size_t column) {
  const std::string_view field = line.fields[column];
  const auto value = table_number(field);
  if (!value)
    throw InputError({path, line.number}, "'" + std::string(field) + "' is no number",
                     "the rows below the header are azimuth and elevation in degrees");
  return *value;
}

Horizontal point_in(const std::string& path, const Line& line, const HorizonColumns& header) {
  if (may_have_decimal_commas(line.text)) throw decimal_commas({path, line.number});
  const std::size_t last = std::max(header.azimuth, header.elevation);
  if (line.fields.size() <= last)
    throw InputError({path, line.number}, "the row is too short",
                     std::to_string(last + 1) + " columns are needed");
  return {number_in(path, line, header.azimuth) + header.turn_deg,
          number_in(path, line, header.elevation)};
}

}  // namespace

Horizon read_horizon_csv(const std::string& path) {
  std::optional<HorizonColumns> header;
  std::vector<Horizontal> points;
  const std::string text = read_whole_file(path);
  for (const Line& line : lines_of(text)) {
    if (!header) {
      header = header_in(line);
    } else if (!line.fields.empty()) {
      points.push_back(point_in(path, line, *header));
    } else if (header->ends_at_empty_line && !points.empty()) {
      break;
    }
  }
  if (!header)
    throw InputError({path}, "is no horizon file",
                     "a header with azimuth_deg and elevation_deg, or A and H_hor, is missing",
                     "write the first line: azimuth_deg,elevation_deg");
  if (points.size() < fewest_points)
    throw InputError({path}, "has too few points for a horizon", "at least two are needed");
  try {
    return Horizon(std::move(points));
  } catch (const InputError& error) {
    throw InputError({path}, error.problems().front());
  }
}

}  // namespace sunload
