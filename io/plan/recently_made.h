// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Values that were made for keys, kept as long as there is room.
#pragma once

#include <cstddef>
#include <iterator>
#include <list>
#include <map>
#include <string>
#include <utility>

namespace sunload {

/// Keeps values by key. The last one is kept whatever its weight; the oldest are dropped while all
/// together are heavier than `most`.
template <class T>
class RecentlyMade {
 public:
  explicit RecentlyMade(double most) : most_(most) {}

  /// Null where there is none (any longer). Stays until the next `keep`.
  T* of(const std::string& key) {
    const auto found = place_.find(key);
    return found == place_.end() ? nullptr : &found->second->value;
  }

  /// A key that is new.
  T& keep(const std::string& key, T value, double weight) {
    total_ += weight;
    while (!items_.empty() && total_ > most_) {
      total_ -= items_.front().weight;
      place_.erase(items_.front().key);
      items_.pop_front();
    }
    items_.push_back({key, std::move(value), weight});
    place_[key] = std::prev(items_.end());
    return items_.back().value;
  }

 private:
  struct Item {
    std::string key;
    T value;
    double weight;
  };
  double most_, total_ = 0;
  std::list<Item> items_;  ///< the oldest first
  std::map<std::string, typename std::list<Item>::iterator> place_;
};

}  // namespace sunload
