// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/citygml/coordinates.h"

#include <algorithm>
#include <string_view>

#include "io/scene/base/words.h"

namespace sunload {

namespace {

constexpr int deepest_curve = 40;  // elements of curves inside of curves

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

std::string_view next_word(std::string_view& text) {
  const auto* const begin = std::find_if_not(text.begin(), text.end(), is_blank);
  const auto* const end = std::find_if(begin, text.end(), is_blank);
  const std::string_view word(begin, static_cast<std::size_t>(end - begin));
  text = std::string_view(end, static_cast<std::size_t>(text.end() - end));
  return word;
}

/// The dimension that an element or what it stands in states, or 3.
std::string_view dimension_of(XmlElement list) {
  for (XmlElement at = list; at; at = at.parent()) {
    auto dimension = at.attribute("srsDimension");
    if (dimension.empty() && at == list) dimension = at.attribute("dimension");  // GML 3.0
    if (!dimension.empty()) return dimension;
    if (at.name().starts_with("lod")) break;  // the envelope of the model is no part of geometries
  }
  return "3";
}

}  // namespace

CityCoordinates::CityCoordinates(const CityDocument& document, NoteCounter& notes)
    : document_(document), notes_(notes) {}

const std::vector<double>& CityCoordinates::numbers(XmlElement element) {
  numbers_.clear();
  std::string_view text = element.text(buffer_);
  while (true) {
    const auto word = next_word(text);
    if (word.empty()) return numbers_;
    const auto number = finite_number(word);
    if (!number)
      document_.file().fail(
          element, std::string(element.name()) + ": '" + shortened(word) + "' is no number",
          "numbers with blanks between them were expected");
    numbers_.push_back(*number);
  }
}

void CityCoordinates::expect_three_dimensions(XmlElement list) const {
  const auto dimension = dimension_of(list);
  if (dimension == "3") return;
  document_.file().fail(list,
                        std::string(list.name()) + " has positions of " +
                            std::string(shortened(dimension)) + " numbers (srsDimension)",
                        "light needs heights: 3 are read",
                        "read plan data as footprints, from GeoJSON, GeoPackage or Shapefile");
}

void CityCoordinates::add_position(Vec3 position) {
  if (corners_.empty() || corners_.back() != position) corners_.push_back(position);
}

void CityCoordinates::add_list(XmlElement list) {
  expect_three_dimensions(list);
  const auto& all = numbers(list);
  constexpr std::size_t dimensions = 3;
  if (all.size() % dimensions != 0)
    document_.file().fail(
        list, std::string(list.name()) + " has " + std::to_string(all.size()) + " numbers",
        "positions of 3 were expected");
  for (std::size_t k = 0; k < all.size(); k += dimensions)
    add_position({all[k], all[k + 1], all[k + 2]});
}

/// `1,2,3 4,5,6`, or with the separators that its attributes name.
void CityCoordinates::add_tuples(XmlElement coordinates) {
  const auto separator = [&](const char* name, char usual) {
    const auto value = coordinates.attribute(name);
    return value.empty() ? usual : value.front();
  };
  const char decimal = separator("decimal", '.'), between = separator("cs", ','),
             behind = separator("ts", ' ');
  std::string text(coordinates.text(buffer_));
  std::size_t in_tuple = 0;
  Vec3 position;
  const auto fail = [&](std::string_view found) {
    document_.file().fail(coordinates, "coordinates: '" + shortened(found) + "'",
                          "3 numbers of each position were expected");
  };
  for (char& c : text) c = is_blank(c) ? ' ' : c;
  std::string word;
  const auto end_number = [&] {
    std::replace(word.begin(), word.end(), decimal, '.');
    const auto number = finite_number(word);
    if (!number || in_tuple > 2) fail(word);
    (in_tuple == 0 ? position.x : in_tuple == 1 ? position.y : position.z) = *number;
    ++in_tuple;
    word.clear();
  };
  const auto end_tuple = [&] {
    if (!word.empty()) end_number();
    if (in_tuple == 0) return;
    if (in_tuple != 3) fail("a position of " + std::to_string(in_tuple) + " numbers");
    add_position(position);
    in_tuple = 0;
  };
  for (const char c : text) {
    if (c == between) {
      end_number();
    } else if (c == behind) {
      end_tuple();
    } else if (c != ' ') {
      word += c;
    }
  }
  end_tuple();
}

/// GML 2: an element for each number.
void CityCoordinates::add_coord(XmlElement coord) {
  const auto value_of = [&](const char* name) {
    const XmlElement element = coord.child(name);
    if (!element || numbers(element).size() != 1)
      document_.file().fail(coord, std::string("coord has no ") + name, "X, Y and Z were expected");
    return numbers_.front();
  };
  const double x = value_of("X"), y = value_of("Y");
  add_position({x, y, value_of("Z")});
}

void CityCoordinates::gather(XmlElement curve, int depth) {
  if (depth > deepest_curve)
    document_.file().fail(curve, "curves nest too deep", "do its links form a circle?");
  const std::size_t first = corners_.size();
  for (const auto child : curve.children()) {
    document_.spend(child, 1);
    const auto name = child.name();
    if (name == "posList" || name == "pos") {
      add_list(child);
    } else if (name == "coordinates") {
      add_tuples(child);
    } else if (name == "coord") {
      add_coord(child);
    } else if (name == "curveMember" || name == "pointProperty" || name == "pointRep" ||
               name == "baseCurve" || name == "segments") {
      for (const auto value : document_.values(child)) {
        if (value.name().starts_with("Arc") || value.name().starts_with("Circle"))
          notes_.count("arcs read as straight lines through their points");
        gather(value, depth + 1);
      }
    }
  }
  if (curve.name() == "OrientableCurve" && curve.attribute("orientation") == "-") {
    const auto begin = corners_.begin() + static_cast<std::ptrdiff_t>(first);
    std::reverse(begin, corners_.end());
    corners_.erase(std::unique(first > 0 ? begin - 1 : begin, corners_.end()), corners_.end());
  }
  document_.spend(curve, corners_.size());
}

const std::vector<Vec3>& CityCoordinates::ring(XmlElement ring) {
  corners_.clear();
  gather(ring, 0);
  while (corners_.size() > 1 && corners_.back() == corners_.front()) corners_.pop_back();
  return corners_;
}

bool CityCoordinates::has_heights(XmlElement ring) {
  const auto first = ring.first_child();
  return !first || dimension_of(first) == "3";
}

Vec3 CityCoordinates::point(XmlElement point) {
  corners_.clear();
  gather(point, 0);
  if (corners_.size() != 1)
    document_.file().fail(point, std::string(point.name()) + " has no position of 3 numbers");
  return corners_.front();
}

}  // namespace sunload
