// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/light_transport.h"

#include <utility>

#include "solver/transport/gathering.h"
#include "solver/transport/shooting.h"
#include "solver/transport/year_gathering.h"

namespace sunload {

namespace {

/// By the rules of the scene; `tried`: work that was done before it was chosen.
std::unique_ptr<const LightTransport> of_rules(const TracedScene& traced, const WorkDone& tried) {
  if (traced.rules.transport == Transport::shoot) return std::make_unique<Shooting>(traced);
  return std::make_unique<Gathering>(traced, tried);
}

}  // namespace

std::unique_ptr<const LightTransport> transport_of(const TracedScene& traced) {
  return of_rules(traced, {});
}

std::unique_ptr<const LightTransport> transport_of(const TracedScene& traced,
                                                   const LitPeriod& period, Watch& watch,
                                                   std::vector<SolvedNodes> ready) {
  if (!ready.empty()) return std::make_unique<YearGathering>(traced, period, std::move(ready));
  WorkDone tried;
  if (auto year = year_where_it_pays(traced, period, tried, watch)) return year;
  return of_rules(traced, tried);
}

}  // namespace sunload
