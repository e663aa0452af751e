// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/batch/prepared_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "io/base/deflate.h"
#include "io/base/file_aside.h"
#include "io/base/file_writing.h"

namespace sunload {

namespace {

// Layout, in the byte order of the machine: prepared_magic, content hash and counts, CRC-32
// of these, the arrays of `visit_set`, CRC-32 of all before, then of each band that has
// nodes the reduction and the arrays of SolvedNodes, an empty array, CRC-32 of all before.
// An array is its length and its bytes.
constexpr char prepared_magic[16] = "sunload-lines-7";

/// Calls `array` for every array of the lines, in the order of the file.
template <class Set, class Array>
void visit_set(Set& set, Array&& array) {
  for (auto* table : {&set.patches, &set.sky, &set.sky_by_mirror})
    for (auto& block : table->blocks) LinkTable::Block::visit(block, array);
  array(set.ends);
  array(set.lamps);
  array(set.mirrored_fates);
}

class PreparedOutput {
 public:
  explicit PreparedOutput(const std::string& path) : path_(path), file_(path, std::ios::binary) {
    if (!file_) error_ = errno;
  }
  void bytes(const void* data, std::size_t count) {
    crc_ = crc32(data, count, crc_);
    file_.write(static_cast<const char*>(data), static_cast<std::streamsize>(count));
    if (!file_ && error_ == 0) error_ = errno;
  }
  template <class T, class Memory>
  void operator()(const std::vector<T, Memory>& values) {
    const std::uint64_t count = values.size();
    bytes(&count, sizeof(count));
    bytes(values.data(), count * sizeof(T));
  }
  template <class T, std::size_t size>
  void operator()(const std::array<T, size>& values) {
    bytes(values.data(), sizeof(values));
  }
  template <class T, class Visit>
  void each(const std::vector<T>& list, Visit&& visit) {
    const std::uint64_t count = list.size();
    bytes(&count, sizeof(count));
    for (const T& item : list) visit(item);
  }
  void checksum() {
    const std::uint32_t of_all_before = crc_;
    bytes(&of_all_before, sizeof(of_all_before));
  }
  void finish() {
    file_.close();
    if (!file_) throw_cannot_write(path_, error_ != 0 ? error_ : errno);
  }

 private:
  std::string path_;
  std::ofstream file_;
  int error_ = 0;  ///< number of the first error
  std::uint32_t crc_ = 0;
};

/// Reads arrays from a file that may be damaged: never more than it holds.
class Input {
 public:
  explicit Input(const std::string& path) {
    std::error_code unreadable;
    if (!std::filesystem::is_regular_file(path, unreadable)) return;
    file_.open(path, std::ios::binary | std::ios::ate);
    if (!file_) return;
    left_ = static_cast<std::size_t>(file_.tellg());
    file_.seekg(0);
  }
  bool take(void* to, std::size_t count) {
    if (count > left_ || !file_.read(static_cast<char*>(to), static_cast<std::streamsize>(count)))
      return false;
    crc_ = crc32(to, count, crc_);
    left_ -= count;
    return true;
  }
  template <class T, class Memory>
  void operator()(std::vector<T, Memory>& values) {
    const std::uint64_t count = take_count(sizeof(T));
    if (!good_) return;
    values.resize(count);
    good_ = take(values.data(), count * sizeof(T));
  }
  template <class T, std::size_t size>
  void operator()(std::array<T, size>& values) {
    good_ = good_ && take(values.data(), sizeof(values));
  }
  template <class T, class Visit>
  void each(std::vector<T>& list, Visit&& visit) {
    // An item has the length of an array at least.
    const std::uint64_t count = take_count(sizeof(std::uint64_t));
    for (std::uint64_t i = 0; good_ && i < count; ++i) visit(list.emplace_back());
  }
  /// What was read so far is what was written.
  bool is_right() {
    const std::uint32_t of_all_before = crc_;
    std::uint32_t said = 0;
    return good_ && take(&said, sizeof(said)) && said == of_all_before;
  }
  /// A line set has lengths of several arrays, and four bytes or more for each of its rows.
  bool can_hold(std::uint64_t realizations, std::uint64_t rows) const {
    return rows <= left_ / sizeof(std::uint32_t) &&
           realizations <= left_ / (sizeof(std::uint64_t) + rows * sizeof(std::uint32_t));
  }
  bool is_at_end() const { return left_ == 0; }

