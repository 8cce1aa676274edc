// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "apps/dataset/image_source.h"
#include "apps/system/interruption.h"

namespace corvo {

/// Delivers the images of a source as a camera does: each at its time, whether or not the previous
/// one has been taken. Only the newest image waits; one that is still waiting when the next arrives
/// is dropped. The time of a recorded image counts from the first one; the images of a connected
/// camera arrive by themselves. Images are read and decoded by a thread of their own.
class RealtimeImages {
 public:
  /// The source must not be used by others during the lifetime of this object.
  RealtimeImages(ImageSource& source, const Interruption& interruption);
  /// Ends the delivery.
  ~RealtimeImages();
  RealtimeImages(const RealtimeImages&) = delete;
  RealtimeImages& operator=(const RealtimeImages&) = delete;

  /// Waits for an image and returns it, or std::nullopt after the last one or a signal. Throws what
  /// the source has thrown.
  std::optional<TimedImage> Next();

  /// Returns the time since the image that Next() returned last was due, ms.
  double LatencyMs() const;
  int num_dropped() const;

 private:
  using Clock = std::chrono::steady_clock;

  struct Delivery {
    TimedImage image;
    Clock::time_point due;
  };

  void DeliverAll(const std::stop_token& stop);
  void Deliver(Delivery delivery);
  /// Returns when an image is due.
  Clock::time_point DueTimeOf(const TimedImage& image);
  /// Waits until a time. Returns false if the delivery is to end.
  bool WaitUntil(Clock::time_point time, const std::stop_token& stop);

  ImageSource& source_;
  const Interruption& interruption_;
  std::optional<Clock::time_point> zero_;  ///< When an image with the time 0 would be due.
  Clock::time_point taken_due_;            ///< When the image that was taken last was due.
  mutable std::mutex mutex_;               ///< Protects the members below.
  std::condition_variable_any changed_;
  std::optional<Delivery> waiting_;
  int num_dropped_ = 0;
  bool has_ended_ = false;
  std::exception_ptr error_;
  std::jthread thread_;  ///< The last member, since it uses the others.
};

}  // namespace corvo
