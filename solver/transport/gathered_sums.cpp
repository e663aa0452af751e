// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/gathered_sums.h"

#include <utility>

namespace sunload {

TimeSums empty_sums(const TracedScene& traced) {
  TimeSums sums(static_cast<std::size_t>(traced.rules.realizations), traced.patches.count(),
                traced.sensors.count(), static_cast<std::size_t>(traced.grid.cell_count()));
  if (traced.optics.any_glossy) sums.on_patches.gloss = sums.on_patches.mirror;
  return sums;
}

void book_sent_on(const TracedScene& traced, const Block& block,
                  const std::vector<SunFates>& sent_on, TimeSums& sums, BatchTally& tally) {
  const double of_one = 1.0 / static_cast<double>(traced.rules.realizations);
  for (std::size_t r = 0; r < sent_on.size(); ++r)
    for (std::size_t k = 0; k < block.suns.size(); ++k) {
      const Ledger fate = booked(sent_on[r][k]);
      tally.ledger[block.rows[k]] += scaled(fate, of_one);
      sums.sent_on[r] += scaled(fate, block.suns[k].length_s);
    }
  for (const Ledger& of_realization : traced.patches.lamps.ledger)
    for (std::size_t k = 0; k < block.suns.size(); ++k)
      tally.ledger[block.rows[k]] += scaled(of_realization, of_one);
}

void put_rows(const std::vector<Ledger>& of_block, const Block& block,
              std::vector<Ledger>& ledger) {
  for (std::size_t k = 0; k < of_block.size(); ++k) ledger[block.rows[k]] = of_block[k];
}

RayColumns taken(SunColumns& columns, std::size_t r) {
  return {std::move(columns.direct[r]), std::move(columns.mirror[r]),
          std::move(columns.circumsolar[r])};
}

}  // namespace sunload
