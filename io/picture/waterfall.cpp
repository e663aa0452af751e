// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/waterfall.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geo/base/check.h"
#include "io/base/text.h"
#include "io/picture/picture.h"

namespace sunload {

namespace {

using Kind = ExplainedRow::Kind;

// Pixels.
constexpr int picture_width = 1000;
constexpr double margin = 16, text_size = 13, row_height = 36, bar_height = 24;
constexpr double title_line = 28, subtitle_line = 48, legend_line = 74, first_row = 92;
constexpr double axis_room = 34, note_room = 44;
constexpr double most_of_names = 260, room_for_numbers = 150, gap = 12;
constexpr double half_digit = 0.36;  // digits are some 0.72 of the font's height

constexpr Colour faint{0.86, 0.86, 0.88}, zero_colour{0.45, 0.45, 0.48},
    plain_bar{0.42, 0.42, 0.46};
/// In the order of `Column`: warm for the sun, blue for the sky, brown for the ground; what objects
/// give apart from these.
constexpr std::array<Colour, column_count> way_colours{
    Colour{0.93, 0.62, 0.10}, Colour{0.38, 0.63, 0.86}, Colour{0.62, 0.49, 0.34},
    Colour{0.36, 0.65, 0.40}, Colour{0.52, 0.38, 0.73}, Colour{0.86, 0.34, 0.44}};

/// What is taken is paler than what is there.
Colour paler(Colour c) {
  constexpr double left = 0.5;
  const auto mixed = [](double channel) { return 1 - left * (1 - channel); };
  return {mixed(c.red), mixed(c.green), mixed(c.blue)};
}

/// Objects of which the picture shows each by itself: those that do something that can be seen.
std::size_t objects_worth_a_row(const Explanation& explanation) {
  constexpr std::size_t most_objects = 16;
  constexpr double least_share = 0.005;
  double largest = 0;
  for (const auto& row : explanation.rows) largest = std::max(largest, std::abs(row.total));
  std::size_t objects = 0, worth = 0;
  for (const auto& row : explanation.rows) {
    if (row.kind != Kind::object) continue;
    ++objects;
    double done = 0;
    for (const double way : row.columns) done += std::abs(way);
    if (done >= least_share * largest) worth = objects;
  }
  // One other by itself is no shorter than by its name.
  return std::min(worth + 1 == objects ? objects : worth, most_objects);
}

double sum_below_0(const ExplainedRow& row) {
  double sum = 0;
  for (const double way : row.columns) sum += std::isnan(way) ? 0 : std::min(way, 0.0);
  return sum;
}

/// A row with the value where its bars begin.
struct Step {
  ExplainedRow row;
  double begin = 0, lowest = 0, end = 0;
};

/// What adds up goes on where the row before it ended; the sum and the result begin at 0.
std::vector<Step> steps_of(const Explanation& explanation) {
  std::vector<Step> steps;
  double level = 0;
  for (const auto& row : shown_rows(explanation, objects_worth_a_row(explanation))) {
    if (row.kind == Kind::remainder) continue;
    const bool adds = row.kind == Kind::open || row.kind == Kind::object;
    Step step{row, adds ? level : 0};
    step.lowest = step.begin + sum_below_0(row);
    step.end = step.begin + row.total;
    if (adds) level = step.end;
    steps.push_back(step);
  }
  return steps;
}

/// Cut to a width, at a letter.
std::string fitted(const Picture& picture, std::string text, const TextStyle& style, double width) {
  if (picture.text_width(text, style) <= width) return text;
  constexpr unsigned char continues = 0x80, kind_of_byte = 0xC0;
  const auto is_amid_letter = [&] {
    return (static_cast<unsigned char>(text.back()) & kind_of_byte) == continues;
  };
  while (!text.empty() && picture.text_width(text + "…", style) > width) {
    while (is_amid_letter()) text.pop_back();
    text.pop_back();
  }
  return text + "…";
}

class Waterfall {
 public:
  explicit Waterfall(const Explanation& explanation)
      : explanation_(explanation),
        steps_(steps_of(explanation)),
        picture_(picture_width, height_for(steps_.size())) {
    for (const Step& step : steps_)
      names_ = std::max(names_,
                        picture_.text_width(row_words(step.row, explanation_), style_of(step.row)));
    names_ = std::min(names_, most_of_names);
    find_range();
  }

