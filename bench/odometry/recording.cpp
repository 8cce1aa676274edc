// SPDX-License-Identifier: MIT
#include "bench/odometry/recording.h"

#include <utility>

#include <fmt/format.h>

#include "apps/dataset/ground_truth.h"
#include "apps/dataset/image_source.h"
#include "orb/error.h"
#include "vo/io/config.h"

namespace corvo::bench {
namespace {

Camera ChooseCamera(const RecordingFiles& files, const ImageList& list) {
  if (!files.camera.empty()) return ReadCameraFile(files.camera).camera;
  if (list.camera) return Camera(*list.camera);
  throw Error(fmt::format("{}: ships no calibration", files.folder.string()));
}

}  // namespace

Recording ReadRecording(const RecordingFiles& files, int max_count) {
  ImageList list = ListImages(files.folder);
  Recording recording{ChooseCamera(files, list), {}, {}, {}};
  for (const TimedFile& image : list.images) recording.times.push_back(image.time_ns);
  if (!files.truth.empty()) recording.truth = ReadGroundTruth(files.truth, recording.times);
  if (recording.size() > max_count) recording.times.resize(max_count);
  recording.image = [images = std::move(list.images)](int i) {
    return ReadGrayImage(images[i].file);
  };
  return recording;
}

Recording StartAt(const Recording& recording, int start) {
  CheckRange("start", start, 0, recording.size() - 1);
  Recording shortened = recording;
  shortened.times.erase(shortened.times.begin(), shortened.times.begin() + start);
  shortened.image = [start, image = recording.image](int i) { return image(start + i); };
  return shortened;
}

Recording RenderRecording(const synthetic::Sequence& sequence) {
  Recording recording{sequence.camera(), {}, sequence.poses(), {}};
  for (const TimedPose& pose : sequence.poses()) recording.times.push_back(pose.time_ns);
  recording.image = [sequence](int i) { return sequence.Render(i); };
  return recording;
}

}  // namespace corvo::bench
