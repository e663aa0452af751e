// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which geometries of which city objects are read.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/scene/base/from_file.h"
#include "io/scene/base/lod.h"

namespace sunload {

/// The geometries of one object that are read: all of one level of detail.
struct GeometryChoice {
  const nlohmann::json* object = nullptr;
  std::string type;
  std::vector<std::size_t> geometries;  ///< places in the list `geometry` of the object
  LodRank rank{};
  std::string owner = {};  ///< id of the object that it belongs to; empty: to none of the document
};

/// The template that a GeometryInstance shows; throws InputError if there is none.
using TemplateOf = std::function<const nlohmann::json&(
    const nlohmann::json& instance, const std::string& object, std::size_t geometry)>;

/// Choice per object id, by the rules of `read_scene_cityjson`; `where` is the document.
std::map<std::string, GeometryChoice> choose_geometries(const nlohmann::json& city_objects,
                                                        const LodWish& wish,
                                                        const TemplateOf& template_of,
                                                        const Where& where, NoteCounter& notes);

}  // namespace sunload
