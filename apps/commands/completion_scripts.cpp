// SPDX-License-Identifier: MIT
#include "apps/commands/completion_scripts.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/commands/commands.h"

namespace corvo {
namespace {

struct CompletedOption {
  std::vector<std::string> names;  ///< Such as "-o", "--output".
  std::string description;
  bool takes_value = false;
  std::vector<std::string> choices;  ///< Of its value; empty if that is a file or a number.
};

struct CompletedCommand {
  std::string name;
  std::string description;
  std::vector<CompletedOption> options;
  std::vector<std::string> choices;  ///< Of its first argument; empty if that is a file.
};

/// Returns the choices that the type of an option names, as in "TEXT:{colmap,nerfstudio}".
std::vector<std::string> ChoicesOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

/// Adds the described options of an app that have other names than those there are.
void AddOptions(const CLI::App& app, std::vector<CompletedOption>& options) {
  for (const CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) {
    if (!option->nonpositional() || option->get_group().empty()) continue;
    const CompletedOption added{OptionNames(*option), option->get_description(),
                                TakesValue(*option), ChoicesOf(*option)};
    const auto is_added = [&](const CompletedOption& o) { return o.names == added.names; };
    if (std::ranges::none_of(options, is_added)) options.push_back(added);
  }
}

/// Returns the names of an app's commands, or else the choices of its first argument.
std::vector<std::string> FirstArguments(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : CommandsOf(app)) names.push_back(command->get_name());
  if (!names.empty()) return names;
  const auto positional =
      app.get_options([](const CLI::Option* option) { return option->get_positional(); });
  return positional.empty() ? names : ChoicesOf(*positional.front());
}

/// Returns a command with its own options, those of its commands, and those of the program.
CompletedCommand Complete(const CLI::App& command, const CLI::App& program) {
  CompletedCommand completed{
      command.get_name(), command.get_description(), {}, FirstArguments(command)};
  AddOptions(command, completed.options);
  for (const CLI::App* inner : CommandsOf(command)) AddOptions(*inner, completed.options);
  AddOptions(program, completed.options);
  return completed;
}

std::vector<CompletedCommand> CompletedCommands(const CLI::App& program) {
  std::vector<CompletedCommand> commands;
  for (const CLI::App* command : CommandsOf(program)) {
    commands.push_back(Complete(*command, program));
  }
  return commands;
}

/// Returns the names of a program's commands and of its own options.
std::string FirstWords(const CLI::App& program) {
  std::vector<CompletedOption> options;
  AddOptions(program, options);
  std::string words = fmt::format("{}", fmt::join(FirstArguments(program), " "));
  for (const CompletedOption& option : options) {
    words += fmt::format(" {}", fmt::join(option.names, " "));
  }
  return words;
}

/// Returns a text with a backslash before each of `characters` and itself.
std::string Escaped(const std::string& text, std::string_view characters) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\' || characters.find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// Returns the cases of bash that set `words` to the choices behind a word.
std::string BashChoices(const CompletedCommand& command) {
  std::string cases;
  const auto add = [&](const std::string& word, const std::vector<std::string>& choices) {
    if (choices.empty()) return;
    cases +=
        fmt::format("    '{} {}') words='{}' ;;\n", command.name, word, fmt::join(choices, " "));
  };
  add(command.name, command.choices);
  for (const CompletedOption& option : command.options) {
    for (const std::string& name : option.names) add(name, option.choices);
  }
  return cases;
}

std::string BashScript(const CLI::App& program) {
  std::string options, choices;
  for (const CompletedCommand& command : CompletedCommands(program)) {
    std::vector<std::string> names;
    for (const CompletedOption& option : command.options) {
      names.insert(names.end(), option.names.begin(), option.names.end());
    }
    options += fmt::format("    {}) options='{}' ;;\n", command.name, fmt::join(names, " "));
    choices += BashChoices(command);
  }
  // Without a word to choose from, bash completes names of files.
  return fmt::format(R"(# Completion of corvo for bash.
_corvo() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} options= words=
  # Bash makes three words of --option=value.
  if [ "$current" = = ]; then
    current=
  elif [ "$previous" = = ]; then
    previous=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W '{}' -- "$current"; compgen -f -- "$current")
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  case "${{COMP_WORDS[1]}} $previous" in
{}  esac
  if [[ $current == -* ]]; then words=$options; fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -o default -o filenames -F _corvo corvo
)",
                     FirstWords(program), options, choices);
}

