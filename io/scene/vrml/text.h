// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The text of VRML and Inventor files, before a parser sees it: limits, and repairs that
/// leave every line where it was.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/base/check.h"

namespace sunload {

/// Nesting of `{` and `[`: parsers recurse; 1000 levels need well below a stack of 8 MB.
inline constexpr std::size_t deepest_vrml = 500;
/// Coin copies names on its stack: 1 MB of one overflows it.
inline constexpr std::size_t longest_vrml_word = 4096;
/// Nodes after PROTOs and USEs are put in their places: beyond any real file, seconds to read.
inline constexpr double most_vrml_nodes = 5e6;
/// Nodes that are in memory, USEs not counted: some kilobytes each where PROTOs make them.
inline constexpr double vrml_nodes_at_least = 2e5, vrml_nodes_per_byte = 0.2;

/// One VRML file, unpacked.
struct VrmlText {
  std::string path;
  std::string text;
  bool is_vrml97 = false;  ///< else VRML 1.0 or Inventor
};

/// Reads a file, gzip by content, and checks its first line.
/// Throws InputError for what is no text of VRML 1.0, VRML97 or Inventor.
VrmlText read_vrml_text(const std::string& path);

/// Refuses what would make a parser hang, overflow or run out of memory: brackets that do
/// not match, nesting beyond `deepest_vrml`, nodes and PROTOs that contain themselves, more
/// than `most_vrml_nodes`. Throws InputError with file:line:column. Returns the nodes of every
/// PROTO.
std::map<std::string, double> check_vrml(const VrmlText& file);

/// What a repair of the text did.
struct VrmlDropped {
  std::size_t count = 0;
  Where first;  ///< place of the first one
};

/// Replaces the fields `field` directly within nodes of type `node` by blanks.
VrmlDropped drop_vrml_fields(VrmlText& file, std::string_view node, std::string_view field);

/// Replaces the nodes of a type by empty groups, which are allowed wherever a node is.
VrmlDropped drop_vrml_nodes(VrmlText& file, std::string_view node);

/// Writes the node type `to` over `from`, which is not the shorter one.
VrmlDropped rename_vrml_nodes(VrmlText& file, std::string_view from, std::string_view to);

/// Takes away `field IS event` where the PROTO declares an eventIn or eventOut: events have
/// no value before they happen, and a field without a value keeps its default.
VrmlDropped drop_vrml_events(VrmlText& file);

/// Type of the node that has `field` directly in it on a line.
std::optional<std::string> node_with_field(const VrmlText& file, std::string_view field, int line);

/// Where the first `DEF name` stands.
std::optional<Where> place_of_def(const VrmlText& file, std::string_view name);

}  // namespace sunload
