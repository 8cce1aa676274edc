// SPDX-License-Identifier: MIT
// This program compares features: see kHelp.

#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/output/environment.h"
#include "bench/quality/charts.h"
#include "bench/quality/report.h"
#include "orb/error.h"
#include "tests/data/data_path.h"

namespace corvo::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHelp =
    "Measures corvo's features and OpenCV's side by side, on images of the folder that\n"
    "CORVO_DATA names: turned, scaled, blurred and otherwise changed ones, and Oxford's "
    "sequences.\n"
    "Prints a table of what is required and one of everything, and writes them as quality.md, "
    "every\n"
    "pair as quality.json, and rotation.png and changes.png.";

struct Arguments {
  fs::path output;
  int num_features = 1000;
  std::vector<std::string> oxford = {"graf", "boat", "bikes", "ubc"};
  bool short_run = false;
};

struct SpreadFolder {
  const char* name;
  const char* pattern;
};

constexpr SpreadFolder kSpreadFolders[] = {
    {"7-Scenes", "7scenes/redkitchen/*.color.jpg"},
    {"KITTI 03", "kitti/sequences/03/image_0/*.png"},
    {"EuRoC MH_01", "euroc/MH_01_easy/mav0/cam0/data/*.png"},
};

/// Returns the mean spread over 20 images (one in a short run) that are spread over the folder.
double MeanSpread(const Contender& contender, const SpreadFolder& folder, const Arguments& args) {
  std::vector<cv::String> files;
  cv::glob(test::DataPath(folder.pattern).string(), files);
  if (files.empty()) throw Error(test::DataPath(folder.pattern).string() + ": no such files");
  const std::size_t count = args.short_run ? 1 : 20;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const cv::Mat image = cv::imread(files[i * files.size() / count], cv::IMREAD_GRAYSCALE);
    sum += Spread(Describe(contender, image, args.num_features).points, image.size());
  }
  return sum / static_cast<double>(count);
}

std::vector<OctaveBias> BiasOverAll(const Contender& contender, const std::vector<Image>& images,
                                    int num_features) {
  constexpr double kReachPx = 6;
  std::vector<OctaveBias> all;
  for (const Image& image : images) {
    cv::Mat turned;
    cv::rotate(image.image, turned, cv::ROTATE_180);
    for (const OctaveBias& bias :
         MeasureBias(Describe(contender, image.image, num_features).points,
                     Describe(contender, turned, num_features).points, turned.size(), kReachPx)) {
      all.push_back(bias);
    }
  }
  return MergeOctaves(all);
}

/// Returns all tasks in order, or one in 24 in a short run.
std::vector<PairTask> AllTasks(const std::vector<Image>& images, const Arguments& args) {
  std::vector<PairTask> tasks;
  for (const auto& part : {RotationTasks(images), ChangeTasks(images), OxfordTasks(args.oxford)}) {
    tasks.insert(tasks.end(), part.begin(), part.end());
  }
  if (!args.short_run) return tasks;
  std::vector<PairTask> some;
  for (std::size_t i = 0; i < tasks.size(); i += 24) some.push_back(tasks[i]);
  return some;
}

QualityReport MeasureAll(const Arguments& args) {
  const std::vector<Image> images = ReadImages();
  const std::vector<PairTask> tasks = AllTasks(images, args);
  QualityReport report;
  for (const SpreadFolder& folder : kSpreadFolders) report.spread_folders.emplace_back(folder.name);
  for (const Contender& contender : MakeContenders(args.num_features)) {
    fmt::print(stderr, "{} ...\n", contender.name);
    report.contenders.push_back(contender.name);
    for (const PairResult& result : RunTasks(contender, tasks, args.num_features)) {
      report.pairs.push_back(result);
    }
    KeypointResult keypoints = {
        contender.name, {}, BiasOverAll(contender, images, args.num_features)};
    for (const SpreadFolder& folder : kSpreadFolders) {
      keypoints.spread.push_back(MeanSpread(contender, folder, args));
    }
    report.keypoints.push_back(keypoints);
  }
  return report;
}

void WriteFile(const fs::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  stream.close();
  if (!stream) throw Error(file.string() + ": cannot be written");
}

void WriteAll(const QualityReport& report, const Arguments& args) {
  const std::string tables = RequirementTable(report) + "\n" + QualityTable(report);
  fmt::print("{}", tables);
  fs::create_directories(args.output);
  WriteFile(args.output / "quality.md", tables);
  nlohmann::ordered_json json = {{"environment", DescribeMachine()},
                                 {"num_features", args.num_features},
                                 {"tolerance_px", kTolerancePx}};
  json.update(ToJson(report));
  WriteFile(args.output / "quality.json", json.dump(1) + "\n");
  if (!DrawCharts(report, args.output)) fmt::print(stderr, "gnuplot failed: no charts\n");
}

int Main(int argc, char** argv) {
  Arguments args;
  CLI::App app(kHelp);
  app.add_option("-o,--output", args.output, "Folder for what is written")->required();
  app.add_option("--features", args.num_features, "Keypoints an image")
      ->check(CLI::Range(1, 100000));
  app.add_option("--oxford", args.oxford, "Sequences below oxford_affine");
  app.add_flag("--short", args.short_run, "One pair in 24: to see that everything runs");
  CLI11_PARSE(app, argc, argv);
  cv::setNumThreads(1);
  WriteAll(MeasureAll(args), args);
  return 0;
}

}  // namespace
}  // namespace corvo::bench

int main(int argc, char** argv) {
  try {
    return corvo::bench::Main(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "corvo_quality: {}\n", error.what());
    return 1;
  }
}
