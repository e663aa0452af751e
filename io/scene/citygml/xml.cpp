// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/citygml/xml.h"

#include <algorithm>
#include <cctype>
#include <pugixml.hpp>

#include "io/base/file_text.h"
#include "io/base/gzip.h"

namespace sunload {

namespace {

// No document type, comments and processing instructions; the first text of an element is stored
// with it, which saves a node for each list of positions.
constexpr unsigned parsed =
    pugi::parse_minimal | pugi::parse_escapes | pugi::parse_cdata | pugi::parse_embed_pcdata;

std::string_view without_prefix(const char* name) {
  const std::string_view whole = name;
  const auto colon = whole.find(':');
  return colon == whole.npos ? whole : whole.substr(colon + 1);
}

XmlElement element_from(pugi::xml_node node) {
  while (node && node.type() != pugi::node_element) node = node.next_sibling();
  return XmlElement(node.internal_object());
}

std::string file_text(const std::string& path) {
  std::string bytes = read_whole_file(path);
  return is_gzip(bytes) ? unpack_gzip(bytes, path) : bytes;
}

}  // namespace

std::string_view XmlElement::name() const { return without_prefix(pugi::xml_node(node_).name()); }

std::string_view XmlElement::attribute(std::string_view name) const {
  for (const auto& attribute : pugi::xml_node(node_).attributes())
    if (without_prefix(attribute.name()) == name) return attribute.value();
  return {};
}

bool XmlElement::has_value_with(std::string_view text) const {
  for (const auto& attribute : pugi::xml_node(node_).attributes())
    if (std::string_view(attribute.value()).find(text) != text.npos) return true;
  return false;
}

std::string_view XmlElement::text(std::string& buffer) const {
  const pugi::xml_node node(node_);
  const std::string_view first = node.value();
  const auto is_text = [](const pugi::xml_node& child) {
    return child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata;
  };
  if (!node.first_child()) return trimmed(first);
  buffer = first;
  for (const auto& child : node.children())
    if (is_text(child)) buffer.append(" ").append(child.value());
  return trimmed(buffer);
}

std::string XmlElement::text() const {
  std::string buffer;
  return std::string(text(buffer));
}

XmlElement XmlElement::parent() const {
  const pugi::xml_node above = pugi::xml_node(node_).parent();
  return above.type() == pugi::node_element ? XmlElement(above.internal_object()) : XmlElement();
}

XmlElement XmlElement::first_child() const {
  return element_from(pugi::xml_node(node_).first_child());
}

XmlElement XmlElement::next_sibling() const {
  return element_from(pugi::xml_node(node_).next_sibling());
}

XmlElement XmlElement::child(std::string_view name) const {
  for (const auto each : children())
    if (each.name() == name) return each;
  return {};
}

XmlChildren XmlElement::children() const { return XmlChildren(first_child()); }

XmlElement next_in_file(XmlElement element, XmlElement root) {
  const auto below = element.first_child();
  return below ? below : next_behind(element, root);
}

XmlElement next_behind(XmlElement element, XmlElement root) {
  while (element && element != root) {
    if (const auto beside = element.next_sibling()) return beside;
    element = element.parent();
  }
  return {};
}

struct XmlFile::Tree {
  std::string text;  // in which names and values of the tree lie
  pugi::xml_document document;
  std::size_t bytes = 0;
  bool has_lines = false;
};

XmlFile::XmlFile(const std::string& path) : path_(path), tree_(std::make_unique<Tree>()) {
  tree_->text = file_text(path);
  tree_->bytes = tree_->text.size();
  const auto result =
      tree_->document.load_buffer_inplace(tree_->text.data(), tree_->text.size(), parsed);
  tree_->has_lines = result.encoding == pugi::encoding_utf8;
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (result.status == pugi::status_no_document_element)
    throw InputError({path_}, "is no XML", "it has no element");
  if (!result) {
    const Where where =
        tree_->has_lines && result.offset >= 0
            ? place_in_text(path_, file_text(path_), static_cast<std::size_t>(result.offset))
            : Where{path_};
    std::string why = result.description();
    if (!why.empty())
      why.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(why.front())));
    throw InputError(where, "is no well-formed XML", why, "is the file complete?");
  }
}

XmlFile::~XmlFile() = default;

XmlElement XmlFile::root() const {
  return XmlElement(tree_->document.document_element().internal_object());
}

std::size_t XmlFile::bytes() const { return tree_->bytes; }

void XmlFile::fail(XmlElement at, const std::string& what, const std::string& why,
                   const std::string& hint) const {
  const auto byte = pugi::xml_node(at.node()).offset_debug();  // of its name, behind the bracket
  if (!tree_->has_lines || byte < 1) throw InputError({path_}, what, why, hint);
  // The tree was made in the file's text, and has cut it: places are told in a fresh one.
  throw InputError(place_in_text(path_, file_text(path_), static_cast<std::size_t>(byte) - 1), what,
                   why, hint);
}

}  // namespace sunload
