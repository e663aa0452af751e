// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/mpi_world.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <string>
#include <thread>
#include <vector>

#include "geo/base/check.h"

#ifdef SUNLOAD_WITH_MPI
#include <mpi.h>
#endif

namespace sunload {

namespace {

/// Ranks that the launcher says it started, 1 if there is no launcher.
std::size_t launched_ranks() {
  const auto number = [](const char* value) { return std::strtoul(value, nullptr, 10); };
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* value = std::getenv(name)) return number(value);
  // srun --mpi=pmix leaves the count to Slurm; without PMIx its tasks know nothing of each other.
  if (const char* value = std::getenv("SLURM_STEP_NUM_TASKS"); value && std::getenv("PMIX_RANK"))
    return number(value);
  return 1;
}

}  // namespace

bool MpiWorld::is_launched() { return launched_ranks() > 1; }

bool has_mpi() {
#ifdef SUNLOAD_WITH_MPI
  return true;
#else
  return false;
#endif
}

#ifdef SUNLOAD_WITH_MPI

namespace {
/// Between two looks at what other ranks want: short beside a batch.
constexpr std::chrono::milliseconds pause{2};
}  // namespace

struct MpiWorld::Ranks {
  explicit Ranks(std::size_t variants) : taken(variants) {
    int threads = MPI_THREAD_SINGLE;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_MULTIPLE, &threads);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    expect_launched_ranks();
    is_dynamic = threads == MPI_THREAD_MULTIPLE;
    if (rank == 0 && is_dynamic)
      attendant = std::jthread([this](const std::stop_token& end) { attend(end); });
  }
  /// Under a launcher whose protocol the library does not speak every process would be alone, and
  /// compute everything.
  void expect_launched_ranks() const {
    if (static_cast<std::size_t>(size) == launched_ranks()) return;
    throw InputError({}, fmt::format("started as one of {} ranks", launched_ranks()),
                     fmt::format("but the MPI of this build knows of {}: it is another than that "
                                 "of the launcher",
                                 size),
                     "start with the mpirun of OpenMPI or srun --mpi=pmix, or use --shard auto");
  }
  ~Ranks() {
    attendant = {};
    // After an exception the other ranks may never come: no collective call then.
    if (std::uncaught_exceptions() == 0) MPI_Finalize();
  }

  /// The first rank keeps the counters. Messages rather than remote memory, which
  /// plain networks serve only while the first rank is within MPI: others would
  /// wait for the end of its batch.
  void attend(const std::stop_token& end) {
    while (!end.stop_requested()) {
      int is_asked = 0;
      MPI_Status from{};
      MPI_Iprobe(MPI_ANY_SOURCE, counter_tag, MPI_COMM_WORLD, &is_asked, &from);
      if (is_asked == 0) {
        std::this_thread::sleep_for(pause);
        continue;
      }
      unsigned long number = 0;
      MPI_Recv(&number, 1, MPI_UNSIGNED_LONG, from.MPI_SOURCE, counter_tag, MPI_COMM_WORLD,
               MPI_STATUS_IGNORE);
      number = taken[number]++;
      MPI_Send(&number, 1, MPI_UNSIGNED_LONG, from.MPI_SOURCE, counter_tag, MPI_COMM_WORLD);
    }
  }

  unsigned long next_of(std::size_t variant) {
    // An MPI without threads: every rank its fixed share.
    if (!is_dynamic)
      return static_cast<unsigned long>(rank) + static_cast<unsigned long>(size) * taken[variant]++;
    if (rank == 0) return taken[variant]++;
    const unsigned long asked = variant;
    unsigned long number = 0;
    MPI_Sendrecv(&asked, 1, MPI_UNSIGNED_LONG, 0, counter_tag, &number, 1, MPI_UNSIGNED_LONG, 0,
                 counter_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return number;
  }

  static constexpr int counter_tag = 1;
  int rank = 0, size = 1;
  bool is_dynamic = false;
  std::vector<std::atomic<unsigned long>> taken;  ///< per variant
  std::jthread attendant;
};

std::unique_ptr<MpiWorld> MpiWorld::join(std::size_t variants) {
  if (!is_launched()) return {};
  std::unique_ptr<MpiWorld> world(new MpiWorld);
  world->ranks_ = std::make_unique<Ranks>(variants);
  return world;
}

std::size_t MpiWorld::rank() const { return static_cast<std::size_t>(ranks_->rank); }
std::size_t MpiWorld::size() const { return static_cast<std::size_t>(ranks_->size); }

std::size_t MpiWorld::next_of(std::size_t variant) { return ranks_->next_of(variant); }

namespace {

/// MPI itself spins where it waits: the processor is for those who still compute or merge.
void wait_for(MPI_Request& request) {
  int all_are_here = 0;
  while (MPI_Test(&request, &all_are_here, MPI_STATUS_IGNORE), all_are_here == 0)
    std::this_thread::sleep_for(pause);
}

}  // namespace

void MpiWorld::wait_for_all() {
  MPI_Request request{};
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  wait_for(request);
}

bool MpiWorld::any(bool here) {
  const int mine = here ? 1 : 0;
  int all = 0;
  MPI_Request request{};
  MPI_Iallreduce(&mine, &all, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD, &request);
  wait_for(request);
  MPI_Wait(&request, MPI_STATUS_IGNORE);  // at once: it has ended, and checkers of MPI ask for it
  return all != 0;
}

bool MpiWorld::all_have(std::uint64_t here) {
  // The largest number, and what is left of all bits by the smallest.
  const std::array<std::uint64_t, 2> mine{here, ~here};
  std::array<std::uint64_t, 2> all{};
  MPI_Request request{};
  MPI_Iallreduce(mine.data(), all.data(), 2, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD, &request);
  wait_for(request);
  MPI_Wait(&request, MPI_STATUS_IGNORE);  // at once: it has ended, and checkers of MPI ask for it
  return all == mine;
}

#else

struct MpiWorld::Ranks {};

std::unique_ptr<MpiWorld> MpiWorld::join(std::size_t) {
  if (!is_launched()) return {};
  throw InputError({}, "started as one of several MPI ranks", "this build has no MPI",
                   "install OpenMPI and build again, or add --shard auto");
}

std::size_t MpiWorld::rank() const { return 0; }
std::size_t MpiWorld::size() const { return 1; }
std::size_t MpiWorld::next_of(std::size_t) { return 0; }
void MpiWorld::wait_for_all() {}
bool MpiWorld::any(bool here) { return here; }
bool MpiWorld::all_have(std::uint64_t) { return true; }

#endif

MpiWorld::MpiWorld() = default;
MpiWorld::~MpiWorld() = default;

}  // namespace sunload
