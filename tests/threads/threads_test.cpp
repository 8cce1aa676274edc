// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <latch>
#include <thread>
#include <vector>

#include "orb/extractor.h"
#include "tests/vo/two_walls.h"
#include "vo/odometry.h"
#include "vo/offline/observation_log.h"
#include "vo/offline/refiner.h"

namespace corvo {
namespace {

/// Calls `work(i)` for every i in [0, count), each on a thread of its own and all at once.
template <typename Work>
void OnThreads(int count, const Work& work) {
  // OpenCV makes its allocator with the first image, and the thread sanitizer does not see its
  // lock.
  const cv::Mat first_image(1, 1, CV_8UC1);
  std::latch start(count);
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i) {
    threads.emplace_back([&, i] {
      start.arrive_and_wait();
      work(i);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

/// Everything that a run estimates, as numbers.
std::vector<double> RunDrive(std::uint64_t seed, int num_frames, int threads) {
  const test::TwoWalls walls(seed);
  Odometry odometry(test::LongDriveCamera(), OdometryOptions(), threads);
  ObservationLog log;
  odometry.SetObservationCallback(log.Callback());
  for (int i = 0; i < num_frames; ++i) {
    cv::Mat image;
    cv::resize(walls.Render(0.1 * i), image, {320, 240}, 0, 0, cv::INTER_AREA);
    odometry.Process(image, (i + 1) * TimeNs{100'000'000});
  }
  std::vector<double> numbers = {odometry.Finish().PosedShare(), odometry.camera().fx()};
  const Refinement refinement = Refine(odometry, log);
  for (const FrameResult& frame : refinement.trajectory.frames) {
    numbers.push_back(frame.num_inliers);
    if (!frame.world_from_camera) continue;
    const SE3::Data data = frame.world_from_camera->data();
    numbers.insert(numbers.end(), data.begin(), data.end());
  }
  return numbers;
}

TEST(Threads, ManyOdometriesOnManyThreadsGiveTheResultsOfEachAlone) {
  constexpr int kCount = 4, kFrames = 15;
  std::vector<std::vector<double>> results(kCount);
  OnThreads(kCount, [&](int i) { results[i] = RunDrive(i, kFrames, 1 + i % 2); });
  for (int i = 0; i < kCount; ++i) {
    EXPECT_GT(results[i][0], 0.5) << i;
    EXPECT_EQ(results[i], RunDrive(i, kFrames, 1)) << i;
  }
}

TEST(Threads, OneExtractorGivesManyThreadsTheFeaturesOfEachImage) {
  constexpr int kCount = 6;
  const std::vector<cv::Mat> images = test::MakeDrive(kCount, 4);
  const orb::Extractor extractor({}, 2);
  std::vector<orb::Features> features(kCount);
  OnThreads(kCount, [&](int i) { features[i] = extractor.Extract(images[i]); });
  for (int i = 0; i < kCount; ++i) EXPECT_EQ(features[i], orb::Extractor().Extract(images[i])) << i;
}

}  // namespace
}  // namespace corvo
