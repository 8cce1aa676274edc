// SPDX-License-Identifier: MIT
#include "bench/odometry/endurance.h"

#include <fstream>

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include "apps/output/landmark_spool.h"
#include "bench/clocks.h"

namespace corvo::bench {
namespace {

std::size_t HeapBytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Returns the resident memory of the process after the allocator has released its free memory.
std::size_t ResidentBytes() {
  malloc_trim(0);
  std::size_t total_pages = 0, resident_pages = 0;
  std::ifstream("/proc/self/statm") >> total_pages >> resident_pages;
  return resident_pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Runs odometry on a recording in steps.
class Runner {
 public:
  Runner(const Recording& recording, const OdometryOptions& options)
      : recording_(recording), odometry_(recording.camera, options) {
    odometry_.SetLandmarkCallback(
        [this](const MarginalizedLandmark& landmark) { spool_.Add(landmark); });
  }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  Holding RunUntil(int frames) {
    double total_ms = 0;
    const int before = next_;
    for (; next_ < frames; ++next_) {
      const cv::Mat image = recording_.image(next_);
      const double start_ms = ProcessTimeMs();
      const FrameResult result = odometry_.Process(image, recording_.times[next_]);
      total_ms += ProcessTimeMs() - start_ms;
      num_posed_ += result.world_from_camera.has_value();
    }
    Holding holding = Measure();
    holding.processor_ms = total_ms / (next_ - before);
    return holding;
  }

 private:
  Holding Measure() const {
    Holding holding;
    holding.frames = next_;
    holding.posed_frames = num_posed_;
    holding.keyframes = odometry_.map().num_keyframes();
    holding.kept_keyframes = static_cast<int>(odometry_.map().ActiveKeyframes().size());
    holding.landmarks = odometry_.map().num_landmarks();
    holding.memory = odometry_.memory_use();
    holding.spooled_bytes = spool_.num_bytes();
    holding.heap_bytes = HeapBytes() - heap_before_;
    holding.resident_bytes = ResidentBytes() - resident_before_;
    return holding;
  }

  const Recording& recording_;
  std::size_t heap_before_ = HeapBytes();
  std::size_t resident_before_ = ResidentBytes();
  LandmarkSpool spool_;
  Odometry odometry_;
  int next_ = 0;
  int num_posed_ = 0;
};

}  // namespace

void MeasureHoldings(const Recording& recording, const OdometryOptions& options,
                     const std::vector<int>& after_frames,
                     const std::function<void(const Holding&)>& report) {
  Runner runner(recording, options);
  for (const int frames : after_frames) report(runner.RunUntil(frames));
}

std::string HoldingHead() {
  return "| scene | frames | posed | keyframes | of them kept | landmarks | working set, MB | "
         "bytes a frame | bytes a keyframe | spooled, MB | heap, MB | resident, MB | "
         "Process, ms a frame |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string HoldingLine(const std::string& title, const Holding& holding) {
  const auto megabytes = [](std::size_t bytes) { return static_cast<double>(bytes) / (1 << 20); };
  const double frames = holding.frames;
  return fmt::format(
      "| {} | {} | {:.1f}% | {} | {} | {} | {:.2f} | {:.0f} | {:.0f} | {:.2f} | {:.2f} | {:.1f} | "
      "{:.2f} |\n",
      title, holding.frames, 100 * holding.posed_frames / frames, holding.keyframes,
      holding.kept_keyframes, holding.landmarks, megabytes(holding.memory.working_set_bytes),
      static_cast<double>(holding.memory.frame_bytes) / frames,
      static_cast<double>(holding.memory.keyframe_bytes) / holding.keyframes,
      megabytes(holding.spooled_bytes), megabytes(holding.heap_bytes),
      megabytes(holding.resident_bytes), holding.processor_ms);
}

}  // namespace corvo::bench