/// Returns an argument of zsh's _arguments for each name of an option.
std::string ZshOption(const CompletedOption& option) {
  std::string description = Escaped(option.description, "[]:");
  std::erase(description, '\'');
  std::string value;
  if (option.takes_value) {
    value = option.choices.empty() ? ":value:_files"
                                   : fmt::format(":value:({})", fmt::join(option.choices, " "));
  }
  std::string text;
  for (const std::string& name : option.names) {
    text += fmt::format(" \\\n      '{}[{}]{}'", name, description, value);
  }
  return text;
}

/// Returns zsh's call of _arguments for a command.
std::string ZshCase(const CompletedCommand& command) {
  std::string text = fmt::format("    {}) _arguments", command.name);
  for (const CompletedOption& option : command.options) text += ZshOption(option);
  if (!command.choices.empty()) {
    text += fmt::format(" \\\n      '1:argument:({})'", fmt::join(command.choices, " "));
  }
  return text + " \\\n      '*:file:_files' ;;\n";
}

std::string ZshScript(const CLI::App& program) {
  std::string cases;
  for (const CompletedCommand& command : CompletedCommands(program)) cases += ZshCase(command);
  // zsh runs the file as the function that it defines when it is installed; it may be sourced, too.
  return fmt::format(R"(#compdef corvo
# Completion of corvo for zsh.
_corvo() {{
  if (( CURRENT == 2 )); then
    compadd -- {}
    _files
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
{}    *) _files ;;
  esac
}}
if [[ $funcstack[1] == _corvo ]]; then
  _corvo "$@"
else
  compdef _corvo corvo
fi
)",
                     FirstWords(program), cases);
}

/// Returns fish's names, values and description of an option.
std::string FishOption(const CompletedOption& option) {
  std::string text;
  for (const std::string& name : option.names) {
    const bool is_long = name.starts_with("--");
    text += fmt::format(" {} {}", is_long ? "-l" : "-s", name.substr(is_long ? 2 : 1));
  }
  if (!option.choices.empty()) {
    text += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
  } else if (option.takes_value) {
    text += " -r";
  }
  return fmt::format("{} -d '{}'\n", text, Escaped(option.description, "'"));
}

std::string FishScript(const CLI::App& program) {
  std::string text = "# Completion of corvo for fish.\n";
  std::vector<CompletedOption> options;
  AddOptions(program, options);
  for (const CompletedOption& option : options) {
    text += "complete -c corvo -n __fish_use_subcommand" + FishOption(option);
  }
  for (const CompletedCommand& command : CompletedCommands(program)) {
    const std::string is_command =
        fmt::format("contains -- {} (commandline -opc)[2]", command.name);
    text += fmt::format("complete -c corvo -n __fish_use_subcommand -a {} -d '{}'\n", command.name,
                        Escaped(command.description, "'"));
    if (!command.choices.empty()) {
      text += fmt::format(
          "complete -c corvo -n 'test (count (commandline -opc)) -eq 2; and {}' -f -a '{}'\n",
          is_command, fmt::join(command.choices, " "));
    }
    for (const CompletedOption& option : command.options) {
      text += fmt::format("complete -c corvo -n '{}'{}", is_command, FishOption(option));
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> OptionNames(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool TakesValue(const CLI::Option& option) { return option.get_expected_max() > 0; }

std::string CompletionScript(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return BashScript(app);
  return shell == "zsh" ? ZshScript(app) : FishScript(app);
}

}  // namespace corvo
