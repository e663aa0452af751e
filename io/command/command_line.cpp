// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/command_line.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <optional>

#include "geo/base/check.h"
#include "io/base/exit_code.h"
#include "io/base/key_names.h"
#include "io/base/output_target.h"
#include "io/base/version.h"

namespace sunload {

struct Option::Parts {
  CLI::Option* option = nullptr;
  bool is_read = false, is_written = false;
  std::vector<std::string> words = {};  ///< for completions
};

struct Command::Parts {
  CLI::App* app = nullptr;
  std::string examples = {};
  std::deque<Option::Parts> options = {};
};

struct CommandLine::Parts {
  CLI::App app;
  std::deque<Command::Parts> commands;
  std::function<int()> action;  ///< of the command that the line names
};

namespace {

const CLI::Validator positive_number(
    [](const std::string& text) {
      double value = 0;
      return CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value)
                 ? std::string()
                 : "'" + text + "' is not a number above 0";
    },
    "NUMBER > 0");

Option added(Command::Parts& command, CLI::Option* option) {
  return Option(command.options.emplace_back(Option::Parts{option}));
}

std::string indented(const std::string& lines) {
  std::string text = "  ";
  for (const char letter : lines)
    text += letter == '\n' ? std::string("\n  ") : std::string(1, letter);
  return text;
}

/// What to try instead of a word that is not known.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known,
                         const std::string& help) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](auto& a, auto& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  // A third of the letters wrong is as far as a slip of the hand goes.
  const bool is_near =
      nearest != known.end() && edit_distance(word, *nearest) <= static_cast<int>(word.size() / 3);
  return is_near ? "did you mean '" + *nearest + "'?" : "see " + help;
}

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> names_of_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) names.push_back(option->get_name());
  return names;
}

const CLI::App* chosen_command(const CLI::App& app) {
  const CLI::App* chosen = nullptr;
  for (const CLI::App* sub : app.get_subcommands({}))
    if (sub->parsed()) chosen = sub;
  return chosen;
}

/// The message, in the name of the variable where an option has its value from the environment.
/// Options of all commands ask it, whichever is called.
std::string blamed_on_environment(std::string message, const CLI::App& app,
                                  const std::vector<std::string>& words) {
  for (const CLI::App* command : app.get_subcommands({}))
    for (const CLI::Option* option : command->get_options()) {
      const std::string name = option->get_name() + ":", variable = option->get_envname();
      const bool is_written = std::ranges::any_of(
          words, [&](const std::string& word) { return word.starts_with(option->get_name()); });
      if (!variable.empty() && !is_written && message.starts_with(name) &&
          std::getenv(variable.c_str()))
        return variable + message.substr(name.size() - 1);
    }
  return message;
}

/// Tells what is wrong with the command line, in one line, and the nearest right word.
[[noreturn]] void refuse(const CLI::App& app, const CLI::ParseError& error,
                         const std::vector<std::string>& words) {
  const std::string first = words.empty() ? "" : words.front();
  const CLI::App* chosen = chosen_command(app);
  const std::string help = chosen ? "sunload " + chosen->get_name() + " --help" : "sunload --help";
  if (!chosen && !first.empty() && first.front() != '-')
    throw InputError({}, "unknown command '" + first + "'", {},
                     nearest_word(first, names_of_commands(app), help));
  const CLI::App& blamed = chosen ? *chosen : app;
  if (const auto rest = blamed.remaining(); !rest.empty()) {
    const std::string word = rest.front().substr(0, rest.front().find('='));
    throw InputError({}, "unknown argument '" + word + "'", {},
                     nearest_word(word, names_of_options(blamed), help));
  }
  throw InputError({}, blamed_on_environment(error.what(), app, words), {}, "see " + help);
}

/// Only the options of the command that was called have values.
void expect_none_read_and_written(const Command::Parts& command) {
  for (const auto& output : command.options)
    for (const auto& input : command.options)
      if (output.is_written && input.is_read)
        for (const auto& path : output.option->results())
          expect_not_read(path, input.option->results());
}

/// Behind the type of its values, which is CLI11's alone: "INT:1 to 4096".
std::string range_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto colon = type.find(':');
  return colon == std::string::npos ? std::string() : type.substr(colon + 1);
}

std::vector<std::string> rules_of(const CLI::Option& option) {
  std::vector<std::string> rules;
  if (option.get_required()) rules.emplace_back("required");
  if (const auto range = range_of(option); !range.empty()) rules.push_back(range);
  if (const auto value = option.get_default_str(); !value.empty())
    rules.push_back("default: " + value);
  if (const auto variable = option.get_envname(); !variable.empty())
    rules.push_back("or by the environment variable " + variable);
  for (const CLI::Option* other : option.get_excludes())
    rules.push_back("not with " + other->get_name());
  return rules;
}

OptionWords words_of(const CLI::Option& option) {
  OptionWords words{
      .names = {}, .argument = {}, .what = option.get_description(), .rules = rules_of(option)};
  for (const auto& name : option.get_snames()) words.names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) words.names.push_back("--" + name);
  const bool is_flag = option.get_items_expected_max() == 0;
  if (words.names.empty())
    words.argument = option.get_name(true);
  else if (!is_flag)
    words.argument = "VALUE";
  return words;
}

