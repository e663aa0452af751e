// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/ies_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "geo/base/check.h"
#include "io/base/file_text.h"
#include "io/base/table_line.h"

namespace sunload {

namespace {

constexpr std::size_t most_angles = 10'000;  // per axis: a hundredth of a degree
constexpr int photometry_of_type_c = 1;

/// The numbers after the line TILT, which run over lines as they like.
class Numbers {
 public:
  Numbers(std::string path, std::string_view text, int first_line)
      : path_(std::move(path)), rest_(text), line_(first_line) {}

  double next(const std::string& what) {
    while (fields_.empty()) {
      if (rest_.empty())
        throw InputError({path_, line_}, "ends before " + what, "",
                         "the file may be cut off; get it once more");
      const auto end = std::min(rest_.find('\n'), rest_.size());
      fields_ = table_fields(rest_.substr(0, end));
      std::reverse(fields_.begin(), fields_.end());
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++line_;
    }
    const auto number = table_number(fields_.back());
    if (!number)
      fail("'" + std::string(fields_.back()) + "' is no number", "it stands for " + what);
    fields_.pop_back();
    return *number;
  }
  double next(const std::string& what, double low, double high) {
    const double number = next(what);
    if (!(number >= low && number <= high))
      fail(fmt::format("{} is {:g}", what, number),
           fmt::format("it lies in {:g} … {:g}", low, high));
    return number;
  }
  std::size_t count(const std::string& what, std::size_t least) {
    const double number = next(what, static_cast<double>(least), most_angles);
    if (number != std::floor(number))
      fail(fmt::format("{} is {:g}", what, number), "it is a count");
    return static_cast<std::size_t>(number);
  }
  std::vector<double> angles(const std::string& what, std::size_t count, double low, double high) {
    std::vector<double> angles(count);
    for (double& angle : angles) angle = next(what, low, high);
    if (std::adjacent_find(angles.begin(), angles.end(), std::greater_equal<>()) != angles.end())
      fail(what + "s do not ascend", "");
    return angles;
  }
  [[noreturn]] void fail(const std::string& what, const std::string& why,
                         const std::string& hint = {}) const {
    throw InputError({path_, line_ - 1}, what, why, hint);
  }

 private:
  std::string path_;
  std::string_view rest_;
  int line_;  ///< of what comes next
  std::vector<std::string_view> fields_;
};

/// The planes of a file, from which those that symmetry leaves out follow.
struct Planes {
  std::vector<double> deg;
  std::vector<std::size_t> row;  ///< of the file
};

/// LM-63, 5.13: the last plane tells the symmetry. One: all are alike; 90: of the four quarters;
/// 180: of both sides of the plane C 0; from 90 to 270: of both sides of the plane C 90.
Planes unfolded(const std::vector<double>& given, const Numbers& at) {
  Planes planes;
  const auto add = [&](double deg, std::size_t row) {
    if (!planes.deg.empty() && deg <= planes.deg.back()) return;  // on the mirror's plane
    planes.deg.push_back(deg);
    planes.row.push_back(row);
  };
  const std::size_t n = given.size();
  const double first = given.front(), last = given.back();
  if (n == 1) {
    add(0, 0);
  } else if (first == 0 && (last == 90 || last == 180)) {
    for (std::size_t p = 0; p < n; ++p) add(given[p], p);
    if (last == 90)
      for (std::size_t p = n; p-- > 0;) add(180 - given[p], p);
    for (std::size_t k = planes.deg.size(); k-- > 0;) add(360 - planes.deg[k], planes.row[k]);
  } else if (first == 90 && last == 270) {
    // C and 180 - C are alike: 0 … 90 are 180 … 90, and 270 … 360 are 270 … 180.
    for (std::size_t p = n; p-- > 0;)
      if (given[p] <= 180) add(180 - given[p], p);
    for (std::size_t p = 0; p < n; ++p) add(given[p], p);
    for (std::size_t p = n; p-- > 0;)
      if (given[p] >= 180) add(540 - given[p], p);
  } else if (first == 0 && last > 180) {
    for (std::size_t p = 0; p < n; ++p) add(given[p], p);
    if (last < 360) add(360, 0);
  } else {
    at.fail(
        fmt::format("planes from {:g} to {:g} degrees", first, last),
        "a file of type C has one plane, or planes from 0 to 90, 180 or 360, or from 90 to 270");
  }
  if (n > 1 && (planes.deg.front() != 0 || planes.deg.back() != 360))
    at.fail("planes do not close the circle", "no plane at the middle of their symmetry",
            "planes from 90 to 270 need one at 180");
  return planes;
}

/// Place after the line TILT=NONE, and the number of the line that follows.
std::pair<std::size_t, int> after_tilt(const std::string& path, std::string_view text) {
  int line = 1;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string words = lower_case(std::string(trimmed(text.substr(begin, end - begin))));
    begin = end + 1;
    if (!words.starts_with("tilt")) continue;
    const auto is = words.find('=');
    if (is == std::string::npos) continue;
    if (trimmed(std::string_view(words).substr(is + 1)) != "none")
      throw InputError({path, line}, "TILT is not NONE",
                       "how a tilted lamp dims is not read: its photometry would be another",
                       "get the file of the luminaire as it hangs");
    return {std::min(begin, text.size()), line + 1};
  }
  throw InputError({path}, "is no IES file", "no line of it begins with TILT=",
                   "luminaires are read from files of ANSI/IES LM-63 (.ies)");
}

/// Files of 1986 begin without a name of their format; those of 1991 name it IESNA91. Programs put
/// a byte order mark or blanks before it.
bool names_its_format(std::string_view text) {
  text = without_byte_order_mark(text);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  const std::string name = lower_case(std::string(text.substr(0, std::strlen("IESNA:"))));
  return name.starts_with("iesna:") || name.starts_with("ies:");
}

}  // namespace

