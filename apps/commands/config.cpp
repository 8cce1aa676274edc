// SPDX-License-Identifier: MIT
#include "apps/commands/config.h"

#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "apps/output/printable.h"
#include "vo/io/config.h"

namespace corvo {
namespace {

constexpr const char* kConfigFooter = R"(Examples:
  corvo config > config.yaml                    # the defaults, each with its range and meaning
  corvo config --print configs/orb_2011.yaml    # check a file and print all resulting options)";

void PrintConfig(const std::filesystem::path& file) {
  fmt::print("{}", Printable(WriteOptions(file.empty() ? OdometryOptions{} : ReadOptions(file))));
}

}  // namespace

void AddConfigCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("config", "Print the default options, or check an options file");
  const auto file = std::make_shared<std::filesystem::path>();
  command->add_option("FILE", *file,
                      "options file to check; options that it omits keep their defaults");
  command->add_flag_callback(
      "--print", [] {}, "print the options (this is always done)");
  command->footer(kConfigFooter);
  command->callback([file] { PrintConfig(*file); });
}

}  // namespace corvo
