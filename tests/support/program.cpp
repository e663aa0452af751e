// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/program.h"
#include "tests/support/paths.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <sstream>
#include <stdexcept>

namespace sunload::test {

namespace fs = std::filesystem;

namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void limit(int resource, const std::optional<std::uint64_t>& value) {
  if (!value) return;
  const rlimit both{*value, *value};
  if (setrlimit(static_cast<__rlimit_resource>(resource), &both) != 0) _exit(126);
}

int opened_for_writing(const std::string& path) {
  constexpr mode_t mode = 0600;
  return ::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, mode);
}

}  // namespace

std::vector<std::string> Ran::lines() const {
  std::vector<std::string> list;
  std::istringstream text(err);
  for (std::string line; std::getline(text, line);) list.push_back(line);
  return list;
}

Process::Process(const std::vector<std::string>& arguments, const std::string& folder,
                 const Limits& limits) {
  static int count = 0;
  const std::string base = testing::TempDir() + "sunload_output_" + std::to_string(::getpid()) +
                           "_" + std::to_string(count++);
  out_ = base + ".out";
  err_ = base + ".err";
  std::vector<char*> words;
  for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  start_ = now_s();
  process_ = ::fork();
  if (process_ < 0) throw std::runtime_error("fork failed");
  if (process_ > 0) return;
  // The child: only calls that are safe between fork and exec.
  const int out = opened_for_writing(out_), err = opened_for_writing(err_);
  if (out < 0 || err < 0 || ::dup2(out, STDOUT_FILENO) < 0 || ::dup2(err, STDERR_FILENO) < 0 ||
      ::chdir(folder.c_str()) != 0)
    _exit(126);
  limit(RLIMIT_FSIZE, limits.file_bytes);
  limit(RLIMIT_AS, limits.memory_bytes);
  ::execv(words[0], words.data());
  _exit(127);
}

Process::~Process() {
  if (!status_) {
    ::kill(process_, SIGKILL);
    collect(0);
  }
  ::unlink(out_.c_str());
  ::unlink(err_.c_str());
}

void Process::send(int signal) const { ::kill(process_, signal); }

bool Process::collect(int options) {
  int status = 0;
  pid_t ended = 0;
  do ended = ::waitpid(process_, &status, options);
  while (ended < 0 && errno == EINTR);
  if (ended == process_) status_ = status;
  return status_.has_value();
}

bool Process::is_running() { return !status_ && !collect(WNOHANG); }

std::string Process::err_so_far() const { return bytes_of(err_); }

Ran Process::wait() {
  if (!status_) collect(0);
  Ran ran;
  if (WIFEXITED(*status_)) ran.code = WEXITSTATUS(*status_);
  if (WIFSIGNALED(*status_)) ran.signal = WTERMSIG(*status_);
  ran.out = bytes_of(out_);
  ran.err = bytes_of(err_);
  ran.seconds = now_s() - start_;
  return ran;
}

std::vector<std::string> program_words(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), test::program_path());
  return arguments;
}

Ran program(const WorkFolder& folder, std::vector<std::string> arguments, const Limits& limits) {
  return Process(program_words(std::move(arguments)), folder.path(), limits).wait();
}

Ran python(const WorkFolder& folder, const std::string& code, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"/usr/bin/python3", "-c", code});
  return Process(arguments, folder.path()).wait();
}

}  // namespace sunload::test
