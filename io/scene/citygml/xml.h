// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// XML files as a tree of elements, told by their names without prefix (pugixml).
#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

#include "geo/base/check.h"

namespace pugi {
struct xml_node_struct;
}

namespace sunload {

class XmlChildren;

/// An element of a file that is read, or none. Names and texts live as long as the file.
class XmlElement {
 public:
  XmlElement() = default;
  explicit XmlElement(pugi::xml_node_struct* node) : node_(node) {}

  explicit operator bool() const { return node_ != nullptr; }
  friend bool operator==(XmlElement, XmlElement) = default;
  /// The same for the same element.
  const void* address() const { return node_; }
  pugi::xml_node_struct* node() const { return node_; }

  /// Without prefix.
  std::string_view name() const;
  /// The value of the attribute of this name, whatever its prefix; empty where there is none.
  std::string_view attribute(std::string_view name) const;
  /// Whether an attribute's value holds this text.
  bool has_value_with(std::string_view text) const;
  /// Text between the tags, without blanks around it. `buffer` takes it where it has pieces.
  std::string_view text(std::string& buffer) const;
  std::string text() const;

  XmlElement parent() const;
  XmlElement first_child() const;
  XmlElement next_sibling() const;
  /// The first child of this name, or none.
  XmlElement child(std::string_view name) const;
  XmlChildren children() const;

 private:
  pugi::xml_node_struct* node_ = nullptr;
};

/// Goes from sibling to sibling; at the end it is of no element.
class XmlChildIterator {
 public:
  explicit XmlChildIterator(XmlElement at) : at_(at) {}
  XmlElement operator*() const { return at_; }
  XmlChildIterator& operator++() {
    at_ = at_.next_sibling();
    return *this;
  }
  friend bool operator==(XmlChildIterator, XmlChildIterator) = default;

 private:
  XmlElement at_;
};

/// The children of an element, for loops.
class XmlChildren {
 public:
  explicit XmlChildren(XmlElement first) : first_(first) {}
  XmlChildIterator begin() const { return XmlChildIterator(first_); }
  static XmlChildIterator end() { return XmlChildIterator(XmlElement()); }

 private:
  XmlElement first_;
};

/// The next element of the tree below `root` in the order of the file, or none.
XmlElement next_in_file(XmlElement element, XmlElement root);
/// The same, passing over what is inside of `element`.
XmlElement next_behind(XmlElement element, XmlElement root);

/// A file, plain or packed by gzip, in UTF-8, UTF-16, UTF-32 or Latin-1. Entities of its own and
/// files that it names are not followed.
class XmlFile {
 public:
  /// Throws InputError with line and column where the file is not well-formed.
  explicit XmlFile(const std::string& path);
  ~XmlFile();
  XmlFile(const XmlFile&) = delete;
  XmlFile& operator=(const XmlFile&) = delete;

  const std::string& path() const { return path_; }
  XmlElement root() const;
  std::size_t bytes() const;
  /// Throws InputError at an element; its line is told where the file is in UTF-8.
  [[noreturn]] void fail(XmlElement at, const std::string& what, const std::string& why = {},
                         const std::string& hint = {}) const;

 private:
  struct Tree;
  std::string path_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace sunload
