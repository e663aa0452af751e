// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/line_row.h"

namespace sunload {

namespace {

/// The links of a collector, and the tables they go to.
struct Table {
  std::vector<LinkTable::Link> LineCollector::*links;
  LinkTable LineSet::*table;
};
constexpr std::array<Table, 3> all_tables{
    Table{&LineCollector::patches, &LineSet::patches}, Table{&LineCollector::sky, &LineSet::sky},
    Table{&LineCollector::sky_by_mirror, &LineSet::sky_by_mirror}};

float share_of_one(std::size_t lines) { return 1.0f / static_cast<float>(lines); }

void store_ends(LineSet& set, std::size_t row, std::size_t lines, const LineEnds& ends,
                double lamps) {
  const float share = share_of_one(lines);
  set.ends[row] = {.sky = ends.sky * share,
                   .ground = ends.ground * share,
                   .ground_by_mirror = ends.ground_by_mirror * share,
                   .fate = scaled(ends.fate, share)};
  if (!set.lamps.empty()) set.lamps[row] = lamps / static_cast<double>(lines);
}

}  // namespace

void LineRow::begin(double largest_link) {
  own_.clear();
  own_.largest_link = largest_link;
  for (auto& end : end_) end.clear();
  ends_.clear();
  lamps_.clear();
}

void LineRow::end_realization(std::size_t receiver, std::vector<Glimpse>& glimpses) {
  for (Glimpse& glimpse : own_.glimpses) {
    glimpse.receiver = static_cast<std::uint32_t>(receiver);
    glimpse.realization = static_cast<std::uint32_t>(ends_.size());
    glimpses.push_back(glimpse);
  }
  own_.glimpses.clear();
  for (std::size_t t = 0; t < all_tables.size(); ++t)
    end_[t].push_back(static_cast<std::uint32_t>((own_.*all_tables[t].links).size()));
  ends_.push_back(own_.ends);
  own_.ends = {};
  lamps_.push_back(own_.lamps);
  own_.lamps = 0;
}

void LineRow::store(std::size_t row, std::size_t lines_each, Lines& lines) {
  const std::size_t block = row / LinkTable::rows_per_block;
  const std::size_t lines_of_all = lines_each * lines.realizations.size();
  for (std::size_t t = 0; t < all_tables.size(); ++t) {
    const auto table = all_tables[t].table;
    split_.sort(own_.*all_tables[t].links, end_[t]);
    for (std::size_t r = 0; r < lines.realizations.size(); ++r)
      (lines.realizations[r].*table)
          .blocks[block]
          .append_merged(split_.of_part(r), share_of_one(lines_each));
    (lines.pooled.*table).blocks[block].append_merged(split_.of_all(), share_of_one(lines_of_all));
  }
  LineEnds ends;
  double lamps = 0;
  for (std::size_t r = 0; r < lines.realizations.size(); ++r) {
    store_ends(lines.realizations[r], row, lines_each, ends_[r], lamps_[r]);
    ends.sky += ends_[r].sky;
    ends.ground += ends_[r].ground;
    ends.ground_by_mirror += ends_[r].ground_by_mirror;
    ends.fate += ends_[r].fate;
    lamps += lamps_[r];
  }
  store_ends(lines.pooled, row, lines_of_all, ends, lamps);
}

}  // namespace sunload