  void draw(const std::string& path) {
    write_title();
    draw_axis();
    for (std::size_t k = 0; k < steps_.size(); ++k) draw_step(k);
    draw_ways();
    write_notes();
    picture_.save(path);
  }

 private:
  static int height_for(std::size_t rows) {
    return static_cast<int>(first_row + row_height * static_cast<double>(rows) + axis_room +
                            note_room);
  }
  static TextStyle style_of(const ExplainedRow& row) {
    return {text_size, Align::left, row.kind == Kind::object ? Weight::normal : Weight::bold, ink};
  }

  double left() const { return margin + names_ + gap; }
  double right() const { return picture_width - margin - room_for_numbers - gap; }
  double bottom() const { return first_row + row_height * static_cast<double>(steps_.size()); }
  double x(double value) const {
    return left() + (value - least_) / (largest_ - least_) * (right() - left());
  }
  static double middle(std::size_t row) {
    return first_row + row_height * (static_cast<double>(row) + 0.5);
  }

  void find_range() {
    for (const Step& step : steps_) {
      const double error = std::isnan(step.row.se) ? 0 : step.row.se;
      least_ = std::min({least_, step.begin, step.lowest, step.end - error});
      largest_ = std::max({largest_, step.begin, step.end + error, highest(step)});
    }
    if (largest_ - least_ <= 0) largest_ = least_ + 1;
    ticks_ = round_ticks(std::max(largest_, -least_), most_ticks);
  }

  /// Where what is given ends.
  static double highest(const Step& step) {
    double value = step.lowest;
    for (const double way : step.row.columns) value += std::isnan(way) ? 0 : std::max(way, 0.0);
    return value;
  }

  void write_title() {
    const double width = picture_width - 2 * margin;
    const auto& e = explanation_;
    const TextStyle title{1.45 * text_size, Align::left, Weight::bold, ink};
    picture_.write({margin, title_line}, fitted(picture_, e.place, title, width), title);
    std::string words = fmt::format("{}, variant {}, {}", e.study, e.variant, e.extent);
    if (!e.part.empty()) words += ", " + e.part;
    words += e.base.empty() ? ": where its light load comes from"
                            : fmt::format(": what differs from {}", e.base);
    const TextStyle subtitle{text_size, Align::left, Weight::normal, ink};
    picture_.write({margin, subtitle_line}, fitted(picture_, words, subtitle, width), subtitle);
  }

  void draw_tick(double value) {
    if (value < least_ || value > largest_) return;
    const bool is_0 = value == 0;
    picture_.draw_lines({{x(value), first_row}, {x(value), bottom() + 4}}, is_0 ? 1.4 : 1,
                        is_0 ? zero_colour : faint);
    picture_.write({x(value), bottom() + 18}, fmt::format("{:.{}f}", value, ticks_.decimals),
                   {text_size * 0.9, Align::centre, Weight::normal, ink});
  }

  void draw_axis() {
    for (const double value : ticks_.values) {
      draw_tick(value);
      if (value > 0) draw_tick(-value);
    }
    picture_.write({picture_width - margin, bottom() + 18},
                   fmt::format("{} ± se", display_units(explanation_.units)),
                   {text_size * 0.9, Align::right, Weight::bold, ink});
  }

  /// Bars of the ways below 0 to the left, below them the others to the right; where there are but
  /// those of one side they have the whole height.
  void draw_ways_of(const Step& step, double y) {
    const bool has_both = step.lowest < step.begin && highest(step) > step.lowest;
    const double height = has_both ? bar_height / 2 : bar_height;
    double at = step.begin;
    for (std::size_t c = 0; c < column_count; ++c) {
      const double way = step.row.columns[c];
      if (!(way < 0)) continue;
      picture_.fill_rectangle({x(at + way), y - bar_height / 2}, x(at) - x(at + way), height,
                              paler(way_colours[c]));
      at += way;
    }
    for (std::size_t c = 0; c < column_count; ++c) {
      const double way = step.row.columns[c];
      if (!(way > 0)) continue;
      picture_.fill_rectangle({x(at), y + bar_height / 2 - height}, x(at + way) - x(at), height,
                              way_colours[c]);
      at += way;
    }
  }

  void draw_whisker(const Step& step, double y) {
    if (std::isnan(step.row.se)) return;
    constexpr double cap = 4;
    const double low = x(step.end - step.row.se), high = x(step.end + step.row.se);
    picture_.draw_lines({{low, y}, {high, y}}, 1.5, ink);
    for (const double at : {low, high})
      picture_.draw_lines({{at, y - cap}, {at, y + cap}}, 1.5, ink);
  }