IntensityWeb read_ies_file(const std::string& path) {
  const std::string text = read_whole_file(path);
  const auto [begin, line] = after_tilt(path, text);
  Numbers numbers(path, std::string_view(text).substr(begin), line);
  constexpr double large = 1e9;
  numbers.next("the number of lamps", 0, large);
  numbers.next("lumens per lamp", -1, large);  // -1: absolute photometry
  const double multiplier = numbers.next("the multiplier of candelas", 0, large);
  const std::size_t gamma_count = numbers.count("the number of vertical angles", 2);
  const std::size_t plane_count = numbers.count("the number of horizontal angles", 1);
  if (const double type = numbers.next("the type of photometry", 1, 3);
      type != photometry_of_type_c)
    numbers.fail(fmt::format("is photometry of type {}", type == 2 ? "B" : "A"),
                 "street and room lights have type C, angles about the vertical axis",
                 "export it as type C");
  numbers.next("the unit of lengths", 1, 2);
  for (const char* size : {"width", "length", "height"}) numbers.next(size, -large, large);
  const double ballast = numbers.next("the ballast factor", 0, large);
  // Of 1986 and 1991 a second factor, then a number that is 1 or means something else.
  const double second =
      numbers.next("the ballast-lamp factor, or what stands for it", -large, large);
  const bool is_old = !names_its_format(text);
  numbers.next("input watts", 0, large);

  IntensityWeb web;
  web.gammas_deg = numbers.angles("vertical angle", gamma_count, 0, 180);
  const Planes planes = unfolded(numbers.angles("horizontal angle", plane_count, 0, 360), numbers);
  const double factor = multiplier * ballast * (is_old && second > 0 ? second : 1);
  std::vector<double> given(plane_count * gamma_count);
  for (double& value : given) value = factor * numbers.next("a candela value", 0, large);
  web.planes_deg = planes.deg;
  for (const std::size_t row : planes.row)
    web.intensities.insert(web.intensities.end(),
                           given.begin() + static_cast<std::ptrdiff_t>(row * gamma_count),
                           given.begin() + static_cast<std::ptrdiff_t>((row + 1) * gamma_count));
  if (web.largest() <= 0) throw InputError({path}, "sends no light", "all candela values are 0");
  expect_valid(web);
  return web;
}

}  // namespace sunload
