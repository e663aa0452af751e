// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Traced lines on the disk: the same bits back, or none.
#include "io/batch/prepared_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "geo/base/check.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

const std::string hash(64, 'a');

LinkTable table(std::size_t rows, std::uint32_t seed) {
  LinkTable table(rows, 100);
  for (auto& block : table.blocks) {
    std::vector<LinkTable::Link> links;
    const std::size_t n = std::min(rows, LinkTable::rows_per_block);
    for (std::size_t row = 0; row < n; ++row) {
      links.clear();
      for (std::uint32_t k = 0; k < (row + seed) % 5; ++k)
        links.push_back({k * 7 + seed, 0.25f * static_cast<float>(k + seed)});
      block.append_row(links, row == 3 ? 0.5f : 1.0f);
    }
  }
  return table;
}

LineSet line_set(std::size_t rows, std::uint32_t seed) {
  LineSet set{table(rows, seed), table(rows, seed + 1), table(rows, seed + 2), {}, {}, {}};
  for (std::size_t i = 0; i < rows; ++i)
    set.ends.push_back({0.1f * static_cast<float>(i), 0.2f, 0.3f, {0.4f, 0.5f, 0.6f, 0.7f, 0.8f}});
  set.lamps.assign(rows, 0.7 + seed);
  set.mirrored_fates = {{1.0 / 3, 4, 7, 6, 10}, {2, 5, 8, static_cast<double>(seed), 11}};
  return set;
}

Lines example() {
  constexpr std::size_t rows = 2500;  // three blocks
  Lines lines;
  for (std::uint32_t r = 0; r < 3; ++r) lines.realizations.push_back(line_set(rows, r));
  lines.pooled = line_set(rows, 9);
  lines.rays = 12345678901;
  for (std::uint32_t patch = 0; patch < rows; patch += 7)
    lines.glimpses.push_back({patch, 2, 5, 1, {1.1f, 2.2f, 3.3f}, {0.6f, 0.8f, 0}, 0.3f});
  return lines;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same(const LinkTable& a, const LinkTable& b) {
  if (a.blocks.size() != b.blocks.size() || a.targets() != b.targets()) return false;
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    LinkTable::Reader of_a(a.blocks[i]), of_b(b.blocks[i]);
    if (a.blocks[i].rows() != b.blocks[i].rows()) return false;
    for (std::size_t row = 0; row < a.blocks[i].rows(); ++row) {
      const std::size_t links = of_a.next_row();
      if (of_b.next_row() != links) return false;
      for (std::size_t l = 0; l < links; ++l) {
        const auto x = of_a.next(), y = of_b.next();
        if (x.target != y.target || x.weight != y.weight) return false;
      }
    }
  }
  return true;
}

bool same(const LineSet& a, const LineSet& b) {
  return same(a.patches, b.patches) && same(a.sky, b.sky) &&
         same(a.sky_by_mirror, b.sky_by_mirror) && same_bits(a.ends, b.ends) &&
         same_bits(a.lamps, b.lamps) && same_bits(a.mirrored_fates, b.mirrored_fates);
}

PackedColumns packed(std::size_t rows, float seed) {
  Columns values = columns(rows);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = seed * static_cast<float>(i * 37 % 101);
  return PackedColumns(values);
}

NodeBlock node_block(std::size_t rows, float seed) {
  NodeBlock block;
  block.patches = {packed(rows, seed), {}, packed(rows, 2 * seed)};
  block.sensors.mirror = packed(3, seed);
  for (std::size_t j = 0; j < block_width; ++j) {
    block.ledger[j].lost_at_backs = static_cast<double>(seed) + static_cast<double>(j);
    block.reflected_first[j] = 1 / (static_cast<double>(seed) + static_cast<double>(j));
  }
  block.circumsolar = {packed(rows, 3 * seed), packed(rows, 4 * seed)};
  block.circumsolar_sky = {{}, {1.5, static_cast<double>(seed)}};
  return block;
}

SolvedNodes example_nodes() {
  constexpr std::size_t rows = 40;
  return {{32, 16, 0.25, 1.0 / 3, true},
          node_block(rows, 0.1f),
          node_block(rows, 0.2f),
          {node_block(rows, 0.3f), node_block(rows, 0.4f)},
          {node_block(rows, 0.5f)}};
}

/// All that is in nodes, as bytes.
class Bytes {
 public:
  explicit Bytes(const SolvedNodes& nodes) { SolvedNodes::visit(nodes, *this); }
  template <class Values>
  void operator()(const Values& values) {
    const std::size_t size = values.size() * sizeof(values[0]);
    all.append(reinterpret_cast<const char*>(&size), sizeof(size));
    if (size > 0) all.append(reinterpret_cast<const char*>(values.data()), size);
  }
  template <class List, class Visit>
  void each(const List& list, Visit&& visit) {
    all.push_back(static_cast<char>(list.size()));
    for (const auto& item : list) visit(item);
  }
  std::string all;
};

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

