#include "io/mpi_world.h"

#include <cstdlib>
#include <string>
#include <vector>

#include "geo/check.h"

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

#ifdef SUNLOAD_WITH_MPI

struct MpiWorld::Ranks {
  explicit Ranks(std::size_t variants) {
    MPI_Init(nullptr, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    const auto bytes = static_cast<MPI_Aint>(rank == 0 ? variants * sizeof(long) : 0);
    MPI_Win_allocate(bytes, sizeof(long), MPI_INFO_NULL, MPI_COMM_WORLD, &counters, &window);
    if (rank == 0)
      for (std::size_t v = 0; v < variants; ++v) counters[v] = 0;
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ~Ranks() {
    // After an exception the other ranks may never come: no collective call then.
    if (std::uncaught_exceptions() > 0) return;
    MPI_Win_free(&window);
    MPI_Finalize();
  }
  int rank = 0, size = 1;
  long* counters = nullptr;
  MPI_Win window{};
};

std::unique_ptr<MpiWorld> MpiWorld::join(std::size_t variants) {
  if (launched_ranks() < 2) return {};
  std::unique_ptr<MpiWorld> world(new MpiWorld);
  world->ranks_ = std::make_unique<Ranks>(variants);
  return world;
}

std::size_t MpiWorld::rank() const { return static_cast<std::size_t>(ranks_->rank); }
std::size_t MpiWorld::size() const { return static_cast<std::size_t>(ranks_->size); }

std::size_t MpiWorld::next_of(std::size_t variant) {
  const long one = 1;
  long taken = 0;
  MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, ranks_->window);
  MPI_Fetch_and_op(&one, &taken, MPI_LONG, 0, static_cast<MPI_Aint>(variant), MPI_SUM,
                   ranks_->window);
  MPI_Win_unlock(0, ranks_->window);
  return static_cast<std::size_t>(taken);
}

void MpiWorld::wait_for_all() { MPI_Barrier(MPI_COMM_WORLD); }

bool MpiWorld::any(bool here) {
  int mine = here ? 1 : 0, all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return all != 0;
}

#else

struct MpiWorld::Ranks {};

std::unique_ptr<MpiWorld> MpiWorld::join(std::size_t) {
  if (launched_ranks() < 2) return {};
  throw InputError({}, "started as one of several MPI ranks", "this build has no MPI",
                   "install OpenMPI and build again, or use --shard auto");
}

std::size_t MpiWorld::rank() const { return 0; }
std::size_t MpiWorld::size() const { return 1; }
std::size_t MpiWorld::next_of(std::size_t) { return 0; }
void MpiWorld::wait_for_all() {}
bool MpiWorld::any(bool here) { return here; }

#endif

MpiWorld::MpiWorld() = default;
MpiWorld::~MpiWorld() = default;

}  // namespace sunload
