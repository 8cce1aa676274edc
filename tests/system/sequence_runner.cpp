#include "tests/system/sequence_runner.h"

#include <cstdlib>

#include "vo/odometry.h"

namespace corvo::test {

bool IsShortRun() { return std::getenv("CORVO_SHORT_TESTS") != nullptr; }

Trajectory RunOdometry(const PictureSource& source, int num_frames, const Camera& camera) {
  Odometry odometry(camera, OdometryOptions(), 2);
  for (int i = 0; i < num_frames; ++i) {
    const TimedPicture picture = source(i);
    odometry.Process(picture.image, picture.time_ns);
  }
  return odometry.GetTrajectory();
}

Evaluation EvaluatePosed(const Trajectory& trajectory, const PoseSequence& truth) {
  return Evaluate(trajectory.PosedFrames(), truth);
}

}  // namespace corvo::test
