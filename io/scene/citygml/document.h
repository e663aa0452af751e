// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A CityGML file: its kind, what its links mean, what is found in it wherever it stands.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/base/file_text.h"
#include "io/scene/citygml/xml.h"

namespace sunload {

/// The file as read, with an index of what its links name.
class CityDocument {
 public:
  /// Throws InputError where the file is no CityGML, telling what it is.
  CityDocument(const std::string& path, NoteCounter& notes);

  const XmlFile& file() const { return file_; }
  XmlElement root() const { return file_.root(); }

  /// The elements that a property holds or, by `xlink:href="#id"`, names. Links to other files are
  /// counted and lead nowhere.
  std::vector<XmlElement> values(XmlElement property) const;
  /// The first of them, or none.
  XmlElement value(XmlElement property) const;

  /// Links let a small file name the same things again and again: throws InputError where more is
  /// met than its size justifies.
  void spend(XmlElement at, std::size_t steps) const;

  const std::vector<XmlElement>& materials() const { return materials_; }  ///< X3DMaterial
  const std::string& srs_name() const { return srs_name_; }                ///< empty: none
  XmlElement srs_element() const { return srs_element_; }

 private:
  void check_root() const;
  void survey();
  void index_targets();

  XmlFile file_;
  NoteCounter& notes_;
  mutable std::size_t steps_left_;
  std::vector<XmlElement> materials_;
  std::string srs_name_;
  XmlElement srs_element_;
  std::unordered_map<std::string_view, XmlElement> targets_;  ///< of links, by id
};

}  // namespace sunload
