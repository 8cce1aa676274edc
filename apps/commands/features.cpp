// SPDX-License-Identifier: MIT
#include "apps/commands/features.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/force_flag.h"
#include "apps/dataset/image_source.h"
#include "apps/output/features_output.h"
#include "apps/output/output_folder.h"
#include "apps/output/printable.h"
#include "orb/error.h"
#include "vo/io/config.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFeaturesFooter =
    R"(For each image NAME.png the command writes NAME_features.png, the image with its keypoints (a circle
that grows with the octave, a line in the keypoint's direction, one color per octave), and
NAME_features.csv: x, y (px), octave, angle (degrees), response and descriptor (hexadecimal).

Examples:
  corvo features image.png -o features
  corvo features *.png -o features --config configs/orb_2011.yaml)";

struct FeaturesArguments {
  std::vector<fs::path> images;
  fs::path output;
  fs::path config;
  bool force = false;
};

/// Returns the stem of the names of both result files of an image.
std::string ResultName(const fs::path& image) { return image.stem().string() + "_features"; }

/// Throws corvo::Error if the results of two images would have the same name.
void CheckNames(const std::vector<fs::path>& images) {
  for (auto image = images.begin(); image != images.end(); ++image) {
    const auto twin = std::find_if(images.begin(), image, [&](const fs::path& other) {
      return ResultName(other) == ResultName(*image);
    });
    if (twin == image) continue;
    throw Error(fmt::format("{} and {}: both results would be named {}; use two output folders",
                            twin->string(), image->string(), ResultName(*image)));
  }
}

OutputPlan PlanOf(const FeaturesArguments& arguments) {
  OutputPlan plan;
  plan.names = {"config.yaml"};
  for (const fs::path& image : arguments.images) {
    plan.names.push_back(ResultName(image) + ".csv");
    plan.names.push_back(ResultName(image) + ".png");
  }
  plan.replaces_foreign = arguments.force;
  return plan;
}

/// Writes the results of one image and returns a line that describes them.
std::string ExtractImage(const fs::path& file, const orb::Extractor& extractor,
                         const OutputFolder& output) {
  const cv::Mat image = ReadGrayImage(file);
  const orb::Features features = extractor.Extract(image);
  output.Write(ResultName(file) + ".csv", FeatureTable(features));
  WriteImage(DrawFeatures(image, features, extractor), ResultName(file) + ".png", output);
  return fmt::format("{}: {} features\n", file.string(), features.keypoints.size());
}

void ExtractFeatures(const FeaturesArguments& arguments) {
  CheckNames(arguments.images);
  const OdometryOptions options =
      arguments.config.empty() ? OdometryOptions{} : ReadOptions(arguments.config);
  const orb::Extractor extractor(options.extractor);
  OutputFolder output(arguments.output, PlanOf(arguments));
  output.Write("config.yaml", WriteOptions(options));
  std::string text;
  for (const fs::path& image : arguments.images) text += ExtractImage(image, extractor, output);
  output.Commit();
  fmt::print("{}", Printable(text));
}

}  // namespace

void AddFeaturesCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("features", "Extract the features of images");
  const auto arguments = std::make_shared<FeaturesArguments>();
  command->add_option("IMAGE", arguments->images, "images")->required();
  command->add_option("-o,--output", arguments->output, "folder for the results")->required();
  command->add_option("--config", arguments->config, "options file; see 'corvo config'");
  AddForceFlag(*command, arguments->force);
  command->footer(kFeaturesFooter);
  command->callback([arguments] { ExtractFeatures(*arguments); });
}

}  // namespace corvo
