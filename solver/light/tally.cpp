// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/light/tally.h"

#include "geo/base/check.h"
#include "solver/base/spread.h"

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
  for (std::size_t p = 0; p < part_count; ++p) {
    if (!shape.parts[p]) continue;
    if (shape.series[p] || static_cast<Part>(p) == Part::total)
      tally.irradiance[p].assign(values, 0);
    tally.exposure[p].assign(receivers, 0);
    if (static_cast<Part>(p) != Part::total)
      tally.part_realization[p].assign(shape.realizations, std::vector<double>(receivers, 0));
  }
  tally.exposure_realization.assign(shape.realizations, std::vector<double>(receivers, 0));
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

MeanError mean_error(const std::vector<double>& values) {
  const std::size_t n = values.size();
  const auto value = [&](std::size_t r) { return values[r]; };
  const double mean = mean_of(n, value);
  return {mean, standard_error(variance_about(mean, n, value), n)};
}

}  // namespace sunload
