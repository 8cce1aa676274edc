// SPDX-License-Identifier: MIT
#include "apps/commands/completion.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/commands/commands.h"
#include "orb/error.h"

namespace corvo {
namespace {

/// Returns the options that have names and are described, in the order of their addition.
std::vector<const CLI::Option*> OptionsOf(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) {
    return option->nonpositional() && !option->get_group().empty();
  });
}

/// Returns "-o", "--output", ... of an option.
std::vector<std::string> NamesOf(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool TakesValue(const CLI::Option& option) { return option.get_expected_max() > 0; }

/// Returns a text with a backslash before each of `characters` and itself.
std::string Escaped(const std::string& text, std::string_view characters) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\' || characters.find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string BashScript(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : CommandsOf(app)) {
    std::string words;
    for (const CLI::Option* option : OptionsOf(*command)) {
      for (const std::string& name : NamesOf(*option)) words += name + " ";
    }
    commands += command->get_name() + " ";
    cases += fmt::format("    {}) words='{}' ;;\n", command->get_name(), words);
  }
  return fmt::format(R"(# Completion of corvo for bash.
_corvo() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} words=
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{}--help --version' -- "$current") $(compgen -f -- "$current"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  else
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}}
complete -o filenames -F _corvo corvo
)",
                     commands, cases);
}

/// Returns the arguments of zsh's _arguments for a command.
std::string ZshArguments(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : OptionsOf(command)) {
    const std::string value = TakesValue(*option) ? ":value:_files" : "";
    for (const std::string& name : NamesOf(*option)) {
      std::string description = Escaped(option->get_description(), "[]:");
      std::erase(description, '\'');
      text += fmt::format(" \\\n      '{}[{}]{}'", name, description, value);
    }
  }
  return text;
}

std::string ZshScript(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : CommandsOf(app)) {
    commands += fmt::format(" {}", command->get_name());
    cases += fmt::format("    {}) _arguments{} \\\n      '*:file:_files' ;;\n", command->get_name(),
                         ZshArguments(*command));
  }
  return fmt::format(R"(#compdef corvo
# Completion of corvo for zsh.
_corvo() {{
  if (( CURRENT == 2 )); then
    compadd{}
    _files
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
{}  esac
}}
_corvo "$@"
)",
                     commands, cases);
}

std::string FishScript(const CLI::App& app) {
  std::string text = "# Completion of corvo for fish.\n";
  for (const CLI::App* command : CommandsOf(app)) {
    text += fmt::format("complete -c corvo -n __fish_use_subcommand -a {} -d '{}'\n",
                        command->get_name(), Escaped(command->get_description(), "'"));
    for (const CLI::Option* option : OptionsOf(*command)) {
      text +=
          fmt::format("complete -c corvo -n '__fish_seen_subcommand_from {}'", command->get_name());
      for (const std::string& name : option->get_snames()) text += " -s " + name;
      for (const std::string& name : option->get_lnames()) text += " -l " + name;
      text += fmt::format("{} -d '{}'\n", TakesValue(*option) ? " -r" : "",
                          Escaped(option->get_description(), "'"));
    }
  }
  return text;
}

/// Returns a text for man(7): no line begins with a control character, and backslashes and hyphens
/// are themselves.
std::string ManText(const std::string& text) {
  std::string escaped;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
    at_start = c == '\n';
  }
  return escaped;
}

std::string ManOption(const CLI::Option& option) {
  const std::string value = TakesValue(option) ? " " + option.get_type_name() : "";
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n",
                     ManText(fmt::format("{}", fmt::join(NamesOf(option), ", "))), ManText(value),
                     ManText(option.get_description()));
}

/// Returns a script that completes the commands and options of the program in a shell: "bash",
/// "zsh" or "fish".
std::string CompletionScript(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return BashScript(app);
  return shell == "zsh" ? ZshScript(app) : FishScript(app);
}

/// Returns the manual page, in the format of man(7), of the program or of one of its commands.
std::string ManualPage(const CLI::App& app) {
  const CLI::App* const parent = app.get_parent();
  const std::string name =
      parent == nullptr ? app.get_name() : parent->get_name() + "-" + app.get_name();
  std::string page =
      fmt::format(".TH {} 1\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B {}\n", name, ManText(name),
                  ManText(app.get_description()),
                  ManText(parent == nullptr ? name : parent->get_name() + " " + app.get_name()));
  page += parent == nullptr ? "\\fICOMMAND\\fR [\\fIOPTION\\fR]...\n" : "[\\fIOPTION\\fR]...\n";
  if (parent == nullptr) {
    page += ".SH COMMANDS\n";
    for (const CLI::App* command : CommandsOf(app)) {
      page += fmt::format(".TP\n\\fB{}\\fR(1)\n{}\n", ManText(name + "-" + command->get_name()),
                          ManText(command->get_description()));
    }
  }
  page += ".SH OPTIONS\n";
  for (const CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) {
    if (option->get_group().empty()) continue;
    if (option->nonpositional()) {
      page += ManOption(*option);
    } else {
      page += fmt::format(".TP\n\\fI{}\\fR\n{}\n", ManText(option->get_name(true)),
                          ManText(option->get_description()));
    }
  }
  return page + ".SH NOTES\n.nf\n" + ManText(app.get_footer()) + "\n.fi\n";
}

}  // namespace

void AddCompletionCommands(CLI::App& app) {
  CLI::App* completion =
      app.add_subcommand("completion", "Print a script that completes commands and options");
  const auto shell = std::make_shared<std::string>();
  completion->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  completion->footer(R"(Examples:
  source <(corvo completion bash)                                # for this session
  corvo completion fish > ~/.config/fish/completions/corvo.fish)");
  completion->callback([&app, shell] { fmt::print("{}", CompletionScript(app, *shell)); });

  CLI::App* manual = app.add_subcommand("manual", "Print a manual page, as man(1) formats it");
  const auto name = std::make_shared<std::string>();
  manual->add_option("COMMAND", *name, "command; if it is omitted, the page is that of corvo");
  manual->footer(R"(Examples:
  corvo manual run > corvo-run.1 && man ./corvo-run.1)");
  manual->callback([&app, name]() -> void {
    for (const CLI::App* page : CommandsOf(app)) {
      if (page->get_name() == *name) return fmt::print("{}", ManualPage(*page));
    }
    if (!name->empty()) throw Error(fmt::format("manual: there is no command '{}'", *name));
    fmt::print("{}", ManualPage(app));
  });
}

}  // namespace corvo