CommandWords words_of(const Command::Parts& command) {
  const CLI::App& app = *command.app;
  CommandWords words{app.get_name(), app.get_description(), command.examples, {}};
  for (const CLI::Option* option : app.get_options()) {
    words.options.push_back(words_of(*option));
    for (const auto& parts : command.options)
      if (parts.option == option) words.options.back().choices = parts.words;
  }
  return words;
}

}  // namespace

Option Option::required() const {
  parts_->option->required();
  return *this;
}

Option Option::repeatable() const {
  parts_->option->allow_extra_args(false);
  return *this;
}

Option Option::single() const {
  parts_->option->allow_extra_args(true);
  return *this;
}

Option Option::positive() const {
  parts_->option->check(positive_number);
  return *this;
}

Option Option::not_empty() const {
  parts_->option->check(CLI::Validator(
      [](const std::string& text) {
        return text.empty() ? std::string("is empty; write a path, or leave the option out")
                            : std::string();
      },
      ""));
  return *this;
}

Option Option::within(int least, int most) const {
  parts_->option->check(CLI::Range(least, most).description(fmt::format("{} to {}", least, most)));
  return *this;
}

Option Option::within(double least, double most) const {
  // CLI::Range lets by what is no number.
  parts_->option->check(CLI::Validator(
      [least, most](const std::string& text) {
        double value = 0;
        return CLI::detail::lexical_cast(text, value) && value >= least && value <= most
                   ? std::string()
                   : fmt::format("'{}' is not in [{:g}, {:g}]", text, least, most);
      },
      fmt::format("NUMBER in [{:g}, {:g}]", least, most)));
  return *this;
}

Option Option::excludes(const Option& other) const {
  parts_->option->excludes(other.parts_->option);
  return *this;
}

Option Option::from_environment(const std::string& variable) const {
  parts_->option->envname(variable);
  return *this;
}

Option Option::with_default_told() const {
  parts_->option->capture_default_str();
  return *this;
}

Option Option::under(const std::string& heading) const {
  parts_->option->group(heading);
  return *this;
}

Option Option::completed_by(const std::vector<std::string>& words) const {
  parts_->words = words;
  return *this;
}

Option Option::read() const {
  parts_->is_read = true;
  return *this;
}

Option Option::written() const {
  parts_->is_written = true;
  return *this;
}

template <class Value>
Option Command::option(const std::string& names, Value& target, const std::string& what) const {
  return added(*parts_, parts_->app->add_option(names, target, what));
}
template Option Command::option(const std::string&, std::string&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<std::string>&,
                                const std::string&) const;
template Option Command::option(const std::string&, int&, const std::string&) const;
template Option Command::option(const std::string&, double&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<double>&,
                                const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::size_t>&,
                                const std::string&) const;

Option Command::flag(const std::string& names, std::function<void()> set,
                     const std::string& what) const {
  return added(*parts_, parts_->app->add_flag_callback(names, std::move(set), what));
}

Option Command::flag(const std::string& names, bool& target, const std::string& what) const {
  return flag(names, target, true, what);
}

Option Command::word_of(const std::string& name, const std::vector<std::string>& words,
                        std::function<void(const std::string&)> set,
                        const std::string& what) const {
  const std::string list = fmt::format("{}", fmt::join(words, ", "));
  const auto take = [name, words, list, set = std::move(set)](const std::string& word) {
    if (std::find(words.begin(), words.end(), word) == words.end())
      throw InputError({}, name + " " + word, "no such word", "write one of: " + list);
    set(word);
  };
  CLI::Option* option =
      parts_->app->add_option_function<std::string>(name, take, what + ": " + list);
  return added(*parts_, option).completed_by(words);
}

bool Command::has(const std::string& name) const {
  return parts_->app->get_option_no_throw(name) != nullptr;
}

void Command::examples(const std::string& lines) const {
  parts_->examples = lines;
  parts_->app->footer("Examples:\n" + indented(lines));
}

CommandLine::CommandLine(const std::string& what, const std::string& beginning)
    : parts_(std::make_unique<Parts>()) {
  CLI::App& app = parts_->app;
  app.name("sunload");
  app.description(what);
  app.footer(beginning);
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("sunload ") + version + " (" + commit + ")");
}

CommandLine::~CommandLine() = default;

Command CommandLine::command(const std::string& name, const std::string& what,
                             std::function<int()> action) {
  CLI::App* sub = parts_->app.add_subcommand(name, what);
  sub->footer(std::string());  // otherwise that of the program
  sub->callback([&chosen = parts_->action, action = std::move(action)] { chosen = action; });
  return Command(parts_->commands.emplace_back(Command::Parts{sub}));
}

int CommandLine::run(int argc, char** argv) {
  try {
    parts_->app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    parts_->app.exit(asked);
    return exit_code::done;
  } catch (const CLI::ParseError& error) {
    refuse(parts_->app, error, {argv + std::min(argc, 1), argv + argc});
  }
  for (const auto& command : parts_->commands) expect_none_read_and_written(command);
  return parts_->action();
}

std::vector<CommandWords> CommandLine::words() const {
  std::vector<CommandWords> words;
  for (const auto& command : parts_->commands) words.push_back(words_of(command));
  return words;
}

}  // namespace sunload
