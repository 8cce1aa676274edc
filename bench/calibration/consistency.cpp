// SPDX-License-Identifier: MIT
#include "bench/calibration/consistency.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "bench/calibration/statistics.h"
#include "tests/support/random.h"
#include "vo/math/percentile.h"

namespace corvo::bench {
namespace {

const std::vector<FreeParameter> kFree = {{"focal", 0.01}, {"k1", 0.03}, {"k2", 0.02}};

Eigen::VectorXd Draw(int seed) {
  test::Random random(1'000'000 + static_cast<std::uint64_t>(seed));
  Eigen::VectorXd draw(static_cast<Eigen::Index>(kFree.size()));
  for (Eigen::Index i = 0; i < draw.size(); ++i) draw[i] = random.Gaussian(kFree[i].sigma);
  return draw;
}

Eigen::VectorXd DrawOf(const ConsistencyTrial& trial) {
  return Eigen::Map<const Eigen::VectorXd>(trial.draw.data(),
                                           static_cast<Eigen::Index>(trial.draw.size()));
}

/// The results of a run at one stage: the members of CameraRun to evaluate.
struct Stage {
  std::string name;
  double CameraRun::*ate;
  CameraEstimate CameraRun::*estimate;
};

const Stage kRunning = {"while it runs", &CameraRun::ate, &CameraRun::estimate};
const Stage kRefined = {"refined", &CameraRun::refined_ate, &CameraRun::refined_estimate};

Miss MissOf(const ConsistencyTrial& trial, const Stage& stage) {
  const CameraEstimate& estimate = trial.wrong.*stage.estimate;
  return {estimate.difference - DrawOf(trial), estimate.covariance};
}

/// Returns the largest absolute entry in standard deviations of the prior.
double LargestInSigmas(const Eigen::VectorXd& difference) {
  double largest = 0;
  for (Eigen::Index i = 0; i < difference.size(); ++i) {
    largest = std::max(largest, std::abs(difference[i]) / kFree[i].sigma);
  }
  return largest;
}

using Trials = std::vector<const ConsistencyTrial*>;

Trials SelectTrials(const std::vector<ConsistencyTrial>& trials,
                    const std::vector<RenderScene>& scenes) {
  Trials selected;
  for (const ConsistencyTrial& trial : trials) {
    const bool is_meant = std::any_of(scenes.begin(), scenes.end(), [&](RenderScene scene) {
      return ToString(scene) == trial.scene;
    });
    if (is_meant) selected.push_back(&trial);
  }
  return selected;
}

std::string ConsistencyLine(const Stage& stage, const std::string& title, const Trials& trials) {
  if (trials.empty()) return "";
  std::vector<Miss> misses;
  int contradictions = 0;
  for (const ConsistencyTrial* trial : trials) {
    misses.push_back(MissOf(*trial, stage));
    contradictions += trial->wrong.prior_rejected;
  }
  const Consistency consistency = Judge(misses);
  std::string line =
      fmt::format("| {}, {} | {} | {} | {:.2f} |", title, stage.name, consistency.count,
                  contradictions, consistency.mean_normalized_squared_error);
  for (std::size_t i = 0; i < kFree.size(); ++i) {
    const auto parameter = static_cast<Eigen::Index>(i);
    line += fmt::format(" {:.0f} | {:.4f} / {:.4f} |",
                        100 * consistency.share_within_3_sigma[parameter],
                        consistency.rms_error[parameter], consistency.mean_sigma[parameter]);
  }
  return line + "\n";
}

std::string Spread(const std::vector<double>& values) {
  return fmt::format("{:.2f} ({:.2f} - {:.2f})", Percentile(values, 50), Percentile(values, 10),
                     Percentile(values, 90));
}

std::string AteLine(const Stage& stage, const std::string& title, const Trials& trials) {
  if (trials.empty()) return "";
  std::vector<double> exact, shipped, wrong;
  int num_close = 0;
  for (const ConsistencyTrial* trial : trials) {
    exact.push_back(trial->exact.*stage.ate / (trial->fixed.*stage.ate));
    shipped.push_back(trial->shipped.*stage.ate / (trial->fixed.*stage.ate));
    wrong.push_back(trial->wrong.*stage.ate / (trial->fixed.*stage.ate));
    num_close += wrong.back() <= 1.3;
  }
  return fmt::format("| {}, {} | {} | {} | {} | {:.0f} |\n", title, stage.name, Spread(exact),
                     Spread(shipped), Spread(wrong),
                     100.0 * num_close / static_cast<double>(trials.size()));
}

std::string MoveLine(const std::string& title, const Trials& trials) {
  if (trials.empty()) return "";
  std::vector<double> exact, wrong, given_miss, miss;
  for (const ConsistencyTrial* trial : trials) {
    exact.push_back(LargestInSigmas(trial->exact.estimate.difference));
    wrong.push_back(LargestInSigmas(trial->wrong.estimate.difference));
    given_miss.push_back(LargestInSigmas(DrawOf(*trial)));
    miss.push_back(LargestInSigmas(MissOf(*trial, kRunning).error));
  }
  std::string line = fmt::format("| {} | {} |", title, trials.size());
  for (const std::vector<double>& values : {exact, wrong, given_miss, miss}) {
    line += fmt::format(" {:.2f} ({:.2f}) |", Percentile(values, 50), Percentile(values, 100));
  }
  return line + "\n";
}

}  // namespace

ConsistencyTrial RunConsistencyTrial(const ScenePart& part, const OdometryOptions& options,
                                     bool refine) {
  const Recording film = Render(part);
  const Eigen::VectorXd draw = Draw(part.seed);
  const CameraPrior exact{film.camera.parameters(), kFree};
  const CameraPrior wrong{exact.Apply(-draw), kFree};
  return {ToString(part.scene),
          part.seed,
          {draw.begin(), draw.end()},
          RunWithCamera(film, {exact.given, {}}, options, refine),
          RunWithCamera(film, exact, options, refine),
          RunWithCamera(film, MakePrior(exact.given, options.calibration), options, refine),
          RunWithCamera(film, wrong, options, refine)};
}

std::string ConsistencyTables(const std::vector<ConsistencyTrial>& trials, bool refined) {
  const Trials streets = SelectTrials(trials, {RenderScene::kStreet});
  const Trials rooms = SelectTrials(trials, {RenderScene::kRoom});
  const Trials both = SelectTrials(trials, {RenderScene::kStreet, RenderScene::kRoom});
  std::string consistent =
      "| given a wrong camera | runs | contradictions | normalized squared error | focal in 3 "
      "sigma, % | error / sigma | k1 in 3 sigma, % | error / sigma | k2 in 3 sigma, % | error / "
      "sigma |\n|---|---|---|---|---|---|---|---|---|---|\n";
  std::string ates =
      "\n| ATE over that with the true camera fixed, median (10% - 90%) | true camera given, "
      "estimated | the same, sigmas of the options | wrong camera given, estimated | of these "
      "within 1.3, % |\n|---|---|---|---|---|\n";
  std::vector<Stage> stages = {kRunning};
  if (refined) stages.push_back(kRefined);
  for (const Stage& stage : stages) {
    for (const auto& [title, of_scene] :
         {std::pair("street", &streets), std::pair("room", &rooms), std::pair("both", &both)}) {
      consistent += ConsistencyLine(stage, title, *of_scene);
      ates += AteLine(stage, title, *of_scene);
    }
  }
  return consistent + ates +
         "\n| largest, in sigmas of the prior, median (worst) | runs | move from the true camera, "
         "given | move from a wrong camera, given | that one's error | what is left of it "
         "|\n|---|---|---|---|---|---|\n" +
         MoveLine("straight on", SelectTrials(trials, {RenderScene::kStraight})) +
         MoveLine("pure rotation", SelectTrials(trials, {RenderScene::kRotation}));
}

}  // namespace corvo::bench
