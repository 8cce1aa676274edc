// Every example that --help prints is run, in a folder that has the files they name.

#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/videoio.hpp>

#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 4;
constexpr int kNeverInitialized = 2;

const char* const kCamera =
    "model: pinhole-radtan\nwidth: 96\nheight: 64\nfx: 80\nfy: 80\ncx: 47.5\ncy: 31.5\n";

/// The commands printed after "Examples:", without their comments.
std::vector<std::string> ExamplesIn(const std::string& help) {
  std::istringstream lines(help.substr(std::min(help.find("Examples:"), help.size())));
  std::vector<std::string> examples;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  corvo ", 0) == 0) examples.push_back(line.substr(2));
  }
  return examples;
}

/// Poses that no plane holds, in TUM format.
std::string Poses(double first_s, double step_s) {
  std::string text;
  for (int i = 0; i < kFrames; ++i) {
    text += fmt::format("{:.6f} {} {} {} 0 0 0 1\n", first_s + step_s * i, i, i % 3, i % 2);
  }
  return text;
}

/// Whatever the name says, as Motion JPEG: decoders look at what is in the file.
void WriteVideo(const fs::path& file) {
  const fs::path avi = file.parent_path() / "video.avi";
  cv::VideoWriter writer(avi.string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25.0,
                         cv::Size(kTinyWidth, kTinyHeight), false);
  for (int i = 0; i < kFrames; ++i) writer.write(TinyImage(i));
  writer.release();
  fs::rename(avi, file);
}

std::string KittiPoses() {
  std::string text;
  for (int i = 0; i < kFrames; ++i) {
    text += fmt::format("1 0 0 {} 0 1 0 {} 0 0 1 {}\n", i, i % 3, i % 2);
  }
  return text;
}

/// A folder with a sequence in each layout that the examples name.
class HelpExamples : public testing::TestWithParam<const char*> {
 protected:
  HelpExamples() {
    WriteKitti(here_ / "sequences/03", kFrames);
    WriteText(here_ / "poses/03.txt", KittiPoses());
    WriteEuroc(here_ / "MH_01_easy/mav0", kFrames);
    WriteText(here_ / "MH_01_easy/mav0/state_groundtruth_estimate0/data.csv", EurocPoses());
    WriteTum(here_ / "rgbd_dataset_freiburg1_rpy", kFrames);
    WriteFolder(here_ / "images", kFrames);
    WriteFolder(here_ / "left", kFrames);
    for (int i = 0; i < kFrames; ++i) {
      fs::rename(here_ / fmt::format("left/{}.png", i),
                 here_ / fmt::format("images/left{}.png", i));
    }
    WriteVideo(here_ / "drive.mp4");
    WriteImage(here_ / "bonnet.png", cv::Mat(kTinyHeight, kTinyWidth, CV_8UC1, cv::Scalar(255)));
    for (const char* name : {"a.png", "b.png", "picture.png"}) {
      WriteImage(here_ / name, TinyImage(7, 160, 120));
    }
    for (const char* name : {"camera.yaml", "phone.yaml"}) WriteText(here_ / name, kCamera);
    for (const char* name : {"truth.txt", "estimate.txt", "groundtruth.txt"}) {
      WriteText(here_ / name, Poses(0, 0.1));
    }
    fs::create_directory_symlink(CORVO_SOURCE_DIR "/configs", here_ / "configs");
  }

  static std::string EurocPoses() {
    std::string text;
    for (int i = 0; i < kFrames; ++i) {
      text += fmt::format("{},{},{},{},1,0,0,0\n", 1403636579763555584 + 50000000LL * i, i, i % 3,
                          i % 2);
    }
    return text;
  }

  /// What a run that went well leaves, for the truth that the example compares it with.
  void WriteResult(const std::string& example) const {
    const bool euroc = example.find("MH_01") != std::string::npos;
    const std::string poses = euroc ? Poses(1403636579.763556, 0.05) : Poses(0, 0.1);
    WriteText(here_ / "result/trajectory.tum", poses);
    WriteText(here_ / "result/groundtruth.tum", poses);
    std::string frames = "timestamp,state\n";
    for (int i = 0; i < kFrames; ++i) frames += fmt::format("{:.9f},tracking\n", 0.1 * i);
    WriteText(here_ / "result/frames.csv", frames);
    WriteText(here_ / "room/groundtruth.txt", poses);
  }

  CommandResult RunExample(std::string example) const {
    if (example.rfind("corvo eval", 0) == 0) WriteResult(example);
    example = example.substr(0, example.find(" #"));
    if (example.rfind("corvo synth", 0) == 0) {  // Shorter and smaller than the scenes are.
      example = std::regex_replace(example, std::regex("--(frames|width) [0-9]+"), "");
      example += " --frames 3 --width 64 --force";
    }
    if (example.find("corvo run room") == 0) {
      RunCorvo({"synth", "room", "-o", here_ / "room", "--frames", "3", "--width", "96"});
    }
    const std::string path = fs::path(CORVO_COMMAND).parent_path().string() + ":/usr/bin:/bin";
    return RunProgram("/bin/sh", {"-c", "cd '" + here_.path().string() + "' && " + example},
                      {"PATH=" + path});
  }

  TempFolder here_;
};

TEST_P(HelpExamples, Run) {
  std::vector<std::string> arguments = {"--help"};
  if (*GetParam() != '\0') arguments.insert(arguments.begin(), GetParam());
  const std::vector<std::string> examples = ExamplesIn(RunCorvo(arguments).out);
  EXPECT_FALSE(examples.empty());
  for (const std::string& example : examples) {
    if (example.find("camera:0") != std::string::npos) continue;  // No camera is connected.
    const CommandResult result = RunExample(example);
    const bool is_run = example.rfind("corvo run", 0) == 0;  // Of pictures without a scene.
    EXPECT_TRUE(result.exit_code == 0 || (is_run && result.exit_code == kNeverInitialized))
        << example << "\n"
        << result.out << result.err;
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, HelpExamples,
                         testing::Values("", "run", "eval", "synth", "config", "features", "match"),
                         [](const auto& param_info) {
                           return *param_info.param ? std::string(param_info.param) : "corvo";
                         });

}  // namespace
}  // namespace corvo::test
