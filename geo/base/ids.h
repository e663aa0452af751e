// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Strong indices: an ObjectId cannot be passed where a MaterialId is meant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace sunload {

/// Index into one table; `none` (-1) where there is no entry.
template <class Tag>
struct Id {
  std::int32_t value = -1;

  static constexpr Id none() { return {}; }
  constexpr bool exists() const { return value >= 0; }
  constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 tells it of comparisons
  friend auto operator<=>(const Id&, const Id&) = default;
};

/// The id of that place in its table.
template <class IdType>
constexpr IdType make_id(std::size_t index) {
  return {static_cast<std::int32_t>(index)};
}

using ObjectId = Id<struct ObjectTag>;      ///< a building, a tree, a road of the scene
using MaterialId = Id<struct MaterialTag>;  ///< a row of the table of materials
using FacadeId = Id<struct FacadeTag>;      ///< a connected coplanar wall region of one object

}  // namespace sunload
