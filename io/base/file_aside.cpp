// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/file_aside.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>

#include "geo/base/check.h"
#include "io/base/file_writing.h"
#include "io/base/hash.h"

namespace sunload {
namespace {

namespace fs = std::filesystem;

const std::string part_mark = ".part-";
/// Who writes a result or a batch writes to it every few seconds.
constexpr std::chrono::hours unwritten_for{24};
constexpr std::size_t place_digits = 12;  // hexadecimal: two places alike once in 10^14

/// Where process numbers mean the same processes: this start of the kernel, and
/// the container's own numbering.
std::string this_place() {
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  std::error_code unknown;
  return sha256(boot + fs::read_symlink("/proc/self/ns/pid", unknown).string())
      .substr(0, place_digits);
}

struct Writer {
  std::string place;
  pid_t process = 0;
};

/// Who wrote a file aside, from its name; none where it is another file.
std::optional<Writer> writer_of(const std::string& name) {
  const auto mark = name.rfind(part_mark);
  if (mark == std::string::npos) return {};
  const std::string words = name.substr(mark + part_mark.size());
  const auto dash = words.find('-');
  if (dash != place_digits) return {};
  Writer writer{words.substr(0, dash), 0};
  const char* digits = words.data() + dash + 1;
  const auto [end, error] = std::from_chars(digits, words.data() + words.size(), writer.process);
  if (error != std::errc() || writer.process <= 0 || *end != '-') return {};
  return writer;
}

bool is_left_over(const fs::path& file, const Writer& writer) {
  if (writer.place == this_place()) return ::kill(writer.process, 0) != 0 && errno == ESRCH;
  std::error_code gone;
  const auto written = fs::last_write_time(file, gone);
  return !gone && fs::file_time_type::clock::now() - written > unwritten_for;
}

const char* const whole = "whole";

/// Removes folders of killed processes; others' links and folders stay.
void remove_folders_left_in(const fs::path& temporary) {
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(temporary, unreadable)) {
    const auto writer = writer_of(entry.path().filename().string());
    struct stat folder {};
    if (!writer || ::lstat(entry.path().c_str(), &folder) != 0 || !S_ISDIR(folder.st_mode) ||
        folder.st_uid != ::geteuid() || !is_left_over(entry.path(), *writer))
      continue;
    ::unlink((entry.path() / whole).c_str());
    ::rmdir(entry.path().c_str());
  }
}

/// Beside the file, or in a new folder of this process alone where nothing can be renamed to it.
std::string place_aside(const OutputTarget& target, const std::string& path) {
  const std::string mark = part_mark + this_place() + "-" + std::to_string(::getpid()) + "-";
  if (target.kind == OutputTarget::Kind::file)
    return target.path + mark + std::to_string(std::random_device{}());
  std::error_code none;
  const fs::path temporary = fs::temp_directory_path(none);
  std::string folder = (temporary / ("sunload" + mark + "XXXXXX")).string();
  remove_folders_left_in(temporary);
  if (none || ::mkdtemp(folder.data()) == nullptr)
    throw MachineError("cannot write " + path + ": what is written into it is made in the folder " +
                       "of temporary files, which cannot be written to (" +
                       (none ? none.message() : std::strerror(errno)) +
                       "); let TMPDIR name another");
  return folder + "/" + whole;
}

/// fsync of a file or folder; the number of the error, or 0.
int flushed_to_disk(const std::string& path, int flags) {
  const int file = ::open(path.c_str(), flags | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  return error;
}

/// Names of the files aside that are being written, for a signal that ends the process: the handler
/// may neither lock nor allocate. Few at a time; those beyond are left for the next run to remove.
std::array<std::atomic<const char*>, 64> being_written{};
static_assert(std::atomic<const char*>::is_always_lock_free);

void replace_one(const char* name, const char* by) {
  for (auto& place : being_written)
    if (const char* found = name; place.compare_exchange_strong(found, by)) return;
}

void remove_and_end(int signal) {
  for (const auto& place : being_written)
    if (const char* name = place.load()) ::unlink(name);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

FileAside::FileAside(std::string path)
    : path_(std::move(path)), target_(output_target(path_)), aside_(place_aside(target_, path_)) {
  replace_one(nullptr, aside_.c_str());
}

FileAside::~FileAside() {
  if (state_ == State::writing) remove_aside();
  replace_one(aside_.c_str(), nullptr);
}

void FileAside::remove_aside() const {
  ::unlink(aside_.c_str());
  if (target_.kind != OutputTarget::Kind::file) ::rmdir(fs::path(aside_).parent_path().c_str());
}

void FileAside::start_flushing() const {
#ifdef SYNC_FILE_RANGE_WRITE
  const int file = ::open(aside_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  ::sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE);  // errors come back from fsync
  ::close(file);
#endif
}

void FileAside::publish() {
  if (target_.kind == OutputTarget::Kind::file)
    if (const int error = flushed_to_disk(aside_, O_RDONLY)) throw_cannot_write(path_, error);
  publish_unflushed();
  if (target_.kind != OutputTarget::Kind::file) return;
  const auto folder = fs::path(target_.path).parent_path();
  const int error = flushed_to_disk(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
  // Some network file systems cannot flush folders and say so: nothing more can be done there.
  if (error != 0 && error != EINVAL && error != ENOTSUP) throw_cannot_write(path_, error);
}

void FileAside::publish_unflushed() {
  if (target_.kind != OutputTarget::Kind::file) {
    write_into(target_, aside_, path_);
    remove_aside();
  } else if (std::rename(aside_.c_str(), target_.path.c_str()) != 0) {
    throw_cannot_write(path_, errno);
  }
  state_ = State::published;
}

void remove_files_aside_on_signals() {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP})
    if (std::signal(signal, remove_and_end) == SIG_IGN) std::signal(signal, SIG_IGN);
}

void remove_left_aside(const std::string& folder) {
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder, unreadable)) {
    const auto writer = writer_of(entry.path().filename().string());
    if (!writer || !is_left_over(entry.path(), *writer)) continue;
    std::error_code removed_meanwhile;
    fs::remove(entry.path(), removed_meanwhile);
  }
}

void write_file(const std::string& path, std::string_view bytes) {
  FileAside file(path);
  errno = 0;
  std::ofstream stream(file.aside(), std::ios::binary);
  stream << bytes;
  stream.close();
  if (!stream) throw_cannot_write(path, errno);
  file.publish();
}

}  // namespace sunload
