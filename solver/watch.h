/// How long work tells of itself and is stopped; the solver neither prints nor exits.
#pragma once

namespace sunload {

enum class Stage { prepare, lines, light };

class Watch {
 public:
  virtual ~Watch() = default;
  /// Share of a stage that is done, [0, 1]; called from any thread.
  virtual void advance(Stage /*stage*/, double /*share*/) {}
  /// True where the work should end soon: it then throws Interrupted.
  virtual bool stop_requested() { return false; }
};

}  // namespace sunload
