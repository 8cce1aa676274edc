// SPDX-License-Identifier: MIT
#include "apps/commands/shorthand.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <string_view>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/dataset/bag_reader.h"
#include "apps/dataset/image_layouts.h"
#include "apps/dataset/image_source.h"
#include "orb/error.h"
#include "vo/io/nearest_name.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> NamesOfCommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : CommandsOf(app)) {
    names.push_back(command->get_name());
  }
  return names;
}

/// Returns whether one of the options is given, as "--option value" or "--option=value".
bool Has(const std::vector<std::string>& arguments, std::initializer_list<std::string_view> names) {
  return std::ranges::any_of(arguments, [&](const std::string& argument) {
    return std::ranges::any_of(names, [&](std::string_view name) {
      return argument == name || argument.starts_with(fmt::format("{}=", name));
    });
  });
}

/// Returns whether the dataset has a calibration. Errors in it are reported when it is read.
bool HasCalibration(const std::string& input) {
  const bool is_bag = IsBag(input);
  if (!is_bag && !fs::is_directory(input)) return false;
  try {
    return (is_bag ? OpenBag(input, {}).camera : ListImages(input).camera).has_value();
  } catch (const Error&) {
    return true;
  }
}

/// Returns NAME.corvo for the input NAME, or NAME.mp4.
std::string OutputFor(const fs::path& input) {
  return AbsoluteFolder(input).stem().string() + ".corvo";
}

}  // namespace

std::vector<std::string> ExpandShorthand(const CLI::App& app, std::vector<std::string> arguments) {
  if (arguments.empty() || arguments[0].empty() || arguments[0][0] == '-') return arguments;
  const std::string input = arguments[0];
  const std::vector<std::string> commands = NamesOfCommands(app);
  if (std::ranges::count(commands, input) > 0) return arguments;
  if (!fs::exists(input) && !IsPattern(input)) {
    throw Error(
        fmt::format("'{}' is neither a command nor a file or folder; the nearest command "
                    "is {} (see --help)",
                    input, NearestName(input, commands)));
  }
  arguments.insert(arguments.begin(), "run");
  if (!Has(arguments, {"--camera", "--focal", "--fov"}) && !HasCalibration(input)) {
    arguments.insert(arguments.end(), {"--focal", "auto"});
  }
  if (!Has(arguments, {"-o", "--output"})) {
    arguments.insert(arguments.end(), {"-o", OutputFor(input)});
  }
  return arguments;
}

}  // namespace corvo
