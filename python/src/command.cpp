// SPDX-License-Identifier: MIT
#include "apps/commands/command_line.h"

#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include "apps/dataset/shipped_cameras.h"
#include "apps/system/interruption.h"
#include "python/src/bindings.h"

namespace corvo::python {
namespace {

namespace nb = nanobind;

/// Keeps the messages of commands while it exists.
class MessageLog {
 public:
  MessageLog() : before_(spdlog::default_logger()) {
    const auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(text_);
    const auto logger = std::make_shared<spdlog::logger>("corvo", sink);
    logger->set_pattern("%v");
    spdlog::set_default_logger(logger);
  }
  ~MessageLog() { spdlog::set_default_logger(before_); }
  MessageLog(const MessageLog&) = delete;
  MessageLog& operator=(const MessageLog&) = delete;

  /// Returns the messages, without the last line break.
  std::string text() const {
    std::string text = text_.str();
    if (text.ends_with('\n')) text.pop_back();
    return text;
  }

 private:
  std::ostringstream text_;
  std::shared_ptr<spdlog::logger> before_;
};

/// Executes a command in this process, which signals do not end. Returns its exit code and what it
/// logged. Commands of several threads wait for each other.
std::pair<int, std::string> Execute(const std::vector<std::string>& arguments) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const InterruptionDeferral deferral;
  const MessageLog log;
  const int exit_code = ExecuteCommandLine(arguments);
  return {exit_code, log.text()};
}

/// Does what the command does, and returns its exit code.
int Main(const std::vector<std::string>& arguments) {
  EndOnInterruption();
  return RunCommandLine(arguments);
}

}  // namespace

void BindCommand(nb::module_& module) {
  module.def("_set_config_folder", &SetConfigFolder, nb::arg("folder"));
  module.def("_execute", &Execute, nb::arg("arguments"), nb::call_guard<nb::gil_scoped_release>());
  module.def("_set_up_logging", &SetUpLogging);
  module.def("_main", &Main, nb::arg("arguments"), nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace corvo::python
