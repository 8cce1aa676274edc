#include "bench/odometry/cost.h"

#include <numeric>

#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>

#include "bench/clocks.h"
#include "bench/paired_times.h"
#include "bench/percentile.h"
#include "vo/odometry.h"

namespace corvo::bench {
namespace {

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double TimeOf(const auto& task) {
  const double start = ProcessTimeMs();
  task();
  return ProcessTimeMs() - start;
}

/// As corvo chooses it where it is not told.
int NumKeypoints(const Recording& recording, const OdometryOptions& options) {
  if (options.extractor.num_features > 0) return options.extractor.num_features;
  return recording.camera.width() >= 1000 ? 2000 : 1000;
}

}  // namespace

Cost MeasureCost(const Recording& recording, const OdometryOptions& options, int repeats) {
  cv::setNumThreads(1);
  std::vector<cv::Mat> pictures;
  for (int i = 0; i < recording.size(); ++i) pictures.push_back(recording.picture(i));
  const int keypoints = NumKeypoints(recording, options);
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(keypoints);
  LeastTimes odometry_times(recording.size()), orb_times(recording.size());
  for (int repeat = 0; repeat < repeats; ++repeat) {
    Odometry odometry(recording.camera, options);
    for (int i = 0; i < recording.size(); ++i) {
      odometry_times.Add(i, TimeOf([&] { odometry.Process(pictures[i], recording.times[i]); }));
      orb_times.Add(i, TimeOf([&] {
                      std::vector<cv::KeyPoint> points;
                      cv::Mat descriptors;
                      orb->detectAndCompute(pictures[i], cv::noArray(), points, descriptors);
                    }));
    }
  }
  Cost cost;
  cost.keypoints = keypoints;
  cost.odometry_ms = Mean(odometry_times.ms());
  cost.orb_ms = Mean(orb_times.ms());
  cost.ratio = cost.odometry_ms / cost.orb_ms;
  cost.p99_over_median = Percentile(odometry_times.ms(), 99) / Percentile(odometry_times.ms(), 50);
  return cost;
}

}  // namespace corvo::bench
