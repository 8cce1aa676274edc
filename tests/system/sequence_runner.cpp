#include "tests/system/sequence_runner.h"

#include <vector>

#include "vo/odometry.h"

namespace corvo::test {

namespace {

void ProcessAll(const PictureSource& source, int num_frames, Odometry& odometry) {
  for (int i = 0; i < num_frames; ++i) {
    const TimedPicture picture = source(i);
    odometry.Process(picture.image, picture.time_ns);
  }
}

}  // namespace

Trajectory RunOdometry(const PictureSource& source, int num_frames, const Camera& camera) {
  Odometry odometry(camera, OdometryOptions(), 2);
  ProcessAll(source, num_frames, odometry);
  return odometry.Finish();
}

Refinement RunAndRefine(const PictureSource& source, int num_frames, const Camera& camera) {
  Odometry odometry(camera, OdometryOptions(), 2);
  std::vector<FrameSightings> told;
  odometry.SetSightingsSink([&](const FrameSightings& seen) { told.push_back(seen); });
  ProcessAll(source, num_frames, odometry);
  odometry.Finish();
  return Refine(odometry, [&](const SightingsSink& visit) {
    for (const FrameSightings& seen : told) visit(seen);
  });
}

Evaluation EvaluatePosed(const Trajectory& trajectory, const PoseSequence& truth) {
  return Evaluate(trajectory.PosedFrames(), truth);
}

}  // namespace corvo::test
