// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// City objects that belong to others, as parts and installations do to their building.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geo/base/ids.h"

namespace sunload {

using BareId = Id<struct BareTag>;  ///< a city object without surfaces

/// What something belongs to: an object, or a bare one, or nothing.
struct Owner {
  ObjectId object = ObjectId::none();
  BareId bare = BareId::none();
};

/// A city object that is known by name alone: no surface of its own is read.
struct BareObject {
  std::string name, kind;
  Owner owner = {};
};

/// What each object of a model belongs to.
struct Families {
  std::vector<Owner> of_object;  ///< may be fewer than objects: the others belong to nothing
  std::vector<BareObject> bare;
};

/// Objects and bare ones under one number, their place: object o has o, bare one b the number of
/// objects + b.
class FamilyTree {
 public:
  /// What belongs to itself, in however wide a circle, belongs to nothing. All must outlive it;
  /// kinds may be fewer than names: of no type.
  FamilyTree(const std::vector<std::string>& names, const std::vector<std::string>& kinds,
             const Families& families);

  std::size_t size() const { return owner_.size(); }
  std::size_t object_count() const { return names_.size(); }
  const std::string& name(std::size_t place) const;
  const std::string& kind(std::size_t place) const;
  std::optional<std::size_t> owner(std::size_t place) const { return owner_[place]; }
  /// All places, each behind what it belongs to.
  const std::vector<std::size_t>& owners_first() const { return owners_first_; }

 private:
  void add_behind_owners(std::size_t place);

  const std::vector<std::string>&names_, &kinds_;
  const Families& families_;
  std::vector<std::optional<std::size_t>> owner_;
  std::vector<std::size_t> owners_first_;
  std::vector<char> is_added_;  // to owners_first_
};

/// By place: 1 where it is an object, or objects belong to it.
std::vector<char> with_surfaces(const FamilyTree& tree);
/// Names of objects and of all that they belong to.
std::vector<std::string> names_with_surfaces(const FamilyTree& tree);

/// Part of a building, a bridge or a tunnel: a body of its own, as installations are not.
bool is_part_of_body(const std::string& kind);
/// Groups and reliefs hold what stands apart.
bool holds_others_apart(const std::string& kind);

}  // namespace sunload
