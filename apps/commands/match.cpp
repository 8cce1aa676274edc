// SPDX-License-Identifier: MIT
#include "apps/commands/match.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "apps/commands/force_flag.h"
#include "apps/dataset/image_source.h"
#include "apps/output/features_output.h"
#include "apps/output/match_images.h"
#include "apps/output/output_folder.h"
#include "apps/output/printable.h"
#include "vo/io/config.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMatchFooter =
    R"(Matches are mutual nearest neighbors within the limits of the options matching.max_tracking_distance
and tracker.max_ratio. The command writes matches.png, both images with the matches (green: inliers
of a homography, red: all others), matches.csv and, if a homography was found, homography.txt, the
3x3 matrix that maps pixels of A to pixels of B, row by row.

Examples:
  corvo match a.png b.png -o matches
  corvo match a.png b.png -o matches --config configs/orb_2011.yaml)";

struct MatchArguments {
  fs::path first;
  fs::path second;
  fs::path output;
  fs::path config;
  bool force = false;
};

std::string HomographyText(const cv::Matx33d& h) {
  return fmt::format("{} {} {}\n{} {} {}\n{} {} {}\n", h(0, 0), h(0, 1), h(0, 2), h(1, 0), h(1, 1),
                     h(1, 2), h(2, 0), h(2, 1), h(2, 2));
}

std::string SummaryText(const MatchArguments& arguments, const ImageMatches& images) {
  return fmt::format("{}: {} features\n{}: {} features\n{} matches, {} inliers of a homography\n",
                     arguments.first.string(), images.first.keypoints.size(),
                     arguments.second.string(), images.second.keypoints.size(),
                     images.matches.size(), images.num_inliers);
}

void Match(const MatchArguments& arguments) {
  const OdometryOptions options =
      arguments.config.empty() ? OdometryOptions{} : ReadOptions(arguments.config);
  OutputPlan plan;
  plan.names = {"config.yaml", "matches.csv", "homography.txt", "matches.png"};
  plan.replaces_foreign = arguments.force;
  OutputFolder output(arguments.output, std::move(plan));
  const cv::Mat first = ReadGrayImage(arguments.first);
  const cv::Mat second = ReadGrayImage(arguments.second);
  const orb::Extractor extractor(options.extractor);
  const ImageMatches images =
      MatchImages(extractor.Extract(first), extractor.Extract(second),
                  options.matching.max_tracking_distance, options.tracker.max_ratio);
  output.Write("config.yaml", WriteOptions(options));
  output.Write("matches.csv", MatchTable(images));
  if (images.second_from_first) {
    output.Write("homography.txt", HomographyText(*images.second_from_first));
  }
  WriteImage(DrawMatches(first, second, images), "matches.png", output);
  output.Commit();
  fmt::print("{}", Printable(SummaryText(arguments, images)));
}

}  // namespace

void AddMatchCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("match", "Match the features of two images");
  const auto arguments = std::make_shared<MatchArguments>();
  command->add_option("A", arguments->first, "first image")->required();
  command->add_option("B", arguments->second, "second image")->required();
  command->add_option("-o,--output", arguments->output, "folder for the results")->required();
  command->add_option("--config", arguments->config, "options file; see 'corvo config'");
  AddForceFlag(*command, arguments->force);
  command->footer(kMatchFooter);
  command->callback([arguments] { Match(*arguments); });
}

}  // namespace corvo
