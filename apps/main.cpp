// SPDX-License-Identifier: MIT
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "apps/commands/calibrate.h"
#include "apps/commands/config.h"
#include "apps/commands/eval.h"
#include "apps/commands/export.h"
#include "apps/commands/features.h"
#include "apps/commands/learn.h"
#include "apps/commands/match.h"
#include "apps/commands/run.h"
#include "apps/commands/synth.h"
#include "apps/output/log_format.h"
#include "apps/run/interruption.h"
#include "orb/error.h"

namespace corvo {
namespace {

constexpr int kBadInput = 1;

constexpr const char* kFooter = R"(Examples:
  corvo synth room -o room                                # a sequence with exact ground truth
  corvo run room --camera room/camera.yaml -o result      # its trajectory and map
  corvo eval result/trajectory.tum room/groundtruth.txt   # the accuracy of the trajectory
  corvo calibrate drive.mp4 -o camera.yaml                # a camera calibrated from its video
  corvo config > config.yaml                              # every option, its default and meaning

'corvo COMMAND --help' shows the options of a command, with examples.)";

/// Sends all messages to standard error, one per line: "corvo: error: ...". Standard output is for
/// results only.
void SetUpLogging() {
  spdlog::set_default_logger(spdlog::stderr_logger_st("corvo"));
  spdlog::set_formatter(MakeLogFormatter());
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

/// Returns the first line of a message. Messages of libraries may have several.
std::string FirstLine(const std::string& message) { return message.substr(0, message.find('\n')); }

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
  spdlog::error("{} (see --help)", FirstLine(error.what()));
  return kBadInput;
}

int Main(int argc, char** argv) {
  SetUpLogging();
  EndOnInterruption();
  int exit_code = 0;
  CLI::App app("Monocular visual odometry: images in, camera trajectory and sparse map out.",
               "corvo");
  app.set_version_flag("--version", CORVO_VERSION);
  app.require_subcommand(0, 1);
  app.footer(kFooter);
  AddRunCommand(app, exit_code);
  AddCalibrateCommand(app, exit_code);
  AddEvalCommand(app);
  AddExportCommand(app);
  AddSynthCommand(app, exit_code);
  AddFeaturesCommand(app);
  AddMatchCommand(app);
  AddLearnCommand(app);
  AddConfigCommand(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return ReportUsage(app, error);
  } catch (const Error& error) {
    spdlog::error("{}", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    spdlog::error("{}", FirstLine(error.what()));
    return kBadInput;
  }
  if (!app.get_subcommands().empty()) return FlushOutput() ? exit_code : kBadInput;
  spdlog::error("no command given (see --help)");
  return kBadInput;
}

}  // namespace
}  // namespace corvo

int main(int argc, char** argv) {
  try {
    return corvo::Main(argc, argv);
  } catch (...) {  // Reporting the error has failed, too.
    return 1;
  }
}
