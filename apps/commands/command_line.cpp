// SPDX-License-Identifier: MIT
#include "apps/commands/command_line.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/sinks/ansicolor_sink-inl.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "apps/commands/commands.h"
#include "apps/commands/shorthand.h"
#include "apps/output/error_text.h"
#include "apps/output/log_format.h"
#include "apps/system/decoder_messages.h"
#include "orb/error.h"

namespace corvo {
namespace {

constexpr const char* kFooter = R"(Examples:
  corvo drive.mp4                                         # corvo run drive.mp4 --focal auto -o drive.corvo
  corvo synth room -o room                                # a sequence with exact ground truth
  corvo run room --camera room/camera.yaml -o result      # its trajectory and map
  corvo eval result/trajectory.tum room/groundtruth.txt   # the accuracy of the trajectory
  corvo calibrate drive.mp4 -o camera.yaml                # a camera calibrated from its video
  corvo config > config.yaml                              # every option, its default and meaning

'corvo COMMAND --help' shows the options of a command, with examples.)";

/// Writes what is buffered of the standard output. Returns false and logs an error if not all of
/// the output could be written, as to a full disk.
bool FlushOutput() {
  std::cout.flush();
  const bool is_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  if (!is_written) spdlog::error("the standard output cannot be written: {}", std::strerror(errno));
  return is_written;
}

/// Prints the help text or version if requested, otherwise logs the error. Returns the exit code.
int ReportUsage(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    const int exit_code = app.exit(error);
    return FlushOutput() ? exit_code : kBadInput;
  }
  spdlog::error("{} (see --help)", ErrorText(error));
  return kBadInput;
}

/// Adds --quiet and --verbose, which every command accepts.
void AddVerbosityFlags(CLI::App& app) {
  app.fallthrough();
  CLI::Option* const quiet = app.add_flag_callback(
      "--quiet", [] { spdlog::set_level(spdlog::level::err); },
      "print errors only, and no progress; results say what else was to be said");
  app.add_flag_callback(
         "--verbose", [] { spdlog::set_level(spdlog::level::debug); },
         "also print what the inputs were taken for")
      ->excludes(quiet);
}

/// Parses the arguments, and executes the command in them.
void Parse(const std::vector<std::string>& arguments, CLI::App& app) {
  std::vector<std::string> full = ExpandShorthand(app, arguments);
  const bool is_quiet = std::ranges::count(full, "--quiet") > 0;
  if (full != arguments && !is_quiet) spdlog::info("corvo {}", fmt::join(full, " "));
  std::reverse(full.begin(), full.end());  // As CLI11 takes them.
  app.parse(std::move(full));
}

/// The parser of command lines, and the exit code that a command sets.
struct Parser {
  Parser() {
    app.set_version_flag("--version", CORVO_VERSION);
    app.require_subcommand(0, 1);
    app.footer(kFooter);
    AddVerbosityFlags(app);
    AddCommands(app, exit_code);
  }

  CLI::App app{"Monocular visual odometry: images in, camera trajectory and sparse map out.",
               "corvo"};
  int exit_code = 0;
};

/// Parses the arguments, executes the command in them or prints the help, and returns the exit
/// code.
int Execute(const std::vector<std::string>& arguments, Parser& parser) {
  Parse(arguments, parser.app);
  if (parser.app.get_subcommands().empty()) fmt::print("{}", parser.app.help());
  return FlushOutput() ? parser.exit_code : kBadInput;
}

}  // namespace

void SetUpLogging() {
  const bool has_colors = std::getenv("NO_COLOR") == nullptr;  // See no-color.org.
  using Sink = spdlog::sinks::ansicolor_stderr_sink<MessageLock>;
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "corvo", std::make_shared<Sink>(has_colors ? spdlog::color_mode::automatic
                                                 : spdlog::color_mode::never)));
  spdlog::set_formatter(MakeLogFormatter());
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

int RunCommandLine(const std::vector<std::string>& arguments) {
  SetUpLogging();
  Parser parser;
  try {
    return Execute(arguments, parser);
  } catch (const CLI::ParseError& error) {
    return ReportUsage(parser.app, error);
  } catch (const Error& error) {
    spdlog::error("{}", error.what());
    return kBadInput;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    spdlog::error("{}", ErrorText(error));
    return kBadInput;
  }
}

int ExecuteCommandLine(const std::vector<std::string>& arguments) {
  Parser parser;
  try {
    return Execute(arguments, parser);
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorText(error));
  }
}

}  // namespace corvo
