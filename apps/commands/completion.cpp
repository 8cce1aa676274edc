// SPDX-License-Identifier: MIT
#include "apps/commands/completion.h"

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/commands/commands.h"
#include "apps/commands/completion_scripts.h"
#include "orb/error.h"

namespace corvo {
namespace {

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
                     ManText(fmt::format("{}", fmt::join(OptionNames(option), ", "))),
                     ManText(value), ManText(option.get_description()));
}

/// Returns what a manual page says of the options and arguments of an app.
std::string ManOptions(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) {
    if (option->get_group().empty()) continue;
    if (option->nonpositional()) {
      text += ManOption(*option);
    } else {
      text += fmt::format(".TP\n\\fI{}\\fR\n{}\n", ManText(option->get_name(true)),
                          ManText(option->get_description()));
    }
  }
  return text;
}

/// Returns what a manual page says of the commands of an app. Those of the program have pages
/// `page`-NAME; those of a command have none, and all the same options.
std::string ManCommands(const CLI::App& app, const std::string& page) {
  const std::vector<const CLI::App*> commands = CommandsOf(app);
  if (commands.empty()) return "";
  const bool have_pages = app.get_parent() == nullptr;
  std::string text = ".SH COMMANDS\n";
  for (const CLI::App* command : commands) {
    const std::string name = (have_pages ? page + "-" : "") + command->get_name();
    text += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", ManText(name), have_pages ? "(1)" : "",
                        ManText(command->get_description()));
  }
  if (!have_pages) text += ".SH OPTIONS OF EACH COMMAND\n" + ManOptions(*commands.front());
  return text;
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
  page +=
      CommandsOf(app).empty() ? "[\\fIOPTION\\fR]...\n" : "\\fICOMMAND\\fR [\\fIOPTION\\fR]...\n";
  page += ManCommands(app, name) + ".SH OPTIONS\n" + ManOptions(app);
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
