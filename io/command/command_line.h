// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The command line as commands see it: what they are called, what they take and what they run.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "io/command/manual.h"

namespace sunload {

/// An option of a command, or an argument: a handle, through which more is said of it.
class Option {
 public:
  struct Parts;  ///< of it, known to the command line alone
  explicit Option(Parts& parts) : parts_(&parts) {}

  Option required() const;
  /// One value for each time that its name is written.
  Option repeatable() const;
  /// A second value is told to be one too many, not to be unknown.
  Option single() const;
  Option positive() const;
  /// A text that is not empty, as that of a variable which a script has never set.
  Option not_empty() const;
  Option within(int least, int most) const;
  Option within(double least, double most) const;
  /// The two are not given together.
  Option excludes(const Option& other) const;
  /// Where it is not given, a variable of the environment holds.
  Option from_environment(const std::string& variable) const;
  /// Help tells the value that holds where it is not given.
  Option with_default_told() const;
  /// Help has it under this heading.
  Option under(const std::string& heading) const;
  /// Completions offer these words.
  Option completed_by(const std::vector<std::string>& words) const;
  /// Files that the command reads, and files that it writes: none may be both.
  Option read() const;
  Option written() const;

 private:
  Parts* parts_;
};

/// A command: a handle, through which it gets its options. Their targets are set before its action
/// runs, and must live as long as the command line.
class Command {
 public:
  struct Parts;  ///< of it, known to the command line alone
  explicit Command(Parts& parts) : parts_(&parts) {}

  /// An option ("-o,--output"), or an argument that is known by its place ("STUDY"). Values are
  /// std::string, std::vector<std::string>, int, double, std::optional<double> and
  /// std::optional<std::size_t>.
  template <class Value>
  Option option(const std::string& names, Value& target, const std::string& what) const;

  Option flag(const std::string& names, std::function<void()> set, const std::string& what) const;
  Option flag(const std::string& names, bool& target, const std::string& what) const;
  template <class Value>
  Option flag(const std::string& names, Value& target, std::type_identity_t<Value> value,
              const std::string& what) const {
    return flag(
        names, [&target, value] { target = value; }, what);
  }

  /// An option that takes one of some words, which help and completions tell.
  template <class Value>
  Option choice(const std::string& name, Value& target, const std::map<std::string, Value>& words,
                const std::string& what) const {
    std::vector<std::string> list;
    list.reserve(words.size());
    for (const auto& [word, value] : words) list.push_back(word);
    return word_of(
        name, list, [&target, words](const std::string& word) { target = words.at(word); }, what);
  }

  bool has(const std::string& name) const;
  /// What people try first: lines at the end of help and of the command's page.
  void examples(const std::string& lines) const;

 private:
  Option word_of(const std::string& name, const std::vector<std::string>& words,
                 std::function<void(const std::string&)> set, const std::string& what) const;

  Parts* parts_;
};

/// The program's commands, of which one is run.
class CommandLine {
 public:
  /// `what` begins the program's help, `beginning` ends it.
  CommandLine(const std::string& what, const std::string& beginning);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// A command; `action` does it, once the line is read, and returns the exit code.
  Command command(const std::string& name, const std::string& what, std::function<int()> action);

  /// Reads the line, runs the command that it names and returns the exit code
  /// (io/base/exit_code.h). Throws InputError for a line that is not understood, or that would
  /// write over what it reads, and what the command throws.
  int run(int argc, char** argv);

  /// What the help of all commands tells.
  std::vector<CommandWords> words() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sunload