  void draw_step(std::size_t k) {
    const Step& step = steps_[k];
    const double y = middle(k);
    if (step.row.kind == Kind::result)
      picture_.fill_rectangle({x(std::min(0.0, step.end)), y - bar_height / 2},
                              std::abs(x(step.end) - x(0)), bar_height, plain_bar);
    else
      draw_ways_of(step, y);
    // Down to where the next one begins, or ends if it begins anew.
    if (k + 1 < steps_.size() && step.row.kind != Kind::sum)
      picture_.draw_lines(
          {{x(step.end), y + bar_height / 2}, {x(step.end), middle(k + 1) - bar_height / 2}}, 1,
          zero_colour);
    draw_whisker(step, y);
    const TextStyle style = style_of(step.row);
    const double base = y + half_digit * text_size;
    picture_.write({margin, base},
                   fitted(picture_, row_words(step.row, explanation_), style, names_), style);
    TextStyle numbers = style;
    numbers.align = Align::right;
    picture_.write({picture_width - margin, base}, number_words(step.row), numbers);
  }

  std::string number_words(const ExplainedRow& row) const {
    constexpr int digits_of_largest = 5;
    const double largest = std::max(largest_, -least_);
    const int digits =
        std::clamp(digits_of_largest - 1 - static_cast<int>(std::floor(std::log10(largest))), 0, 9);
    const auto rounded = [&](double value) {
      // What rounds to nothing has no sign.
      return std::abs(value) < 0.5 * std::pow(10.0, -digits) ? 0.0 : value;
    };
    const bool is_change = row.kind == Kind::object || !explanation_.base.empty();
    std::string text = is_change ? fmt::format("{:+.{}f}", rounded(row.total), digits)
                                 : fmt::format("{:.{}f}", rounded(row.total), digits);
    if (text.front() == '-') text.replace(0, 1, "−");
    if (!std::isnan(row.se)) text += fmt::format(" ± {:.{}f}", row.se, digits);
    return text;
  }

  /// Which colour is which way of light, of those that there are.
  void draw_ways() {
    double at = left();
    constexpr double square = 12;
    for (std::size_t c = 0; c < column_count; ++c) {
      const bool occurs = std::any_of(steps_.begin(), steps_.end(), [&](const Step& step) {
        return !std::isnan(step.row.columns[c]) && step.row.columns[c] != 0;
      });
      if (!occurs) continue;
      std::string words = column_names[c];
      std::replace(words.begin(), words.end(), '_', ' ');
      const TextStyle style{text_size, Align::left, Weight::normal, ink};
      picture_.fill_rectangle({at, legend_line - square + 1}, square, square, way_colours[c]);
      picture_.write({at + square + 6, legend_line}, words, style);
      at += square + 6 + picture_.text_width(words, style) + 22;
    }
  }

  void write_notes() {
    const TextStyle style{text_size * 0.9, Align::left, Weight::normal, ink};
    const double width = picture_width - 2 * margin;
    const auto remainder =
        std::find_if(explanation_.rows.begin(), explanation_.rows.end(),
                     [](const ExplainedRow& row) { return row.kind == Kind::remainder; });
    picture_.write({margin, bottom() + axis_room + 12},
                   explanation_.base.empty()
                       ? "Pale, to the left: what an object takes. Full, to the right: what it "
                         "gives. Whiskers: ± standard error."
                       : "Pale, to the left: less than there. Full, to the right: more. Whiskers: "
                         "± standard error.",
                   style);
    if (remainder == explanation_.rows.end()) return;
    std::string words = "Remainder, which is not explained: " + number_words(*remainder) + " " +
                        display_units(explanation_.units);
    for (const auto& note : explanation_.notes) words += "; " + note;
    picture_.write({margin, bottom() + axis_room + 30}, fitted(picture_, words, style, width),
                   style);
  }

  static constexpr int most_ticks = 6;
  const Explanation& explanation_;
  std::vector<Step> steps_;
  Picture picture_;
  double names_ = 0, least_ = 0, largest_ = 0;
  Ticks ticks_;
};

}  // namespace

void draw_waterfall(const Explanation& explanation, const std::string& path) {
  Waterfall(explanation).draw(path);
}

}  // namespace sunload
