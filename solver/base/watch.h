// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How long work tells of itself; the solver neither prints nor exits. It is
/// stopped by set_cancellation of solver/base/threads.
#pragma once

namespace sunload {

/// `nodes`: the skies and suns that a long period is made up of.
enum class Stage { prepare, refine, lines, nodes, light };

/// Receives how far a stage has come and how many rays were cast; as it is, ignores both.
class Watch {
 public:
  virtual ~Watch() = default;
  /// Share of a stage that is done, [0, 1]; called from any thread.
  virtual void advance(Stage /*stage*/, double /*share*/) {}
  /// So many rays were cast since the last call; called from any thread, before `advance`.
  virtual void cast(double /*rays*/) {}
};

}  // namespace sunload
