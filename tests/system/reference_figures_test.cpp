// SPDX-License-Identifier: MIT
// Compares what the odometry does on short rendered sequences, stage by stage, with figures that
// are kept beside this file. A change of behavior that no other test expresses is seen here, and
// in the difference of the figures when they are renewed:
//
//   CORVO_WRITE_REFERENCE_FIGURES=1 test_system --gtest_filter='ReferenceFigures.*'
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "apps/synthetic/sequence.h"
#include "tests/data/data_path.h"
#include "tests/support/data.h"
#include "tests/system/disturbances.h"
#include "tests/system/sequence_runner.h"
#include "vo/odometry.h"
#include "vo/offline/calibration_check.h"
#include "vo/offline/match_residuals.h"
#include "vo/offline/self_calibration.h"

namespace corvo {
namespace {

using test::Recording;
using test::Render;

/// Rounding differs between compilers and processors, and changes a few of the decisions of a run.
constexpr double kRelativeTolerance = 0.005, kAbsoluteTolerance = 1e-4;

/// Figures of one sequence by name.
using Figures = std::map<std::string, double>;

std::filesystem::path FileOf(const std::string& name) {
  return test::SourceDir() / "tests/system/reference_figures" / (name + ".yaml");
}

void Write(const Figures& figures, const std::filesystem::path& file) {
  std::ofstream out(file);
  for (const auto& [name, value] : figures) out << fmt::format("{}: {:.9g}\n", name, value);
}

void ExpectReference(const std::string& name, const Figures& figures) {
  if (std::getenv("CORVO_WRITE_REFERENCE_FIGURES") != nullptr) Write(figures, FileOf(name));
  const auto reference = YAML::LoadFile(FileOf(name).string()).as<Figures>();
  ASSERT_EQ(figures.size(), reference.size());
  for (const auto& [figure, value] : figures) {
    ASSERT_TRUE(reference.contains(figure)) << figure;
    const double expected = reference.at(figure);
    const double scale = std::max(std::abs(expected), std::abs(value));
    EXPECT_NEAR(value, expected, kRelativeTolerance * scale + kAbsoluteTolerance) << figure;
  }
}

synthetic::SequenceOptions Options(int frames, int width) {
  synthetic::SequenceOptions options;
  options.frames = frames;
  options.width = width;
  options.noise_sigma = 3;
  return options;
}

/// Adds the outcomes of frames.
void AddFrames(const std::vector<FrameResult>& frames, Figures& figures) {
  for (const FrameResult& frame : frames) {
    ++figures[fmt::format("frames {}", ToString(frame.state))];
    ++figures[fmt::format("frames, reason {}", ToString(frame.reason))];
    ++figures[fmt::format("frames of segment {}", frame.segment)];
    figures["keyframes"] += frame.is_keyframe;
    figures["repeats"] += frame.repeats != kNoId;
    figures["features"] += frame.num_features;
    figures["finest octaves"] += frame.finest_octave;
    figures["masked share"] += frame.masked_share;
    figures["matches"] += frame.num_matches;
    figures["inliers"] += frame.num_inliers;
    figures["parallax [deg]"] += frame.parallax_deg;
    if (frame.window_adjustment != AdjustmentStatus::kNone) {
      ++figures[fmt::format("windows, {}", ToString(frame.window_adjustment))];
    }
    if (frame.camera_adjustment != AdjustmentStatus::kNone) {
      ++figures[fmt::format("camera estimates, {}", ToString(frame.camera_adjustment))];
    }
  }
}

void AddMap(const Map& map, Figures& figures) {
  figures["landmarks created"] = map.num_landmark_ids();
  figures["landmarks"] = map.num_landmarks();
  figures["joins"] = map.num_joins();
  for (int id = 0; id < map.num_keyframes(); ++id) figures["culled keyframes"] += map.IsCulled(id);
  const std::vector<KeyframeId> active = map.ActiveKeyframes();
  figures["active keyframes"] = static_cast<double>(active.size());
  for (const LandmarkId id : map.FindObserved(active)) {
    const Landmark& landmark = *map.FindLandmark(id);
    figures["track elements"] += static_cast<double>(landmark.track.size());
    figures["landmarks found"] += landmark.num_found;
    figures["landmarks visible"] += landmark.num_visible;
    figures["distances of landmarks"] += landmark.in_world.norm();
    figures["landmarks' largest distances"] += landmark.max_distance;
  }
}

/// Adds the values and standard deviations of a camera's free parameters.
void AddCamera(const std::string& name, const CameraParameters& camera,
               const std::vector<FreeParameter>& free, Figures& figures) {
  for (const FreeParameter& parameter : free) {
    figures[name + parameter.name] = ValueOf(camera, parameter.name);
    figures[name + parameter.name + ", sigma"] = parameter.sigma;
  }
}

void AddTrajectory(const std::string& name, const Trajectory& trajectory, const PoseSequence& truth,
                   Figures& figures) {
  const PoseSequence poses = trajectory.PosedFrames();
  for (std::size_t i = 1; i < poses.size(); ++i) {
    figures[name + "path"] +=
        (poses[i].world_from_camera.translation() - poses[i - 1].world_from_camera.translation())
            .norm();
  }
  figures[name + "ate [m]"] = test::EvaluatePosed(trajectory, truth).absolute.rmse;
}

void AddChecks(const Map& map, Figures& figures) {
  const CalibrationCheck check = CheckCalibration(map);
  figures["checked parts"] = check.num_parts;
  figures["checked parts that agree"] = check.num_agreeing;
  figures["checked focal length [px]"] = check.focal_px;
  if (const auto residuals = MeasureResiduals(map)) {
    figures["residuals"] = residuals->num_matches;
    figures["residuals, median [px]"] = residuals->median_px;
    figures["residuals, least part [px]"] = residuals->least_part_px;
  }
}

/// Runs the odometry, with a focal length that is off by half a percent, and the refinement.
Figures Measure(const Recording& recording) {
  CameraParameters camera = recording.camera;
  camera.fx *= 1.005;
  camera.fy *= 1.005;
  Odometry odometry((Camera(camera)));
  ObservationLog log;
  odometry.SetObservationCallback(log.Callback());
  std::vector<FrameResult> live;
  for (const test::TimedImage& image : recording.images) {
    live.push_back(odometry.Process(image.image, image.time_ns));
  }
  Figures figures;
  AddFrames(live, figures);
  const Trajectory trajectory = odometry.Finish();
  AddTrajectory("", trajectory, recording.truth, figures);
  AddMap(odometry.map(), figures);
  const CameraPrior prior = odometry.camera_prior();
  AddCamera("camera, ", odometry.camera().parameters(),
            Posterior(prior.free, odometry.camera_estimate().covariance), figures);
  AddChecks(odometry.map(), figures);
  const Refinement refinement = Refine(odometry, log);
  AddTrajectory("refined, ", refinement.trajectory, recording.truth, figures);
  figures["refined, cost"] = refinement.adjustment.final_cost;
  figures["refined, landmarks"] = static_cast<double>(refinement.landmarks.size());
  figures["refined, adjusted"] = refinement.num_adjusted;
  figures["refined, placed"] = refinement.num_placed;
  return figures;
}

TEST(ReferenceFigures, OfARoom) {
  CORVO_SKIP_IF_SHORT();
  ExpectReference("room", Measure(Render(MakeRoom(Options(300, 400)), 3)));
}

TEST(ReferenceFigures, OfAStreet) {
  CORVO_SKIP_IF_SHORT();
  ExpectReference("street", Measure(Render(MakeStreet(Options(60, 620)))));
}

TEST(ReferenceFigures, OfAWall) {
  CORVO_SKIP_IF_SHORT();
  ExpectReference("wall", Measure(Render(MakePlanarWall(Options(100, 400)), 2)));
}

TEST(ReferenceFigures, OfARoomThatIsDarkForAWhile) {
  CORVO_SKIP_IF_SHORT();
  synthetic::SequenceOptions options = Options(300, 320);
  options.effects.dark = {2, 3};
  options.effects.blur = {7, 0.5};
  options.turn = {8, 1};
  ExpectReference("dark_room", Measure(Render(MakeRoom(options), 2)));
}

TEST(ReferenceFigures, OfARoomBehindAnOverlayWithRepeatedImages) {
  CORVO_SKIP_IF_SHORT();
  test::Random random(1);
  const Recording room = AddOverlay(Render(MakeRoom(Options(180, 400)), 3), 0.25, random);
  ExpectReference("overlay", Measure(Repeat(room, 2, random)));
}

TEST(ReferenceFigures, OfTwoScenes) {
  CORVO_SKIP_IF_SHORT();
  const Recording room = Render(MakeRoom(Options(240, 400)), 3);
  const Recording wall = Render(MakePlanarWall(Options(240, 400)), 3);
  ExpectReference("two_scenes", Measure(CutTo(room, wall)));
}

TEST(ReferenceFigures, OfACalibration) {
  CORVO_SKIP_IF_SHORT();
  synthetic::SequenceOptions options = Options(300, 0);
  options.camera = MakeRoom(Options(1, 400)).camera().parameters();
  options.camera->k1 = -0.1;
  options.camera->k2 = 0.02;
  const Recording room = Render(MakeRoom(options), 4);
  const CameraCalibration calibration = CalibrateCamera(
      {[&] { return std::make_unique<test::RecordedStream>(room); }}, AllCalibrationModels(), {});
  Figures figures;
  const FocalSearchResult& search = calibration.start.search;
  figures["search, pairs"] = search.num_pairs;
  figures["search, focal length [px]"] = search.camera.fx;
  figures["search, sigma"] = search.focal_sigma;
  for (std::size_t i = 0; i < search.sweep.size(); ++i) {
    figures[fmt::format("search, cost {:02}", i)] = search.sweep[i].cost;
  }
  figures["selected"] = calibration.selected;
  for (const CameraCandidate& candidate : calibration.candidates) {
    const std::string name = fmt::format("{}, ", ToString(candidate.model));
    figures[name + "usable"] = candidate.adjustment.is_usable();
    if (!candidate.adjustment.is_usable()) continue;
    figures[name + "criterion"] = candidate.information_criterion;
    figures[name + "inliers"] = candidate.adjustment.num_inliers;
    AddCamera(name, candidate.adjustment.camera, EstimatedSigmas(candidate), figures);
  }
  ExpectReference("calibration", figures);
}

}  // namespace
}  // namespace corvo
