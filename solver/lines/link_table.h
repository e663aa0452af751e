// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The links of lines, in little memory: one word for nearly every link.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunload {

/// Weighted links of patches to targets (elements of the mesh, cells of the sky), compressed rows
/// in blocks.
///
/// Most links stand for lines of one row that ended on the same target, each of the same weight:
/// one word has the target and how many they are. Weights that are no such number (what mirrors
/// sent on, shares of lines) are kept beside the words.
class LinkTable {
 public:
  static constexpr std::size_t rows_per_block = 1024;
  static constexpr std::size_t most_targets = std::size_t{1} << 31;
  /// Part `weight` of a target's radiosity, or of a cell's π·radiance, in the irradiance of the
  /// row.
  struct Link {
    std::uint32_t target;
    float weight;
  };
  class Reader;
  /// Consecutive rows, which are only appended; read with Reader.
  class Block {
   public:
    /// Of links to targets below `targets`.
    explicit Block(std::size_t targets);
    /// Appends a row: sorted by target, equal targets merged. A weight of 1 in `links` is worth
    /// `unit`.
    void append_row(std::vector<Link>& links, float unit);
    /// The same of links that are sorted and merged.
    void append_merged(std::span<const Link> links, float unit);
    /// Frees what room is left.
    void trim();

    std::size_t rows() const { return begin_.size() - 1; }
    std::size_t link_count() const { return word_.size(); }
    std::size_t link_count(std::size_t row) const { return begin_[row + 1] - begin_[row]; }
    /// Calls `array` for each array, to write or to read it.
    template <class Self, class Array>
    static void visit(Self& self, Array&& array) {
      array(self.begin_);
      array(self.word_);
      array(self.unit_);
      array(self.other_);
    }

   private:
    friend Reader;
    void append_unit(float unit);
    std::uint32_t target_mask() const { return (std::uint32_t{1} << target_bits_) - 1; }
    float unit(std::size_t row) const { return unit_.size() == 1 ? unit_[0] : unit_[row]; }

    std::uint32_t target_bits_;
    std::vector<std::uint32_t> begin_{0};  ///< rows + 1
    /// Target, and above its bits the number of lines; 0: the weight is the next of `other_`.
    std::vector<std::uint32_t> word_;
    std::vector<float> unit_;      ///< of every row; one where all have the same
    std::vector<float> other_{0};  ///< by link; one more at the end, as Reader reads ahead
  };
  LinkTable() = default;
  LinkTable(std::size_t rows, std::size_t targets);
  std::vector<Block> blocks;
  std::size_t targets() const { return targets_; }

 private:
  std::size_t targets_ = 0;
};

/// Reads the links of a block, row after row.
class LinkTable::Reader {
 public:
  explicit Reader(const Block& block)
      : block_(block), word_(block.word_.data()), other_(block.other_.data()) {}
  /// Goes to the first row, then to the next; returns how many links it has.
  std::size_t next_row() {
    unit_ = block_.unit(row_);
    return block_.link_count(row_++);
  }
  /// The next link of the row.
  Link next() {
    const std::uint32_t word = *word_++, lines = word >> block_.target_bits_;
    // Without a branch: which links are of whole lines is as good as random.
    const float other = *other_;
    other_ += lines == 0;
    return {word & block_.target_mask(), lines == 0 ? other : static_cast<float>(lines) * unit_};
  }
  /// Target of the link so many after the next one; of the last one if there are fewer.
  std::uint32_t target_ahead(std::size_t links) const {
    const std::uint32_t* const last = block_.word_.data() + block_.word_.size() - 1;
    return *std::min(word_ + links, last) & block_.target_mask();
  }

 private:
  const Block& block_;
  const std::uint32_t* word_;
  const float* other_;
  std::size_t row_ = 0;
  float unit_ = 0;
};

}  // namespace sunload