 private:
  /// Of items that take so many bytes or more; what the file cannot hold is not good.
  std::uint64_t take_count(std::size_t bytes_each) {
    std::uint64_t count = 0;
    good_ = good_ && take(&count, sizeof(count)) && count <= left_ / bytes_each;
    return good_ ? count : 0;
  }

  std::ifstream file_;
  std::size_t left_ = 0;
  std::uint32_t crc_ = 0;
  bool good_ = true;
};

std::vector<double> numbers_of(const Reduction& reduction) {
  return {static_cast<double>(reduction.skies), static_cast<double>(reduction.suns),
          reduction.error_w_m2, reduction.standard_error_w_m2, reduction.is_met ? 1.0 : 0.0};
}

Reduction reduction_of(const std::vector<double>& numbers) {
  return {static_cast<std::size_t>(numbers[0]), static_cast<std::size_t>(numbers[1]), numbers[2],
          numbers[3], numbers[4] != 0};
}

}  // namespace

void write_prepared(const std::string& path, const std::string& content_hash, const Lines& lines,
                    const std::vector<const SolvedNodes*>& nodes) {
  FileAside target(path);
  PreparedOutput out(target.aside());
  out.bytes(prepared_magic, sizeof(prepared_magic));
  out(std::vector<char>(content_hash.begin(), content_hash.end()));
  out(std::vector<std::uint64_t>{lines.realizations.size(), lines.pooled.ends.size(), lines.rays,
                                 lines.pooled.patches.targets(), lines.pooled.sky.targets()});
  out.checksum();
  for (const auto& set : lines.realizations) visit_set(set, out);
  visit_set(lines.pooled, out);
  out(lines.glimpses);
  out.checksum();
  for (const SolvedNodes* of_band : nodes) {
    out(numbers_of(of_band->reduction));
    SolvedNodes::visit(*of_band, out);
  }
  out(std::vector<double>());
  out.checksum();
  out.finish();
  // Its checksum tells what a lost power supply has spoilt.
  target.publish_unflushed();
}

std::optional<Prepared> read_prepared(const std::string& path, const std::string& content_hash) {
  Input in(path);
  char word[sizeof(prepared_magic)];
  if (!in.take(word, sizeof(word)) ||
      std::memcmp(word, prepared_magic, sizeof(prepared_magic)) != 0)
    return {};
  std::vector<char> hash;
  std::vector<std::uint64_t> counts;
  in(hash);
  in(counts);
  // Before damaged counts ask for memory.
  if (!in.is_right() || std::string(hash.begin(), hash.end()) != content_hash) return {};
  if (counts.size() != 5 || !in.can_hold(counts[0], counts[1])) return {};
  if (std::max(counts[3], counts[4]) > LinkTable::most_targets) return {};
  Prepared prepared;
  Lines& lines = prepared.lines;
  const auto rows = static_cast<std::size_t>(counts[1]);
  const auto elements = static_cast<std::size_t>(counts[3]);
  const auto cells = static_cast<std::size_t>(counts[4]);
  const LineSet empty = empty_line_set(rows, elements, cells, false);
  lines.realizations.assign(static_cast<std::size_t>(counts[0]), empty);
  lines.pooled = empty;
  lines.rays = counts[2];
  for (auto& set : lines.realizations) visit_set(set, in);
  visit_set(lines.pooled, in);
  in(lines.glimpses);
  if (!in.is_right()) return {};
  for (;;) {
    std::vector<double> reduction;
    in(reduction);
    if (reduction.empty()) break;
    if (reduction.size() != numbers_of({}).size() || prepared.nodes.size() == band_count) return {};
    SolvedNodes& of_band = prepared.nodes.emplace_back();
    of_band.reduction = reduction_of(reduction);
    SolvedNodes::visit(of_band, in);
  }
  if (!in.is_right() || !in.is_at_end()) return {};
  return prepared;
}

}  // namespace sunload
