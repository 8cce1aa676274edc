// SPDX-License-Identifier: MIT
// These tests compare corvo's measures with those of evo, which runs as an external program on
// stored trajectories.

#include <cmath>
#include <ostream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"
#include "tests/data/temporary_folder.h"
#include "tests/support/data.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;

/// A Python program that prints one file of a zip archive.
constexpr const char* kUnzip =
    "import sys, zipfile; print(zipfile.ZipFile(sys.argv[1]).read(sys.argv[2]).decode())";

/// A measure that both programs compute.
struct Measure {
  std::string name;
  std::string format;             ///< "tum" or "kitti".
  std::vector<std::string> evo;   ///< The program and its options.
  std::vector<std::string> eval;  ///< Options of `corvo eval`.
  std::string json_pointer;       ///< The measure in the output of `corvo eval --json`.
};

/// Prints a measure in GoogleTest's messages.
void PrintTo(const Measure& measure, std::ostream* stream) { *stream << measure.evo[0]; }

class Evo : public testing::TestWithParam<Measure> {
 protected:
  static fs::path Programs() { return SourceDir() / ".venv" / "bin"; }
  static std::string Stored(const std::string& name) {
    return SourceDir() / "tests" / "data" / (name + "." + GetParam().format);
  }

  /// Returns evo's statistics with full precision.
  nlohmann::json RunEvo() const {
    const Measure& measure = GetParam();
    const std::string zip = folder_ / "results.zip";
    const std::vector<std::string> environment = {"HOME=" + folder_.path().string(),
                                                  "MPLBACKEND=Agg", "PATH=/usr/bin:/bin"};
    std::vector<std::string> arguments = {measure.format, Stored("truth"), Stored("estimate")};
    arguments.insert(arguments.end(), measure.evo.begin() + 1, measure.evo.end());
    arguments.insert(arguments.end(), {"--no_warnings", "--save_results", zip});
    const CommandResult run = RunProgram(Programs() / measure.evo[0], arguments, environment);
    EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
    const CommandResult stats =
        RunProgram(Programs() / "python", {"-c", kUnzip, zip, "stats.json"}, environment);
    return nlohmann::json::parse(stats.out, nullptr, false);
  }

  nlohmann::json RunEval() const {
    std::vector<std::string> arguments = {"eval", Stored("estimate"), Stored("truth"), "--json"};
    arguments.insert(arguments.end(), GetParam().eval.begin(), GetParam().eval.end());
    const CommandResult run = RunCorvo(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return nlohmann::json::parse(run.out, nullptr, false);
  }

  TemporaryFolder folder_;
};

TEST_P(Evo, EvalAgreesWithEvo) {
  if (!fs::exists(Programs() / "evo_ape")) {
    const std::string missing = "no evo in .venv: scripts/install_dependencies.sh --development";
    if (DataIsRequired()) FAIL() << missing;
    GTEST_SKIP() << missing;
  }
  const nlohmann::json evo = RunEvo();
  const nlohmann::json report = RunEval();
  const nlohmann::json eval =
      report.value(nlohmann::json::json_pointer(GetParam().json_pointer), nlohmann::json::object());
  ASSERT_TRUE(evo.contains("rmse") && eval.contains("rmse")) << report;
  EXPECT_GT(eval["rmse"], 1e-3);
  for (const char* statistic : {"rmse", "mean", "median", "max"}) {
    EXPECT_NEAR(eval[statistic], evo[statistic], 1e-6) << statistic;
  }
  EXPECT_NEAR(eval["count"].get<double>() * std::pow(eval["rmse"].get<double>(), 2), evo["sse"],
              1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    StoredTrajectories, Evo,
    testing::Values(
        Measure{"ApeSim3", "tum", {"evo_ape", "-as"}, {}, "/ate"},
        Measure{"ApeSe3", "tum", {"evo_ape", "-a"}, {"--align", "se3"}, "/ate"},
        Measure{"ApeScale", "tum", {"evo_ape", "-s"}, {"--align", "scale"}, "/ate"},
        Measure{"ApeKitti", "kitti", {"evo_ape", "-as"}, {}, "/ate"},
        Measure{"RpeFrame", "tum", {"evo_rpe", "-as", "-d", "1"}, {}, "/rpe_frames/translation"},
        Measure{"RpeFrameAngle",
                "tum",
                {"evo_rpe", "-as", "-d", "1", "-r", "angle_deg"},
                {},
                "/rpe_frames/rotation_deg"},
        Measure{"RpeFrames",
                "kitti",
                {"evo_rpe", "-as", "-d", "20", "--all_pairs"},
                {"--rpe-frames", "20"},
                "/rpe_frames/translation"},
        Measure{"RpeSeconds",
                "kitti",  // The rows are a second apart.
                {"evo_rpe", "-as", "-d", "5", "--all_pairs", "-r", "angle_deg"},
                {"--rpe-seconds", "5"},
                "/rpe_time/rotation_deg"},
        Measure{"RpeMeters",
                "tum",
                {"evo_rpe", "-as", "-d", "1", "-u", "m", "--pairs_from_reference"},
                {"--rpe-meters", "1"},
                "/rpe_path/translation"},
        Measure{"RpeMetersKitti",
                "kitti",
                {"evo_rpe", "-as", "-d", "20", "-u", "m", "--pairs_from_reference"},
                {"--rpe-meters", "20"},
                "/rpe_path/translation"}),
    [](const auto& param_info) { return param_info.param.name; });

}  // namespace
}  // namespace corvo::test
