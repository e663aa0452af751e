// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/doctor.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>

#include "geo/base/check.h"
#include "geo/sun/site.h"
#include "geo/time/time.h"
#include "io/base/data_folder.h"
#include "io/base/exit_code.h"
#include "io/base/file_aside.h"
#include "io/base/machine.h"
#include "io/base/version.h"
#include "io/result/reader.h"
#include "io/run/mpi_world.h"
#include "io/run/run.h"
#include "io/view/page.h"
#include "solver/base/threads.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;

enum class Verdict { good, wanting, broken };

void row(Verdict verdict, const std::string& what, const std::string& words) {
  constexpr std::array<const char*, 3> marks{"ok", "--", "!!"};
  std::cout << fmt::format("{}  {:<16} {}\n", marks[static_cast<std::size_t>(verdict)], what, words)
            << std::flush;
}

/// What a command prints; nothing where it fails.
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 256> part{};
  while (pipe && std::fgets(part.data(), static_cast<int>(part.size()), pipe.get()) != nullptr)
    text += part.data();
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

void tell_build() {
  row(Verdict::good, "program",
      fmt::format("sunload {} ({}), compiler {}", version, commit, __VERSION__));
  const bool has_page = !viewer_page_head().empty();
  row(has_page ? Verdict::good : Verdict::wanting, "viewer page",
      has_page ? "built in" : "not built in: install npm and build anew for `sunload view`");
  row(has_mpi() ? Verdict::good : Verdict::wanting, "MPI",
      has_mpi() ? "built in" : "not built in: shards (--shard) share work without it");
}

void tell_machine() {
  row(Verdict::good, "instruction set", usable_isa("auto"));
  row(Verdict::good, "threads",
      fmt::format("{} of {} processors permitted", thread_count(), permitted_processors()));
  row(Verdict::good, "memory", bytes_text(available_memory_bytes()) + " free for this process");
  const std::string problem = folder_problem(".");
  row(problem.empty() ? Verdict::good : Verdict::wanting, "working folder",
      problem.empty() ? bytes_text(free_disk_bytes(".")) + " free" : problem);
}

/// Databases that sites need. False where one is missing.
bool tell_databases() {
  bool is_whole = true;
  const auto check = [&](const std::string& what, const std::string& cure, auto&& look) {
    try {
      row(Verdict::good, what, look());
    } catch (const std::exception& error) {
      row(Verdict::broken, what, std::string(error.what()) + "; " + cure);
      is_whole = false;
    }
  };
  check("time zones", "install tzdata", [] {
    return fmt::format("Europe/Berlin is UTC{:+g} h in winter",
                       TimeZone("Europe/Berlin").standard_offset_s(2026) / 3600);
  });
  check("projections", "install proj-data", [] {
    const Site site = site_from_crs("EPSG:25833", {383066, 5511857, 0});
    return fmt::format("EPSG:25833 known: {:.3f} north, {:.3f} east", site.latitude_deg,
                       site.longitude_deg);
  });
  return is_whole;
}

void tell_company() {
  const std::string data = data_folder();
  row(data.empty() ? Verdict::wanting : Verdict::good, "examples, plots",
      data.empty() ? "not found: `init --example` and plots need share/sunload beside the program"
                   : data);
  const std::string probe =
      " -c 'import sys, numpy, h5py, xarray, h5netcdf, pandas, matplotlib; "
      "print(sys.executable, \"%d.%d\" % sys.version_info[:2])' 2>/dev/null";
  const std::string python =
      output_of("/usr/bin/env python3" + probe + " || /usr/bin/python3" + probe);
  row(python.empty() ? Verdict::wanting : Verdict::good, "Python",
      python.empty()
          ? "none with numpy, h5py, xarray, h5netcdf, pandas and matplotlib: plots and io/python "
            "want python3-h5py, python3-xarray, python3-h5netcdf, python3-pandas, "
            "python3-matplotlib"
          : python + " with numpy, h5py, xarray, h5netcdf, pandas, matplotlib");
}

/// A folder that goes when it is done with.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(fs::temp_directory_path() / fmt::format("sunload-doctor-{}", ::getpid())) {
    make_writable_folder(path_.string());
  }
  ~TemporaryFolder() {
    std::error_code left;
    fs::remove_all(path_, left);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

constexpr const char* test_study = R"(format: sunload-study-1
name: self_test
period: {positions: [{azimuth_deg: 120, elevation_deg: 25, interval_min: 60},
                     {azimuth_deg: 180, elevation_deg: 40, interval_min: 60},
                     {azimuth_deg: 240, elevation_deg: 25, interval_min: 60}]}
light: {source: fixed, dni_w_m2: 700, dhi_w_m2: 120}
scene: {builtin: {name: street}}
mesh: {max_edge_m: 3, oracle: none}
)";

/// Study → scene → rays → result file. The ledger's residual is an estimate of zero.
int self_test() {
  const TemporaryFolder folder;
  const std::string study = (folder.path() / "self_test.yaml").string();
  write_file(study, test_study);
  RunOptions options;
  options.output = (folder.path() / "results").string();
  options.progress = ProgressStyle::none;
  const auto begin = std::chrono::steady_clock::now();
  if (const int code = run_study(study, options); code != exit_code::done) return code;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const ResultReader result((folder.path() / "results/self_test/baseline.h5").string());
  const auto sum = [&](const char* name) {
    double total = 0;
    for (const double value : result.doubles(name)) total += value;
    return total;
  };
  const double in = sum("power_sun") + sum("power_sky") + sum("power_ground");
  const double residual = std::abs(sum("power_residual")) / in;
  // Some 20 times what the street's lines leave by chance: what is beyond is broken.
  constexpr double most_residual = 0.02;
  const bool is_sound = residual <= most_residual;  // also not where it is no number
  const double positions = static_cast<double>(result.shape("patch_area").front()) * 3;
  row(is_sound ? Verdict::good : Verdict::broken, "self-test",
      fmt::format("{:.2f} s; {:.0f} patches x suns a second; energy balances within {:.2f} %",
                  seconds, positions / seconds, 100 * residual));
  return is_sound ? exit_code::done : exit_code::bug;
}

}  // namespace

int doctor() {
  tell_build();
  tell_machine();
  const bool is_whole = tell_databases();
  tell_company();
  const int code = self_test();
  if (code != exit_code::done) return code;
  return is_whole ? exit_code::done : exit_code::machine_limit;
}

}  // namespace sunload
