// SPDX-License-Identifier: MIT
#include "apps/commands/learn.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/commands/force_flag.h"
#include "apps/dataset/image_source.h"
#include "apps/output/output_folder.h"
#include "apps/output/printable.h"
#include "apps/run/progress_line.h"
#include "apps/synthetic/random.h"
#include "apps/synthetic/training_pairs.h"
#include "orb/error.h"
#include "orb/pattern_file.h"
#include "orb/pattern_learning.h"
#include "orb/workers.h"
#include "vo/io/config.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLearnFooter =
    R"(Keypoints of the images are detected again in synthetic views of them. The command selects 256 binary
tests that distinguish the views of one keypoint from other keypoints and have little correlation
(Rublee et al., "ORB: an efficient alternative to SIFT or SURF", ICCV 2011, section 4.3, extended
with the views). The order of the images does not matter. 300,000 keypoints need 0.9 GB of memory.
To use the pattern, set the option extractor.pattern to the written file.

Examples:
  corvo learn photographs -o pattern.inc
  corvo learn photographs -o pattern.inc --keypoints 20000 --source "our street")";

struct LearnArguments {
  std::vector<fs::path> images;
  fs::path output;
  fs::path config;
  std::string source;
  bool force = false;
  int num_keypoints = 300000;
  int threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 256);
};

/// Returns the given images and the images in the given folders, sorted by path.
std::vector<fs::path> ListTrainingImages(const std::vector<fs::path>& paths) {
  std::vector<fs::path> images;
  for (const fs::path& path : paths) {
    if (!fs::is_directory(path)) {
      images.push_back(path);
      continue;
    }
    for (const TimedFile& file : ListImages(path).images) images.push_back(file.file);
  }
  std::sort(images.begin(), images.end());
  return images;
}

/// Reports the progress of learning on standard error: as a bar on a terminal, otherwise as one
/// line per stage.
class LearningReport {
 public:
  void ShowSampling(int round, int num_sampled, int num_wanted) {
    Show(fmt::format("views {}", round + 1), static_cast<double>(num_sampled) / num_wanted,
         fmt::format("{} of {} keypoints", num_sampled, num_wanted));
  }

  void ShowSelection(const orb::SelectionProgress& progress) {
    Show(fmt::format("correlations up to {:.2f}", progress.max_correlation),
         static_cast<double>(progress.num_chosen) / orb::kNumTests,
         fmt::format("{} of {} tests", progress.num_chosen, orb::kNumTests));
  }

 private:
  void Show(const std::string& stage, double share, const std::string& text) {
    line_.Show(share, stage + ": " + text);
    if (!line_.is_terminal() && stage != stage_) spdlog::info("{}", stage);
    stage_ = stage;
  }

  ProgressLine line_;
  std::string stage_;
};

/// Samples a batch of images in parallel, each with its own view of this round. `first` is the
/// index of the batch's first image among all images.
std::vector<TrainingPairs> SampleImages(std::span<const fs::path> batch, int first, int round,
                                        const TrainingPairSampler& sampler, orb::Workers& workers) {
  std::vector<TrainingPairs> pairs(batch.size());
  workers.ForEach(static_cast<int>(batch.size()), [&](int i) {
    const cv::Mat image = ReadGrayImage(batch[i]);
    pairs[i] = sampler.Sample(image, synthetic::Hash(0, round, first + i));
  });
  return pairs;
}

/// Samples all images repeatedly, with a different view of each in every round, until the training
/// set is full or kMaxRounds is reached.
orb::TrainingSet SampleKeypoints(const LearnArguments& arguments,
                                 const std::vector<fs::path>& images, LearningReport& report) {
  constexpr int kMaxRounds = 20;
  constexpr int kBatch = 16;
  const OdometryOptions options =
      arguments.config.empty() ? OdometryOptions{} : ReadOptions(arguments.config);
  const TrainingPairSampler sampler(options.extractor);
  orb::Workers workers(arguments.threads);
  orb::TrainingSet training(arguments.num_keypoints);
  const int num_images = static_cast<int>(images.size());
  for (int round = 0; round < kMaxRounds; ++round) {
    for (int begin = 0; begin < num_images && !training.is_full(); begin += kBatch) {
      const auto batch = std::span(images).subspan(begin, std::min(kBatch, num_images - begin));
      for (const auto& [first, second] : SampleImages(batch, begin, round, sampler, workers)) {
        training.Add(first, second);
      }
      report.ShowSampling(round, training.size(), arguments.num_keypoints);
    }
  }
  return training;
}

std::string FileText(const LearnArguments& arguments, int num_images, int num_keypoints,
                     const orb::LearningResult& result) {
  std::string text = fmt::format(
      "// Binary tests of 5x5 windows, learned by corvo learn from {} images:\n", num_images);
  if (!arguments.source.empty()) text += fmt::format("// {}\n", arguments.source);
  text += fmt::format(
      "// {} keypoints, each in two views. Correlation of two tests: at most {:.2f}.\n"
      "// Bits that differ between the views: {:.1f}%. Each line: px, py, qx, qy,\n",
      num_keypoints, result.max_correlation, 100 * result.flip_rate);
  return text + orb::PatternText(result.pattern);
}

void Learn(const LearnArguments& arguments) {
  OutputFolder output(fs::absolute(arguments.output).parent_path(),
                      PlanOfFile(arguments.output, {}, arguments.force));
  if (arguments.source.find_first_of("\r\n\\") != std::string::npos) {
    throw Error("--source must be one line without backslashes");
  }
  const std::vector<fs::path> images = ListTrainingImages(arguments.images);
  LearningReport report;
  const orb::TrainingSet training = SampleKeypoints(arguments, images, report);
  const orb::LearningResult result = orb::LearnPattern(
      training, arguments.threads,
      [&](const orb::SelectionProgress& progress) { report.ShowSelection(progress); });
  const std::string name = arguments.output.filename().string();
  output.Write(name, FileText(arguments, static_cast<int>(images.size()), training.size(), result));
  output.Commit();
  fmt::print("{}: {} tests from {} keypoints of {} images\n", Printable(arguments.output.string()),
             orb::kNumTests, training.size(), images.size());
}

}  // namespace

void AddLearnCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("learn", "Learn the binary tests of descriptors from images");
  const auto arguments = std::make_shared<LearnArguments>();
  command->add_option("IMAGE", arguments->images, "images or folders of images")->required();
  command->add_option("-o,--output", arguments->output, "pattern file to write")->required();
  command
      ->add_option("--keypoints", arguments->num_keypoints,
                   "maximum number of keypoints to learn from")
      ->check(CLI::Range(orb::kMinTrainingSize, 1000000))
      ->capture_default_str();
  command->add_option("--source", arguments->source,
                      "origin of the images, written to the file as a comment");
  command->add_option("--config", arguments->config, "options file; see 'corvo config'");
  command
      ->add_option("--threads", arguments->threads,
                   "number of threads; does not affect the result (default: number of processors)")
      ->check(CLI::Range(1, 256));
  AddForceFlag(*command, arguments->force);
  command->footer(kLearnFooter);
  command->callback([arguments] { Learn(*arguments); });
}

}  // namespace corvo
