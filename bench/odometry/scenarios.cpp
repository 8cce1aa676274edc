// SPDX-License-Identifier: MIT
#include "bench/odometry/scenarios.h"

#include <filesystem>

#include "tests/data/data_path.h"

namespace corvo::bench {
namespace {

namespace fs = std::filesystem;

fs::path ShippedCamera(const std::string& name) { return test::SourceDir() / "configs" / name; }

/// Returns the scenario of a recorded sequence. `camera` names a shipped camera file; if it is
/// empty, the dataset's own calibration is used.
Scenario Recorded(std::string title, const std::string& folder, const std::string& truth,
                  const std::string& camera, int max_count = 500) {
  RecordingFiles files;
  files.folder = test::DataPath(folder);
  if (!truth.empty()) files.truth = test::DataPath(truth);
  if (!camera.empty()) files.camera = ShippedCamera(camera);
  return {std::move(title),
          [files, max_count] { return ReadRecording(files, max_count); },
          {0, 3, 7, 13, 20}};
}

Scenario RecordedKitti(const std::string& number, const std::string& camera) {
  return Recorded("KITTI " + number + (camera.empty() ? ", nominal" : ", with distortion"),
                  "kitti/sequences/" + number, "kitti/poses/" + number + ".txt", camera);
}

/// Returns a recording of `frames` images that repeats another, without ground truth. Images are
/// rendered beforehand.
Recording Repeat(const Recording& recording, int frames) {
  std::vector<cv::Mat> images;
  for (int i = 0; i < recording.size(); ++i) images.push_back(recording.image(i));
  Recording repeated{recording.camera, {}, {}, {}};
  const TimeNs frame_time = recording.times[1] - recording.times[0];
  for (int i = 0; i < frames; ++i) repeated.times.push_back(i * frame_time);
  repeated.image = [images](int i) { return images[i % images.size()]; };
  return repeated;
}

}  // namespace

std::vector<Scenario> RecordedScenarios() {
  const std::string rpy = "tum/rgbd_dataset_freiburg1_rpy";
  const std::string euroc = "euroc/MH_01_easy/mav0";
  return {
      RecordedKitti("03", "kitti_03_distorted.yaml"),
      RecordedKitti("03", ""),
      RecordedKitti("05", "kitti_04-12_distorted.yaml"),
      RecordedKitti("05", ""),
      RecordedKitti("06", "kitti_04-12_distorted.yaml"),
      RecordedKitti("06", ""),
      Recorded("7-Scenes redkitchen", "7scenes/redkitchen", "7scenes/redkitchen/groundtruth.txt",
               "7scenes.yaml"),
      Recorded("EuRoC MH_01", euroc, euroc + "/state_groundtruth_estimate0/data.csv", ""),
      Recorded("EuRoC V1_01, standing still", "euroc/V1_01_easy/mav0", "", ""),
      Recorded("TUM fr1/rpy", rpy, rpy + "/groundtruth.txt", "tum_fr1.yaml", 120),
  };
}

std::vector<Scenario> RenderedScenarios() {
  const auto street = [] {
    synthetic::SequenceOptions options;
    options.frames = 2700;
    options.effects.moving_share = 0.2;
    return RenderRecording(synthetic::MakeStreet(options));
  };
  const auto room = [] {
    synthetic::SequenceOptions options;
    options.frames = 600;
    options.noise_sigma = 3;
    options.effects.dark = {4, 3};
    options.effects.blur = {12, 2};
    options.turn = {16, 2};
    return RenderRecording(synthetic::MakeRoom(options));
  };
  return {{"rendered street, 2 km, 20% moving", street},
          {"rendered room, 3 s dark, 2 s blur, fast turn", room}};
}

std::vector<Scenario> EnduranceScenarios(int frames) {
  const auto street = [frames] {
    synthetic::SequenceOptions options;
    options.frames = 1500;  // At its end, the working set has nothing of its start.
    options.width = 480;
    return Repeat(RenderRecording(synthetic::MakeStreet(options)), frames);
  };
  const auto room = [frames] {
    synthetic::SequenceOptions options;
    options.frames = frames;
    options.width = 320;
    return RenderRecording(synthetic::MakeRoom(options));
  };
  return {{"street, again and again", street}, {"room, round and round", room}};
}

}  // namespace corvo::bench
