// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors for the user, errors of the machine, and contracts.
///
/// Every message for the user reads `file:line:column: what (why); what to try`.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sunload {

/// Place in a file of the user; line and column count from 1, 0 = unknown.
struct Where {
  std::string file;
  int line = 0;
  int column = 0;
};

/// `file:line:column: what (why); hint`, leaving out what is empty.
std::string message(const Where& where, const std::string& what, const std::string& why = {},
                    const std::string& hint = {});

/// The user's input is wrong (exit code 2). Carries every problem found.
class InputError : public std::exception {
 public:
  explicit InputError(std::vector<std::string> problems);
  explicit InputError(std::string problem);
  InputError(const Where& where, const std::string& what, const std::string& why = {},
             const std::string& hint = {});
  const std::vector<std::string>& problems() const { return problems_; }
  const char* what() const noexcept override { return joined_.c_str(); }

 private:
  std::vector<std::string> problems_;
  std::string joined_;
};

/// A limit of the machine: disk full, no memory, cannot write (exit code 3).
class MachineError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Stopped before the end on request (exit code 75).
class Interrupted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Collects problems, so that all of them are reported at once.
class Problems {
 public:
  void add(const Where& where, const std::string& what, const std::string& why = {},
           const std::string& hint = {});
  void add(const InputError& error);
  bool empty() const { return list_.empty(); }
  const std::vector<std::string>& list() const { return list_; }
  /// Throws InputError with all problems, if there are any.
  void throw_if_any() const;

 private:
  std::vector<std::string> list_;
};

/// Throws std::logic_error with condition, place in the source and context.
[[noreturn]] void contract_failed(const char* condition, const char* file, int line,
                                  const std::string& context);

}  // namespace sunload

/// A promise of our own code: std::logic_error (exit code 70) where it is broken.
#define SUNLOAD_EXPECT(condition, context)                                                 \
  do {                                                                                     \
    if (!(condition)) ::sunload::contract_failed(#condition, __FILE__, __LINE__, context); \
  } while (false)