TEST(PreparedFile, GivesTheSameBitsBack) {
  const WorkFolder folder;
  const Lines lines = example();
  write_prepared(folder / "prepared", hash, lines);
  const auto read = read_prepared(folder / "prepared", hash);
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->nodes.empty());
  const Lines& back = read->lines;
  EXPECT_EQ(back.rays, lines.rays);
  ASSERT_EQ(back.realizations.size(), lines.realizations.size());
  for (std::size_t r = 0; r < lines.realizations.size(); ++r)
    EXPECT_TRUE(same(back.realizations[r], lines.realizations[r])) << r;
  EXPECT_TRUE(same(back.pooled, lines.pooled));
  EXPECT_TRUE(same_bits(back.glimpses, lines.glimpses));
  EXPECT_FALSE(same(back.pooled, lines.realizations[0]));
  EXPECT_EQ(folder.content(), std::vector<std::string>{"prepared"});
}

TEST(PreparedFile, GivesSolvedNodesBack) {
  const WorkFolder folder;
  // Of two bands.
  SolvedNodes red = example_nodes(), green = example_nodes();
  green.reduction = {48, 32, 0.5, 0.25, false};
  green.suns.pop_back();
  write_prepared(folder / "prepared", hash, example(), {&red, &green});
  const auto read = read_prepared(folder / "prepared", hash);
  ASSERT_TRUE(read && read->nodes.size() == 2);
  EXPECT_EQ(read->lines.rays, example().rays);
  for (const auto& [back, written] :
       {std::pair{&read->nodes[0], &red}, {&read->nodes[1], &green}}) {
    EXPECT_EQ(Bytes(*back).all, Bytes(*written).all);
    const Reduction &of = back->reduction, &wanted = written->reduction;
    EXPECT_EQ(of.skies, wanted.skies);
    EXPECT_EQ(of.suns, wanted.suns);
    EXPECT_EQ(of.error_w_m2, wanted.error_w_m2);
    EXPECT_EQ(of.standard_error_w_m2, wanted.standard_error_w_m2);
    EXPECT_EQ(of.is_met, wanted.is_met);
  }
}

TEST(PreparedFile, AnotherHashIsNotBelieved) {
  const WorkFolder folder;
  write_prepared(folder / "prepared", hash, example());
  EXPECT_FALSE(read_prepared(folder / "prepared", std::string(64, 'b')));
  EXPECT_FALSE(read_prepared(folder / "prepared", ""));
}

TEST(PreparedFile, MissingEmptyOrNoFileAtAll) {
  const WorkFolder folder;
  EXPECT_FALSE(read_prepared(folder / "none", hash));
  folder.write("empty", "");
  EXPECT_FALSE(read_prepared(folder / "empty", hash));
  EXPECT_FALSE(read_prepared(folder.path(), hash));
}

TEST(PreparedFile, AnyFlippedBitIsNoticed) {
  const WorkFolder folder;
  const SolvedNodes nodes = example_nodes();
  write_prepared(folder / "prepared", hash, example(), {&nodes});
  const std::string whole = folder.read("prepared");
  constexpr std::size_t probes = 200;
  for (std::size_t probe = 0; probe <= probes; ++probe) {
    std::string damaged = whole;
    const std::size_t at = (whole.size() - 1) * probe / probes;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (probe % 8)));
    write_bytes(folder / "prepared", damaged);
    EXPECT_FALSE(read_prepared(folder / "prepared", hash)) << "byte " << at;
  }
  write_bytes(folder / "prepared", whole);
  EXPECT_TRUE(read_prepared(folder / "prepared", hash));
}

TEST(PreparedFile, CutOrLongerIsNoticed) {
  const WorkFolder folder;
  const SolvedNodes nodes = example_nodes();
  write_prepared(folder / "prepared", hash, example(), {&nodes});
  const std::string whole = folder.read("prepared");
  for (const std::size_t length :
       {std::size_t{1}, std::size_t{15}, std::size_t{16}, std::size_t{20}, std::size_t{100},
        whole.size() / 2, whole.size() - 4, whole.size() - 1}) {
    write_bytes(folder / "prepared", whole.substr(0, length));
    EXPECT_FALSE(read_prepared(folder / "prepared", hash)) << length << " bytes";
  }
  write_bytes(folder / "prepared", whole + "more");
  EXPECT_FALSE(read_prepared(folder / "prepared", hash));
}

TEST(PreparedFile, WhatCannotBeWrittenIsAnErrorOfTheMachine) {
  const WorkFolder folder;
  try {
    write_prepared(folder / "none/prepared", hash, example());
    FAIL() << "was written";
  } catch (const MachineError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sunload::test
