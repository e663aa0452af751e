// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/manual.h"

#include <fmt/format.h>

#include <string_view>

#include "io/base/file_aside.h"
#include "io/base/machine.h"
#include "io/base/version.h"

namespace sunload {

namespace {

/// Text in roff: nothing of it is a request or a hyphen that breaks a word.
std::string roff(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_line = i == 0 || text[i - 1] == '\n';
    if (begins_line && (text[i] == '.' || text[i] == '\'')) out += "\\&";
    if (text[i] == '\\')
      out += "\\e";
    else if (text[i] == '-')
      out += "\\-";
    else
      out += text[i];
  }
  return out;
}

std::string joined(const std::vector<std::string>& words, const std::string& by) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : by) + word;
  return text;
}

std::string page_head(const std::string& name, const std::string& what) {
  return fmt::format(".TH {} 1 \"\" \"sunload {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n", name,
                     version, roff(name), roff(what));
}

std::string positional_words(const CommandWords& command) {
  std::string text;
  for (const auto& option : command.options)
    if (option.names.empty()) text += (text.empty() ? "" : " ") + option.argument;
  return text;
}

std::string described(const OptionWords& option) {
  return option.rules.empty() ? option.what
                              : fmt::format("{} ({})", option.what, joined(option.rules, "; "));
}

std::string command_page(const CommandWords& command) {
  std::string text = page_head("sunload-" + command.name, command.what);
  text += fmt::format(".SH SYNOPSIS\n.B sunload {}\n{} [\\fIOPTION\\fR]...\n", roff(command.name),
                      roff(positional_words(command)));
  text += ".SH OPTIONS\n";
  for (const auto& option : command.options) {
    const std::string names = option.names.empty() ? option.argument : joined(option.names, ", ");
    text += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(names),
                        option.names.empty() || option.argument.empty()
                            ? ""
                            : fmt::format(" \\fI{}\\fR", roff(option.argument)),
                        roff(described(option)));
  }
  if (!command.examples.empty())
    text += fmt::format(".SH EXAMPLES\n.nf\n{}\n.fi\n", roff(command.examples));
  return text + ".SH SEE ALSO\n.BR sunload (1)\n";
}

std::string main_page(const std::vector<CommandWords>& commands) {
  std::string text = page_head("sunload", "sun and sky light on every patch of a city");
  text +=
      ".SH SYNOPSIS\n.B sunload\n\\fICOMMAND\\fR [\\fIARGUMENT\\fR]...\n.SH DESCRIPTION\n"
      "A study (YAML: site, dates, light, scene, materials, variants) goes in; time series of\n"
      "irradiance, light load, sun hours and standard errors of every patch come out as HDF5.\n"
      ".SH COMMANDS\n";
  for (const auto& command : commands)
    text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(command.name), roff(command.what));
  text +=
      ".SH EXIT STATUS\n0 done, 2 the input is wrong, 3 the machine is at a limit (disk, memory),\n"
      "75 stopped before the end (go on with \\fB\\-\\-resume\\fR), 70 a bug.\n"
      ".SH ENVIRONMENT\n.TP\n\\fBSUNLOAD_THREADS\\fR\nthreads, where \\fB\\-\\-threads\\fR is not "
      "given\n.SH SEE ALSO\n";
  for (std::size_t c = 0; c < commands.size(); ++c)
    text += fmt::format(".BR sunload\\-{} (1){}\n", roff(commands[c].name),
                        c + 1 < commands.size() ? "," : "");
  return text;
}

/// In single quotes of a shell.
std::string shell(const std::string& text) {
  std::string out = "'";
  for (const char letter : text)
    out += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return out + "'";
}

