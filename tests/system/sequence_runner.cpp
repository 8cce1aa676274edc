// SPDX-License-Identifier: MIT
#include "tests/system/sequence_runner.h"

#include <vector>

#include "tests/support/data.h"
#include "vo/io/trajectory_io.h"
#include "vo/odometry.h"

namespace corvo::test {

namespace {

void ProcessAll(const ImageSource& source, int num_frames, Odometry& odometry) {
  for (int i = 0; i < num_frames; ++i) {
    const TimedImage image = source(i);
    odometry.Process(image.image, image.time_ns);
  }
}

}  // namespace

Trajectory RunOdometry(const ImageSource& source, int num_frames, const Camera& camera) {
  Odometry odometry(camera, OdometryOptions(), 2);
  ProcessAll(source, num_frames, odometry);
  return odometry.Finish();
}

Refinement RunAndRefine(const ImageSource& source, int num_frames, const Camera& camera) {
  Odometry odometry(camera, OdometryOptions(), 2);
  ObservationLog log;
  odometry.SetObservationCallback(log.Callback());
  ProcessAll(source, num_frames, odometry);
  odometry.Finish();
  return Refine(odometry, log);
}

PoseSequence ReadKittiTruth(const std::string& sequence) {
  return WithTimes(ReadKittiPoses(DataPath("kitti/poses/" + sequence + ".txt")),
                   ReadKittiTimes(DataPath("kitti/sequences/" + sequence + "/times.txt")));
}

Evaluation EvaluatePosed(const Trajectory& trajectory, const PoseSequence& truth) {
  return Evaluate(trajectory.PosedFrames(), truth);
}

}  // namespace corvo::test
