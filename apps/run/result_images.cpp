// SPDX-License-Identifier: MIT
#include "apps/run/result_images.h"

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Assigns a member of a summary to a variable; one that is not there was not given.
template <typename Value, typename Variable>
void Read(const nlohmann::json& summary, const char* name, Variable& variable) {
  const auto member = summary.find(name);
  if (member != summary.end()) variable = member->get<Value>();
}

}  // namespace

nlohmann::json ReadSummary(const fs::path& result) {
  const fs::path file = result / "summary.json";
  nlohmann::json summary =
      nlohmann::json::parse(ReadFileBytes(file, kMaxTextBytes), nullptr, false);
  if (!summary.is_object()) {
    throw Error(fmt::format("{}: is not the summary of a run, or damaged", file.string()));
  }
  return summary;
}

RunArguments InputArguments(const fs::path& result, const nlohmann::json& summary) {
  RunArguments arguments;
  arguments.camera = result / "camera_estimated.yaml";
  try {
    Read<std::string>(summary, "input", arguments.input);
    Read<int>(summary, "start", arguments.selection.start);
    Read<int>(summary, "every", arguments.selection.every);
    Read<int>(summary, "count", arguments.selection.count);
    Read<std::string>(summary, "resize", arguments.resize);
    Read<std::string>(summary, "mask", arguments.mask);
    Read<double>(summary, "fps", arguments.stored.frame_rate_hz);
    Read<std::string>(summary, "times", arguments.stored.times);
    Read<int>(summary, "bits", arguments.stored.bits);
    Read<std::string>(summary, "topic", arguments.stored.topic);
  } catch (const nlohmann::json::exception& error) {
    throw Error(fmt::format("{}: {}", (result / "summary.json").string(), error.what()));
  }
  return arguments;
}

ResultImages::ResultImages(const RunArguments& arguments)
    : source_(OpenPreparedImages(arguments)), names_(arguments.input, source_.list()) {}

}  // namespace corvo
