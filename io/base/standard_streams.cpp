// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <iostream>
#include <streambuf>
#include <string>

#include "io/base/file_writing.h"
#include "io/base/names.h"

namespace sunload {
namespace {

/// Bytes of standard output on their way.
class Listing : public std::streambuf {
 public:
  Listing() : is_terminal_(::isatty(STDOUT_FILENO) != 0) {}
  int error() const { return error_; }

 protected:
  int_type overflow(int_type c) override {
    if (!traits_type::eq_int_type(c, traits_type::eof())) waiting_ += traits_type::to_char_type(c);
    return write_if_many() ? traits_type::not_eof(c) : traits_type::eof();
  }
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    waiting_.append(bytes, static_cast<std::size_t>(count));
    return write_if_many() ? count : 0;
  }
  int sync() override { return write(waiting_.size()) ? 0 : -1; }

 private:
  /// Whole lines, so that no character is cut in two.
  bool write_if_many() {
    constexpr std::size_t many = 1 << 16;
    if (waiting_.size() < many) return error_ == 0;
    const auto end = waiting_.rfind('\n');
    return write(end == std::string::npos ? waiting_.size() : end + 1);
  }
  bool write(std::size_t count) {
    const std::string_view part = std::string_view(waiting_).substr(0, count);
    if (error_ == 0)
      error_ = write_all(STDOUT_FILENO, is_terminal_ ? without_controls(part) : std::string(part));
    waiting_.erase(0, count);
    if (error_ == EPIPE) end_by_closed_pipe();
    return error_ == 0;
  }

  std::string waiting_;
  int error_ = 0;
  bool is_terminal_;
};

/// Never destroyed: std::cout is flushed once more at the very end.
Listing& listing() {
  static Listing& only = *new Listing;
  return only;
}

}  // namespace

void open_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest free number is this one. What nobody can read back must not seem to be written.
    ::open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_RDWR);
  }
}

void tell(std::string_view message) {
  try {
    tell_as_it_is(without_controls(message) + "\n");
  } catch (const std::bad_alloc&) {
    tell_as_it_is("a message is left out: out of memory\n");
  }
}

void end_by_closed_pipe() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
}

void tell_warnings(const std::vector<std::string>& warnings, std::string_view of) {
  const std::string begin = "warning: " + std::string(of) + (of.empty() ? "" : ": ");
  for (const auto& warning : warnings) tell(begin + warning);
}

void tell_as_it_is(std::string_view text) {
  [[maybe_unused]] const int lost = write_all(STDERR_FILENO, text);
}

void open_listing() { std::cout.rdbuf(&listing()); }

void finish_listing() {
  std::cout.flush();
  if (listing().error() != 0) throw_cannot_write("to standard output", listing().error());
}

}  // namespace sunload
