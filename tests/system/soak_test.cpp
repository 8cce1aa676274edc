// SPDX-License-Identifier: MIT
// Runs odometry for long over a recording that goes on and on, with blackouts, repeated frames,
// changes of the mask and Reset(), and expects it to use no more memory at the end than at the
// start. $CORVO_SOAK_FRAMES sets the number of frames.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>
#include <opencv2/core.hpp>

#include "apps/synthetic/sequence.h"
#include "tests/support/data.h"
#include "vo/odometry.h"

#if defined(__SANITIZE_ADDRESS__)
#define CORVO_HAS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CORVO_HAS_SANITIZER 1
#endif
#endif

namespace corvo {
namespace {

/// Frames between two calls of Reset(); all disturbances recur with this period.
constexpr int kPeriod = 500;

int NumPeriods() {
  if (test::IsShortRun()) return 1;
  const char* frames = std::getenv("CORVO_SOAK_FRAMES");
  return frames == nullptr ? 5 : std::atoi(frames) / kPeriod;
}

/// Images of a street that are passed forward and backward in turns, and their disturbances.
class EndlessStreet {
 public:
  EndlessStreet() {
    synthetic::SequenceOptions options;
    options.frames = test::IsShortRun() ? 20 : 60;
    options.width = 320;
    options.noise_sigma = 2;
    const synthetic::Sequence sequence = synthetic::MakeStreet(options);
    camera_ = sequence.camera().parameters();
    for (int i = 0; i < sequence.size(); ++i) images_.push_back(sequence.Render(i));
    for (int i = sequence.size() - 2; i > 0; --i) images_.push_back(images_[i]);
    blackout_ = cv::Mat::zeros(images_[0].size(), CV_8U);
    mask_ = cv::Mat(images_[0].size(), CV_8U, cv::Scalar(255));
    mask_.rowRange(mask_.rows * 3 / 4, mask_.rows) = 0;
  }

  const CameraParameters& camera() const { return camera_; }
  const cv::Mat& ImageAt(int frame) const {
    const int phase = frame % kPeriod;
    if (phase >= 200 && phase < 215) return blackout_;
    const bool is_repeat = phase >= 300 && phase < 306;
    return images_[(is_repeat ? 300 : phase) % images_.size()];
  }
  cv::Mat MaskAt(int frame) const {
    const int phase = frame % kPeriod;
    return phase >= 100 && phase < 400 ? mask_ : cv::Mat();
  }

 private:
  CameraParameters camera_;
  std::vector<cv::Mat> images_;
  cv::Mat blackout_, mask_;
};

/// FNV-1a over the bytes of values.
class Hash {
 public:
  template <typename T>
  void Add(const T& value) {
    std::uint8_t bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (const std::uint8_t byte : bytes) value_ = (value_ ^ byte) * 0x100000001b3U;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

void AddResult(const FrameResult& result, Hash& hash) {
  hash.Add(result.state);
  hash.Add(result.reason);
  hash.Add(result.num_matches);
  hash.Add(result.num_inliers);
  if (!result.world_from_camera) return;
  for (int i = 0; i < 3; ++i) hash.Add(result.world_from_camera->translation()[i]);
}

double ToMegabytes(std::size_t bytes) { return static_cast<double>(bytes) / 1e6; }

std::size_t HeapBytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

double ProcessorMs() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// What was measured at the end of a period.
struct Period {
  std::uint64_t hash = 0;  ///< Over the results of all frames of the period.
  std::size_t heap_bytes = 0;
  int num_posed = 0;
  MemoryUse memory;
  double processor_ms = 0;
};

/// The bytes that grow with the number of frames and keyframes: they are all part of the result.
std::size_t HistoryBytes(const Period& period) {
  return period.memory.frame_bytes + period.memory.keyframe_bytes;
}

Period RunPeriod(const EndlessStreet& street, int first, Odometry& odometry) {
  constexpr TimeNs kStepNs = 100'000'000;
  Period period;
  Hash hash;
  const double start_ms = ProcessorMs();
  for (int i = first; i < first + kPeriod; ++i) {
    const FrameResult result = odometry.Process(street.ImageAt(i), i * kStepNs, street.MaskAt(i));
    period.num_posed += result.world_from_camera.has_value();
    AddResult(result, hash);
  }
  period.processor_ms = ProcessorMs() - start_ms;
  period.hash = hash.value();
  period.heap_bytes = HeapBytes();
  period.memory = odometry.memory_use();
  return period;
}

/// Runs all periods, calls `end_period` after each and prints the measurements of every twentieth.
template <typename EndPeriod>
std::vector<Period> RunPeriods(const EndlessStreet& street, Odometry& odometry,
                               EndPeriod end_period) {
  const int num_periods = NumPeriods();
  std::vector<Period> periods;
  for (int i = 0; i < num_periods; ++i) {
    periods.push_back(RunPeriod(street, i * kPeriod, odometry));
    end_period();
    const Period& period = periods.back();
    if (i % 20 == 0 || i == num_periods - 1) {
      fmt::print(
          "frame {}: {:.2f} MB of heap, {:.2f} MB of them frames and keyframes, {:.3f} ms of "
          "processor time per frame\n",
          (i + 1) * kPeriod, ToMegabytes(period.heap_bytes), ToMegabytes(HistoryBytes(period)),
          period.processor_ms / kPeriod);
    }
  }
  EXPECT_GT(periods[0].num_posed, test::IsShortRun() ? 0 : kPeriod * 8 / 10);
  return periods;
}

TEST(SoakTest, OneMapNeedsNoMoreMemoryButForTheHistoryOfItsFrames) {
  CORVO_SKIP_IF_SHORT();
  const EndlessStreet street;
  Odometry odometry(Camera(street.camera()));
  const std::vector<Period> periods = RunPeriods(street, odometry, [] {});
  const auto working_bytes = [](const Period& period) {
    return static_cast<double>(period.heap_bytes - HistoryBytes(period));
  };
  const Period& settled = periods[periods.size() / 2];
  EXPECT_LT(working_bytes(periods.back()), 1.05 * working_bytes(settled));
}

TEST(SoakTest, AfterResetMemoryAndResultsAreAsAtTheStart) {
  const EndlessStreet street;
  Odometry odometry(Camera(street.camera()));
  std::vector<double> bytes_after_reset;
  const std::vector<Period> periods = RunPeriods(street, odometry, [&] {
    odometry.Finish();
    odometry.Reset();
    bytes_after_reset.push_back(static_cast<double>(HeapBytes()));
  });
  // Nothing of what came before Reset() has an influence, so that each period has the same bytes.
  for (const Period& period : periods) ASSERT_EQ(period.hash, periods[0].hash);
#ifndef CORVO_HAS_SANITIZER
  for (const double bytes : bytes_after_reset) ASSERT_LT(bytes, 1.05 * bytes_after_reset[0]);
#endif
}

}  // namespace
}  // namespace corvo
