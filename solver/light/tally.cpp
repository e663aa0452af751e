// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/light/tally.h"

#include <algorithm>

#include "geo/base/check.h"
#include "solver/base/chunks.h"
#include "solver/base/spread.h"
#include "solver/base/threads.h"

namespace sunload {

double Ledger::in() const {
  const Ledger& l = *this;
  return l[Term::sun] + l[Term::sky] + l[Term::ground] + l[Term::emitted];
}

double Ledger::out() const {
  const Ledger& l = *this;
  return l[Term::absorbed] + l[Term::transmitted] + l[Term::escaped] + l[Term::unshot];
}

Ledger& Ledger::operator+=(const Ledger& other) {
  for (std::size_t t = 0; t < term_count; ++t) terms[t] += other.terms[t];
  lost_at_backs += other.lost_at_backs;
  estimated += other.estimated;
  return *this;
}

double ledger_line(const Ledger& ledger, std::size_t line) {
  if (line < term_count) return ledger.terms[line];
  return line == residual_line ? ledger.residual() : ledger.estimated;
}

Ledger scaled(Ledger ledger, double factor) {
  for (auto& term : ledger.terms) term *= factor;
  ledger.lost_at_backs *= factor;
  ledger.estimated *= factor;
  return ledger;
}

Ledger booked(const Fate<double>& fate, Ledger ledger) {
  ledger[Term::absorbed] += fate.backs;
  ledger[Term::absorbed] += fate.absorbed;
  ledger[Term::transmitted] += fate.transmitted;
  ledger[Term::escaped] += fate.escaped;
  ledger[Term::unshot] += fate.cut;
  ledger.lost_at_backs += fate.backs;
  return ledger;
}

namespace {

void make_room(ReceiverTally& tally, std::size_t receivers, const TallyShape& shape) {
  const std::size_t values = shape.intervals * receivers;
  // Shots are added to all realizations as they come. Where lines gather, realizations are solved
  // at the end, when other things have gone.
  const std::vector<std::vector<double>> of_realizations(
      shape.realizations,
      std::vector<double>(shape.transport == Transport::shoot ? receivers : 0, 0));
  for (std::size_t p = 0; p < part_count; ++p) {
    if (!shape.parts[p]) continue;
    if (shape.series[p] || static_cast<Part>(p) == Part::total)
      tally.irradiance[p].assign(values, 0);
    tally.exposure[p].assign(receivers, 0);
    if (static_cast<Part>(p) != Part::total) tally.part_realization[p] = of_realizations;
  }
  tally.exposure_realization = of_realizations;
  tally.sunlit_s.assign(receivers, 0);
  tally.irradiance_max.assign(receivers, 0);
  if (shape.errors == Errors::instants) tally.irradiance_se.assign(values, 0);
  const auto sums = [&](Part part) {
    return std::vector<double>(shape.parts[static_cast<std::size_t>(part)] ? receivers : 0, 0);
  };
  for (const PartOfBatch& period : shape.periods) {
    SUNLOAD_EXPECT(period.share.size() == shape.intervals, "a share of every interval");
    tally.parts.push_back(
        {period, sums(Part::total), sums(Part::direct), tally.sunlit_s,
         std::vector<std::vector<double>>(period.with_errors ? shape.realizations : 0,
                                          std::vector<double>(receivers, 0))});
  }
}

}  // namespace

BatchTally empty_tally(const TallyShape& shape) {
  BatchTally tally;
  tally.intervals = shape.intervals;
  make_room(tally, shape.patches, shape);
  make_room(tally.sensors, shape.sensors, shape);
  tally.outgoing.assign(shape.patches, 0);
  tally.ledger.resize(shape.intervals);
  tally.ledger_realization.resize(shape.realizations);
  if (shape.by_source && shape.transport == Transport::shoot) {
    const std::vector<std::vector<double>> zeros(shape.realizations,
                                                 std::vector<double>(shape.patches, 0));
    tally.by_source = {zeros, zeros, zeros, zeros};
  }
  if (shape.by_source && shape.errors == Errors::instants) {
    const std::vector<float> zeros(shape.intervals * shape.patches, 0);
    tally.se_by_source = {zeros, zeros, zeros};
  }
  if (shape.errors == Errors::instants)
    tally.ledger_instants.assign(shape.realizations, std::vector<Ledger>(shape.intervals));
  return tally;
}

namespace {

/// `Rows`: a vector.
template <class Rows>
void put_rows(const Rows& rows, std::size_t first, std::size_t width, Rows& whole) {
  if (whole.empty()) return;
  std::copy(rows.begin(), rows.end(), whole.begin() + static_cast<std::ptrdiff_t>(first * width));
}

void add_to(const std::vector<double>& values, std::vector<double>& sums) {
  if (sums.empty()) return;
  for (std::size_t i = 0; i < values.size(); ++i) sums[i] += values[i];
}

void add_to(const std::vector<std::vector<double>>& values,
            std::vector<std::vector<double>>& sums) {
  for (std::size_t r = 0; r < values.size() && r < sums.size(); ++r)
    if (sums[r].empty())
      sums[r] = values[r];
    else
      add_to(values[r], sums[r]);
}

void round_to_single(std::vector<std::vector<double>>& rows) {
  for (auto& row : rows)
    parallel_for(
        row.size(),
        [&](std::size_t i) { row[i] = static_cast<double>(static_cast<float>(row[i])); },
        receivers_per_chunk);
}

void round_realizations_of(ReceiverTally& tally) {
  round_to_single(tally.exposure_realization);
  for (auto& of_part : tally.part_realization) round_to_single(of_part);
  for (PartTally& part : tally.parts) round_to_single(part.exposure_realization);
}

void put_received(const ReceiverTally& stretch, std::size_t first, ReceiverTally& whole) {
  const std::size_t receivers = whole.sunlit_s.size();
  for (std::size_t p = 0; p < part_count; ++p) {
    put_rows(stretch.irradiance[p], first, receivers, whole.irradiance[p]);
    add_to(stretch.exposure[p], whole.exposure[p]);
    add_to(stretch.part_realization[p], whole.part_realization[p]);
    // A part that the scene of these intervals does not have, and that of others does.
    if (stretch.part_realization[p].empty())
      for (auto& row : whole.part_realization[p]) row.resize(receivers, 0);
  }
  put_rows(stretch.irradiance_se, first, receivers, whole.irradiance_se);
  add_to(stretch.exposure_realization, whole.exposure_realization);
  add_to(stretch.sunlit_s, whole.sunlit_s);
  for (std::size_t i = 0; i < receivers; ++i)
    whole.irradiance_max[i] = std::max(whole.irradiance_max[i], stretch.irradiance_max[i]);
  for (std::size_t p = 0; p < whole.parts.size(); ++p) {
    const PartTally& from = stretch.parts[p];
    PartTally& to = whole.parts[p];
    add_to(from.total, to.total);
    add_to(from.direct, to.direct);
    add_to(from.sunlit_s, to.sunlit_s);
    add_to(from.exposure_realization, to.exposure_realization);
  }
}

}  // namespace

void round_realizations(BatchTally& tally) {
  round_realizations_of(tally);
  round_realizations_of(tally.sensors);
}

void put_stretch(const BatchTally& stretch, std::size_t first, BatchTally& whole) {
  SUNLOAD_EXPECT(first + stretch.intervals <= whole.intervals, "a stretch within its batch");
  SUNLOAD_EXPECT(whole.by_source.sun.empty() && whole.se_by_source.lines.empty(),
                 "a tally that is not by source");
  put_received(stretch, first, whole);
  put_received(stretch.sensors, first, whole.sensors);
  add_to(stretch.outgoing, whole.outgoing);
  put_rows(stretch.ledger, first, 1, whole.ledger);
  for (std::size_t r = 0; r < whole.ledger_realization.size(); ++r)
    whole.ledger_realization[r] += stretch.ledger_realization[r];
  whole.energy += stretch.energy;
  for (std::size_t r = 0; r < whole.ledger_instants.size(); ++r)
    put_rows(stretch.ledger_instants[r], first, 1, whole.ledger_instants[r]);
}

MeanError mean_error(const std::vector<double>& values) {
  const std::size_t n = values.size();
  const auto value = [&](std::size_t r) { return values[r]; };
  const double mean = mean_of(n, value);
  return {mean, standard_error(variance_about(mean, n, value), n)};
}

}  // namespace sunload
