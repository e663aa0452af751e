// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How light goes from patch to patch: what every transport does, and the choice among them.
///
/// A new one implements `LightTransport`, and has its line in `of_rules`.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/base/watch.h"
#include "solver/light/lit_period.h"
#include "solver/light/work.h"
#include "solver/traced/ray_record.h"
#include "solver/traced/traced_scene.h"
#include "solver/transport/solved_nodes.h"

namespace sunload {

/// Intervals with light that are solved side by side, at most `block_width`.
struct Block {
  std::span<const IntervalLight> suns;
  std::span<const std::size_t> rows;  ///< the place of each in the batch
};

/// Light of one batch of suns: its blocks in order, then the end.
class BatchTransport {
 public:
  virtual ~BatchTransport() = default;
  /// E = E_0 + G rho E of a block, put into the tallies.
  virtual void light(const Block& block) = 0;
  /// After the last block: what needs the whole batch.
  virtual void finish() = 0;
};

/// A way to solve batches on one traced scene, which must outlive it. Const once built: batches may
/// be begun one after another.
class LightTransport {
 public:
  explicit LightTransport(const TracedScene& traced) : traced_(traced) {}
  virtual ~LightTransport() = default;
  LightTransport(const LightTransport&) = delete;
  LightTransport& operator=(const LightTransport&) = delete;

  const TracedScene& traced() const { return traced_; }
  /// Begins a batch. `tallies`: one per band. `record`: of what its rays bring, read or written by
  /// transports that gather; or null. All three must outlive what is returned.
  virtual std::unique_ptr<BatchTransport> begin(std::vector<BatchTally>& tallies, WorkDone& work,
                                                RayRecord* record) const = 0;
  /// Work done before any batch, beside `TracedScene::work`.
  const WorkDone& work() const { return work_; }
  /// How near few solutions come; null where each interval has its own solution.
  virtual const Reduction* reduction() const { return nullptr; }
  /// The few solutions, of each band; empty where each interval has its own.
  virtual std::vector<const SolvedNodes*> nodes() const { return {}; }

 protected:
  const TracedScene& traced_;
  WorkDone work_;
};

/// The one that the rules of the scene ask for; `traced` must outlive it.
std::unique_ptr<const LightTransport> transport_of(const TracedScene& traced);
/// The same for a whole period, which few solutions may serve (SolverRules::year); `period` must
/// outlive it, too. `ready`: such solutions, of an equal scene and period; empty: they are still to
/// be solved. Throws Interrupted.
std::unique_ptr<const LightTransport> transport_of(const TracedScene& traced,
                                                   const LitPeriod& period, Watch& watch,
                                                   std::vector<SolvedNodes> ready = {});

}  // namespace sunload
