// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Positions as GML writes them.
#pragma once

#include <string>
#include <vector>

#include "geo/base/vec.h"
#include "io/scene/citygml/document.h"

namespace sunload {

/// Reads lists of positions of three numbers: posList, pos, coordinates and coord (GML 2, 3.1), and
/// the rings and lines that are made of them.
class CityCoordinates {
 public:
  CityCoordinates(const CityDocument& document, NoteCounter& notes);

  /// The corners of a LinearRing, or of a Ring of straight lines, in the order and in the numbers
  /// of the file; the last one does not repeat the first. The result lives until the next call.
  /// Throws InputError for what is no number, and for positions of two numbers.
  const std::vector<Vec3>& ring(XmlElement ring);
  /// Whether the file says that positions of a ring have three numbers, or nothing.
  static bool has_heights(XmlElement ring);
  /// The position of a gml:Point.
  Vec3 point(XmlElement point);
  /// All numbers of an element's text.
  const std::vector<double>& numbers(XmlElement element);

 private:
  void gather(XmlElement curve, int depth);
  void add_list(XmlElement list);
  void add_tuples(XmlElement coordinates);
  void add_coord(XmlElement coord);
  void add_position(Vec3 position);
  void expect_three_dimensions(XmlElement list) const;

  const CityDocument& document_;
  NoteCounter& notes_;
  std::vector<Vec3> corners_;
  std::vector<double> numbers_;
  std::string buffer_;
};

}  // namespace sunload
