// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/output_target.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <optional>
#include <utility>

#include "geo/base/check.h"
#include "io/base/file_writing.h"
#include "io/base/standard_streams.h"

namespace sunload {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  // as the kernel follows

/// The number of an open file of this process, where a path in /proc names one. Such links cannot
/// be followed by what they say: pipes have no name, and files open for appending would lose it.
std::optional<int> own_descriptor(const fs::path& path) {
  std::error_code missing;
  const std::string folder = fs::canonical(path.parent_path(), missing).string();
  const std::string own = "/proc/" + std::to_string(::getpid()) + "/";
  if (missing || !folder.starts_with(own) || !folder.ends_with("/fd")) return {};
  const std::string name = path.filename().string();
  int number = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size()) return {};
  return number;
}

/// An open descriptor that is closed at the end.
class Descriptor {
 public:
  Descriptor(int number, const std::string& path) : number_(number) {
    if (number < 0) throw_cannot_write(path, errno);
  }
  ~Descriptor() { ::close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }

 private:
  int number_;
};

}  // namespace

OutputTarget output_target(const std::string& path) {
  if (path == "-") return {OutputTarget::Kind::descriptor, path, STDOUT_FILENO};
  fs::path at(path);
  std::error_code unreadable;
  for (int links = 0; fs::is_symlink(fs::symlink_status(at, unreadable)); ++links) {
    if (links == most_links) throw_cannot_write(path, ELOOP);
    if (const auto descriptor = own_descriptor(at))
      return {OutputTarget::Kind::descriptor, at.string(), *descriptor};
    const fs::path next = fs::read_symlink(at, unreadable);
    if (unreadable) throw_cannot_write(path, unreadable.value());
    at = at.parent_path() / next;  // `next` alone where it is absolute
  }
  const auto status = fs::status(at, unreadable);
  if (fs::is_directory(status)) throw_cannot_write(path, EISDIR);
  const bool may_be_replaced = fs::is_regular_file(status) || !fs::exists(status);
  return {may_be_replaced ? OutputTarget::Kind::file : OutputTarget::Kind::special, at.string(),
          -1};
}

void write_into(const OutputTarget& target, const std::string& from, const std::string& path) {
  const Descriptor source(::open(from.c_str(), O_RDONLY | O_CLOEXEC), path);
  const Descriptor sink(target.kind == OutputTarget::Kind::descriptor
                            ? ::fcntl(target.descriptor, F_DUPFD_CLOEXEC, 0)
                            : ::open(target.path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC),
                        path);
  std::array<char, 1 << 16> part{};
  while (const ssize_t got = ::read(source, part.data(), part.size())) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw_cannot_write(path, errno);
    const int error = write_all(sink, {part.data(), static_cast<std::size_t>(got)});
    if (error == EPIPE && target.descriptor == STDOUT_FILENO) {
      std::error_code gone;
      fs::remove(from, gone);
      fs::remove(fs::path(from).parent_path(), gone);
      end_by_closed_pipe();
    }
    if (error != 0) throw_cannot_write(path, error);
  }
  // Pipes, terminals and many devices cannot be flushed, and say so.
  if (::fsync(sink) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS)
    throw_cannot_write(path, errno);
}

void expect_not_read(const std::string& output, const std::vector<std::string>& inputs,
                     const std::string& written_with) {
  std::error_code missing;
  if (output.empty() || !fs::exists(output, missing)) return;
  for (const auto& input : inputs) {
    if (input.empty() || !fs::equivalent(output, input, missing)) continue;
    const std::string same = output == input ? "" : " " + input + ", which";
    throw InputError({output}, "is" + (same.empty() ? " what" : same) + " this command reads",
                     written_with.empty()
                         ? "writing it would destroy it"
                         : "it is written with " + written_with + ", which would destroy it",
                     "name another file");
  }
}

}  // namespace sunload
