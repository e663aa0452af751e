// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/base/plain_names.h"

#include <string>
#include <vector>

#include "io/base/names.h"
#include "io/scene/base/from_file.h"

namespace sunload {
namespace {

/// How many names were changed for a reason, and the first of them as it is now.
struct Changed {
  std::size_t count = 0;
  std::string first;

  void add(const std::string& now) {
    if (count++ == 0) first = now;
  }
  std::string note(const std::string& reason) const {
    return std::to_string(count) + (count == 1 ? " name " : " names ") + reason + ": '" + first +
           (count == 1 ? "'" : "', …");
  }
};

class PlainNames {
 public:
  void make_plain(std::string& name) {
    const std::string utf8 = utf8_text(name), plain = clean_name(name);
    if (plain == name) return;
    if (utf8 != name) of_other_encoding_.add(plain);
    if (plain != utf8) with_controls_.add(plain);
    name = plain;
  }
  void tell(std::vector<std::string>& notes) const {
    if (of_other_encoding_.count > 0)
      notes.push_back(of_other_encoding_.note("not in UTF-8, read as Windows-1252 (Latin-1)"));
    if (with_controls_.count > 0)
      notes.push_back(with_controls_.note("with control characters, which are written out"));
  }

 private:
  Changed of_other_encoding_, with_controls_;
};

/// Two spellings of a file may have become one name.
void make_unique(std::vector<std::string>& names) {
  UniqueNames unique;
  for (auto& name : names) name = unique(name);
}

}  // namespace

void make_names_plain(PolygonModel& model) {
  PlainNames names;
  const std::vector<std::string> objects_before = model.object_names;
  for (auto& name : model.object_names) names.make_plain(name);
  if (model.object_names != objects_before) make_unique(model.object_names);
  for (auto& kind : model.object_kinds) names.make_plain(kind);
  for (auto& bare : model.families.bare) {
    names.make_plain(bare.name);
    names.make_plain(bare.kind);
  }
  for (auto& material : model.materials) names.make_plain(material.name);
  names.make_plain(model.crs);
  names.tell(model.notes);
}

}  // namespace sunload
