// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Ranks of an MPI program: the only file that knows MPI, which is optional.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace sunload {

/// Whether this build has MPI.
bool has_mpi();

/// The ranks that were started together; they share a counter per variant.
class MpiWorld {
 public:
  /// Whether mpirun or srun has started several ranks, of which this process is one.
  static bool is_launched();
  /// Null where none has. Throws InputError where this build has no MPI, or one that knows of other
  /// ranks than the launcher.
  static std::unique_ptr<MpiWorld> join(std::size_t variants);
  ~MpiWorld();

  std::size_t rank() const;
  std::size_t size() const;
  bool is_first() const { return rank() == 0; }
  /// Takes the next number, 0, 1, …, of a variant's counter.
  std::size_t next_of(std::size_t variant);
  /// Returns when every rank is here.
  void wait_for_all();
  /// True on every rank where it is true on any of them.
  bool any(bool here);
  /// Whether all ranks have the same number.
  bool all_have(std::uint64_t here);

 private:
  MpiWorld();
  struct Ranks;
  std::unique_ptr<Ranks> ranks_;
};

/// Whether a process says what all that work in `world` would say of the study: the first of them,
/// and one that works alone (null).
inline bool speaks_for_all(const MpiWorld* world) { return !world || world->is_first(); }

}  // namespace sunload
