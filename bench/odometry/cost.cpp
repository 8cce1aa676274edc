// SPDX-License-Identifier: MIT
#include "bench/odometry/cost.h"

#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>

#include "bench/clocks.h"
#include "bench/paired_times.h"
#include "vo/math/percentile.h"
#include "vo/odometry.h"

namespace corvo::bench {
namespace {

double ProcessorMsOf(const auto& task) {
  const double start = ProcessTimeMs();
  task();
  return ProcessTimeMs() - start;
}

/// Returns the number of keypoints of the options or, if that is 0, corvo's default.
int NumKeypoints(const Recording& recording, const OdometryOptions& options) {
  if (options.extractor.num_features > 0) return options.extractor.num_features;
  return recording.camera.width() >= 1000 ? 2000 : 1000;
}

}  // namespace

Cost MeasureCost(const Recording& recording, const OdometryOptions& options, int repeats) {
  cv::setNumThreads(1);
  std::vector<cv::Mat> images;
  for (int i = 0; i < recording.size(); ++i) images.push_back(recording.image(i));
  const int keypoints = NumKeypoints(recording, options);
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(keypoints);
  LeastTimes process_times(recording.size()), totals(2);
  for (int repeat = 0; repeat < repeats; ++repeat) {
    totals.Add(0, ProcessorMsOf([&] {
                 Odometry odometry(recording.camera, options);
                 for (int i = 0; i < recording.size(); ++i) {
                   const double start = WallTimeMs();
                   odometry.Process(images[i], recording.times[i]);
                   process_times.Add(i, WallTimeMs() - start);
                 }
                 odometry.Finish();
               }));
    totals.Add(1, ProcessorMsOf([&] {
                 for (const cv::Mat& image : images) {
                   std::vector<cv::KeyPoint> points;
                   cv::Mat descriptors;
                   orb->detectAndCompute(image, cv::noArray(), points, descriptors);
                 }
               }));
  }
  Cost cost;
  cost.keypoints = keypoints;
  cost.odometry_ms = totals.ms()[0] / recording.size();
  cost.orb_ms = totals.ms()[1] / recording.size();
  cost.ratio = cost.odometry_ms / cost.orb_ms;
  cost.median_ms = Percentile(process_times.ms(), 50);
  cost.p99_ms = Percentile(process_times.ms(), 99);
  return cost;
}

}  // namespace corvo::bench