std::vector<std::string> option_names(const CommandWords& command) {
  std::vector<std::string> names;
  for (const auto& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

/// Words of the first argument that is known by its place.
std::vector<std::string> first_choices(const CommandWords& command) {
  for (const auto& option : command.options)
    if (option.names.empty()) return option.choices;
  return {};
}

std::string bash_completion(const std::vector<CommandWords>& commands) {
  std::vector<std::string> names;
  std::string options, choices, first;
  const auto add = [](std::string& cases, const std::string& word,
                      const std::vector<std::string>& words) {
    if (!words.empty())
      cases += fmt::format("    {}) words={} ;;\n", word, shell(joined(words, " ")));
  };
  for (const auto& command : commands) {
    names.push_back(command.name);
    add(options, command.name, option_names(command));
    add(first, command.name + ":2", first_choices(command));
    for (const auto& option : command.options)
      for (const auto& name : option.names) add(choices, command.name + ":" + name, option.choices);
  }
  return fmt::format(
      "# bash completion of sunload\n"
      "_sunload() {{\n"
      "  local word=\"${{COMP_WORDS[COMP_CWORD]}}\" command=\"${{COMP_WORDS[1]}}\" words=\"\"\n"
      "  local before=\"${{COMP_WORDS[COMP_CWORD-1]}}\"\n"
      "  # Readline takes --option=word apart at \"=\".\n"
      "  if [[ \"$word\" == \"=\" ]]; then\n"
      "    word=\"\"\n"
      "  elif [[ \"$before\" == \"=\" ]]; then\n"
      "    before=\"${{COMP_WORDS[COMP_CWORD-2]}}\"\n"
      "  fi\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    mapfile -t COMPREPLY < <(compgen -W {} -- \"$word\")\n"
      "    return\n"
      "  fi\n"
      "  case \"$command:$before\" in\n{}  esac\n"
      "  if [[ -z \"$words\" && \"$word\" != -* ]]; then\n"
      "    case \"$command:$COMP_CWORD\" in\n{}    esac\n"
      "  fi\n"
      "  if [[ -n \"$words\" ]]; then\n"
      "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
      "    return\n"
      "  fi\n"
      "  [[ \"$word\" == -* ]] || return\n"
      "  case \"$command\" in\n{}  esac\n"
      "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
      "}}\n"
      "complete -o default -F _sunload sunload\n",
      shell(joined(names, " ") + " --help --version"), choices, first, options);
}

/// Behind backslashes what zsh would take for its own.
std::string escaped(const std::string& text, std::string_view special) {
  std::string out;
  for (const char letter : text) {
    if (letter == '\\' || special.find(letter) != std::string_view::npos) out += '\\';
    out += letter;
  }
  return out;
}

/// What _arguments is told of one option, and completes behind it.
std::string zsh_option(const std::string& name, const OptionWords& option) {
  std::string spec = fmt::format("{}[{}]", name, escaped(option.what, "[]:"));
  if (option.argument.empty()) return spec;
  // --long=word is one word, too.
  if (name.starts_with("--")) spec.insert(name.size(), "=");
  return spec + (option.choices.empty() ? ":" + escaped(option.argument, ":") + ":_files"
                                        : ": :(" + joined(option.choices, " ") + ")");
}

std::string zsh_completion(const std::vector<CommandWords>& commands) {
  std::string names, functions, cases;
  for (const auto& command : commands) {
    names += fmt::format("    {}\n", shell(command.name + ":" + escaped(command.what, ":")));
    cases += fmt::format("    {}) _arguments", command.name);
    for (const auto& option : command.options)
      for (const auto& name : option.names)
        cases += " \\\n      " + shell(zsh_option(name, option));
    if (const auto words = first_choices(command); !words.empty()) {
      const std::string name = "_sunload_" + command.name;
      functions += fmt::format("{}() {{ compadd -- {}; _files }}\n", name, joined(words, " "));
      cases += fmt::format(" \\\n      '1:name:{}'", name);
    }
    cases += " \\\n      '*:file:_files' ;;\n";
  }
  return fmt::format(
      "#compdef sunload\n"
      "{}"
      "local -a commands\n"
      "if ((CURRENT == 2)); then\n"
      "  commands=(\n{}  )\n"
      "  _describe command commands\n"
      "else\n"
      "  local command=\"$words[2]\"\n"
      "  shift words\n"
      "  ((CURRENT--))\n"
      "  case \"$command\" in\n{}  esac\n"
      "fi\n",
      functions, names, cases);
}

std::string fish_completion(const std::vector<CommandWords>& commands) {
  std::string text = "# fish completion of sunload\n";
  for (const auto& command : commands) {
    text += fmt::format("complete -c sunload -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        shell(command.what));
    if (const auto words = first_choices(command); !words.empty())
      text += fmt::format("complete -c sunload -n '__fish_seen_subcommand_from {}' -a {}\n",
                          command.name, shell(joined(words, " ")));
    for (const auto& option : command.options)
      for (const auto& name : option.names) {
        const bool is_long = name.starts_with("--");
        text += fmt::format(
            "complete -c sunload -n '__fish_seen_subcommand_from {}' -{} {}{}{} -d {}\n",
            command.name, is_long ? "l" : "s", name.substr(is_long ? 2 : 1),
            option.argument.empty() ? "" : " -r",
            option.choices.empty() ? "" : " -f -a " + shell(joined(option.choices, " ")),
            shell(option.what));
      }
  }
  return text;
}

}  // namespace

void write_manual(const std::string& folder, const std::vector<CommandWords>& commands) {
  const std::string pages = folder + "/man1", completions = folder + "/completion";
  make_writable_folder(pages);
  make_writable_folder(completions);
  write_file(pages + "/sunload.1", main_page(commands));
  for (const auto& command : commands)
    write_file(fmt::format("{}/sunload-{}.1", pages, command.name), command_page(command));
  write_file(completions + "/sunload", bash_completion(commands));
  write_file(completions + "/_sunload", zsh_completion(commands));
  write_file(completions + "/sunload.fish", fish_completion(commands));
}

}  // namespace sunload
