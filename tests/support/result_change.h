// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Changes what a result file holds by the HDF5 library, as a script of a user would: the file
/// stays valid HDF5, and only its content is wrong.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sunload::test {

/// A dataset, or an attribute of one or (no dataset) of the root, with numbers or text.
struct ResultPlace {
  std::string dataset, attribute;
  std::vector<std::size_t> shape;  ///< of an attribute: its one dimension, or none
  bool is_text = false;
};

/// All of a file, in the order of their names.
std::vector<ResultPlace> places_of(const std::string& path);

/// A file that is open for changes; they are written when it is closed.
class ChangedResult {
 public:
  explicit ChangedResult(const std::string& path);
  ~ChangedResult();
  ChangedResult(const ChangedResult&) = delete;
  ChangedResult& operator=(const ChangedResult&) = delete;

  /// Element `index` of a dataset or attribute (in the order of storage); all of them without it.
  void set(const ResultPlace& place, double value, std::size_t index) const;
  void set(const ResultPlace& place, double value) const;
  void set(const ResultPlace& place, const std::string& text, std::size_t index) const;
  void set(const ResultPlace& place, const std::string& text) const;
  /// The dataset with another shape: its values from the first on, zeros or "" behind them.
  void reshape(const ResultPlace& place, const std::vector<std::size_t>& shape) const;
  /// Texts in place of numbers, numbers in place of texts.
  void retype(const ResultPlace& place) const;
  void remove(const ResultPlace& place) const;

 private:
  std::int64_t file_;
};

/// The same for a dataset by its name.
void change_number(const std::string& path, const std::string& dataset, std::size_t index,
                   double value);

}  // namespace sunload::test
