// SPDX-License-Identifier: MIT
// Disturbs recordings at random, as the world and recorders do, and expects every result to be
// right or to be reported as doubtful.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "apps/dataset/image_source.h"
#include "apps/run/outcome.h"
#include "apps/run/run_warnings.h"
#include "apps/synthetic/sequence.h"
#include "tests/support/data.h"
#include "tests/system/disturbances.h"
#include "vo/io/config.h"
#include "vo/io/trajectory_io.h"
#include "vo/odometry.h"
#include "vo/offline/match_residuals.h"

namespace corvo {
namespace {

using test::Random;
using test::Recording;
using test::Render;

constexpr int kNumFrames = 60;

synthetic::SequenceOptions RenderOptions(int width) {
  synthetic::SequenceOptions options;
  options.frames = test::IsShortRun() ? 15 : kNumFrames;
  options.width = width;
  options.noise_sigma = 2;
  return options;
}

/// Loads the first images of a folder; those without a pose in the truth are left out.
Recording Load(const std::string& folder, const PoseSequence& truth, const CameraParameters* camera,
               int start) {
  const ImageList list = ListImages(test::DataPath(folder));
  Recording recording;
  recording.camera = camera ? *camera : *list.camera;
  const int end = std::min(static_cast<int>(list.images.size()), start + RenderOptions(0).frames);
  for (int i = start; i < end; ++i) {
    const TimeNs time_ns = list.images[i].time_ns;
    const auto pose = std::find_if(truth.begin(), truth.end(), [&](const TimedPose& p) {
      return std::abs(p.time_ns - time_ns) < 10'000'000;
    });
    if (pose == truth.end()) continue;
    recording.images.push_back({ReadGrayImage(list.images[i].file), time_ns});
    recording.truth.push_back({time_ns, pose->world_from_camera});
  }
  return recording;
}

Recording LoadKitti(const std::string& sequence, int start) {
  const std::string folder = "kitti/sequences/" + sequence;
  return Load(folder, test::ReadKittiTruth(sequence), nullptr, start);
}

Recording LoadKitchen(int start) {
  const CameraParameters camera =
      ReadCameraFile(test::SourceDir() / "configs" / "7scenes.yaml").camera.parameters();
  const std::string folder = "7scenes/redkitchen";
  return Load(folder, ReadTum(test::DataPath(folder + "/groundtruth.txt")), &camera, start);
}

/// What a user is told about a run, and how good it is.
struct Verdict {
  bool is_doubted = false;
  double ate = 0;  ///< m; 0 without poses.
};

Verdict Judge(const Recording& recording) {
  Odometry odometry(Camera(recording.camera), {}, 1);
  for (const test::TimedImage& image : recording.images) {
    odometry.Process(image.image, image.time_ns);
  }
  const Trajectory trajectory = odometry.Finish();
  Verdict verdict;
  verdict.is_doubted = JudgeOutcome(trajectory) != Outcome::kDone || odometry.prior_rejected() ||
                       !ResidualWarning(MeasureResiduals(odometry.map(), {})).empty() ||
                       !ScaleWarning(UncertainScaleRanges(trajectory)).empty() ||
                       !BlurWarning(CountBlurredFrames(trajectory), recording.size()).empty();
  if (trajectory.PosedFrames().size() > 2) {
    verdict.ate = test::EvaluatePosed(trajectory, recording.truth).absolute.rmse;
  }
  return verdict;
}

Recording StartLater(Recording recording, int start) {
  recording.images.erase(recording.images.begin(), recording.images.begin() + start);
  recording.truth.erase(recording.truth.begin(), recording.truth.begin() + start);
  return recording;
}

/// Returns the largest error of undisturbed runs that start at different images. They scatter.
double WorstCleanAte(const Recording& recording) {
  double worst = 0;
  const int num_starts = test::IsShortRun() ? 1 : 4;
  for (int start = 0; start < num_starts; ++start) {
    worst = std::max(worst, Judge(StartLater(recording, start)).ate);
  }
  return worst;
}

/// Draws a disturbance. Appends a description of it.
Recording Disturb(const Recording& recording, const Recording& other, Random& random,
                  std::string& description) {
  const int first = random.UniformInt(0, recording.size() / 2);
  const double share = random.Uniform(0.1, 0.5);
  const int kind = random.UniformInt(0, 6);
  switch (kind) {
    case 0: {
      const int times = random.UniformInt(2, 3);
      description += fmt::format(" repeated {} times", times);
      return test::Repeat(recording, times, random);
    }
    case 1:
      description += fmt::format(" overlay {:.2f}", 0.6 * share);
      return test::AddOverlay(recording, 0.6 * share, random);
    case 2: {
      const auto motion = static_cast<test::VehicleMotion>(random.UniformInt(0, 2));
      const int num_frames = random.UniformInt(10, 45);
      description += fmt::format(" vehicle {} from {} for {} covers {:.2f}",
                                 static_cast<int>(motion), first, num_frames, share);
      return test::AddVehicle(recording, {motion, first, num_frames, share}, random);
    }
    case 3:
      description += " cut";
      return test::CutTo(recording, other);
    case 4: {
      const double sigma_px = random.Uniform(0.5, 3);
      const int num_frames = random.UniformInt(1, recording.size());
      description += fmt::format(" blur {:.1f} px from {} for {}", sigma_px, first, num_frames);
      return test::Blur(recording, sigma_px, first, num_frames);
    }
    case 5: {
      const double factor = random.Uniform(0.6, 1.5);
      description += fmt::format(" scaled {:.2f}", factor);
      return test::Scale(recording, factor);
    }
    default: {
      const double sigma = random.Uniform(2, 15);
      description += fmt::format(" noise {:.1f}", sigma);
      return test::AddNoise(recording, sigma, random);
    }
  }
}

/// One in three runs has a second disturbance.
Recording DisturbAtRandom(const Recording& recording, const Recording& other, Random& random,
                          std::string& description) {
  Recording disturbed = Disturb(recording, other, random, description);
  if (random.UniformInt(0, 2) != 0) return disturbed;
  return Disturb(disturbed, disturbed, random, description);
}

/// A recording to disturb, and another place to cut to.
struct Source {
  std::string name;
  std::string data;  ///< The folder that must exist, or empty.
  std::function<Recording()> make;
  std::function<Recording()> make_other;
};

std::vector<Source> Sources() {
  return {{"Room", "", [] { return Render(MakeRoom(RenderOptions(480))); },
           [] { return Render(MakeCorridor(RenderOptions(480))); }},
          {"Street", "", [] { return Render(MakeStreet(RenderOptions(800))); },
           [] {
             Recording other = Render(MakeStreet(RenderOptions(800)));
             for (test::TimedImage& image : other.images) cv::flip(image.image, image.image, 1);
             return other;
           }},
          {"Kitti05", "kitti/sequences/05", [] { return LoadKitti("05", 0); },
           [] { return LoadKitti("06", 0); }},
          {"Kitti03", "kitti/sequences/03", [] { return LoadKitti("03", 100); },
           [] { return LoadKitti("03", 220); }},
          {"Kitchen", "7scenes/redkitchen", [] { return LoadKitchen(100); },
           [] { return LoadKitchen(400); }}};
}

constexpr int kNumBlocks = 2;
constexpr int kRunsPerBlock = 20;

class NoSilentFailureTest : public testing::TestWithParam<std::tuple<int, int>> {};

/// A disturbed run that ends without any doubt has at most five times the error of undisturbed
/// runs.
TEST_P(NoSilentFailureTest, ErrorsAreSmallOrReported) {
  const auto [index, block] = GetParam();
  if (block > 0) CORVO_SKIP_IF_SHORT();
  const Source source = Sources()[index];
  if (!source.data.empty()) CORVO_REQUIRE_DATA(source.data);
  const Recording recording = source.make();
  const Recording other = source.make_other();
  const double clean_ate = WorstCleanAte(recording);
  const int num_runs = test::IsShortRun() ? 1 : kRunsPerBlock;
  for (int run = 0; run < num_runs; ++run) {
    Random random(1000 * index + 100 * block + run + 1);
    std::string description = fmt::format("{} run {}:", source.name, run);
    const Recording disturbed = DisturbAtRandom(recording, other, random, description);
    const Verdict verdict = Judge(disturbed);
    if (test::IsShortRun() || verdict.is_doubted) continue;
    EXPECT_LE(verdict.ate, 5 * clean_ate) << description;
  }
}

INSTANTIATE_TEST_SUITE_P(Sources, NoSilentFailureTest,
                         testing::Combine(testing::Range(0, 5), testing::Range(0, kNumBlocks)),
                         [](const auto& param_info) {
                           return Sources()[std::get<0>(param_info.param)].name +
                                  std::to_string(std::get<1>(param_info.param));
                         });

}  // namespace
}  // namespace corvo
