// SPDX-License-Identifier: MIT
#include "apps/run/realtime_images.h"

#include <utility>

namespace corvo {

RealtimeImages::RealtimeImages(ImageSource& source, const Interruption& interruption)
    : source_(source),
      interruption_(interruption),
      thread_([this](const std::stop_token& stop) { DeliverAll(stop); }) {}

RealtimeImages::~RealtimeImages() {
  thread_.request_stop();
  source_.Cancel();
}

std::optional<TimedImage> RealtimeImages::Next() {
  constexpr std::chrono::milliseconds kSignalInterval(50);
  std::unique_lock lock(mutex_);
  while (!waiting_ && !has_ended_) {
    if (interruption_.IsRequested()) return std::nullopt;
    changed_.wait_for(lock, kSignalInterval);
  }
  if (waiting_) {
    Delivery taken = *std::exchange(waiting_, std::nullopt);
    taken_due_ = taken.due;
    return std::move(taken.image);
  }
  if (error_) std::rethrow_exception(error_);
  return std::nullopt;
}

double RealtimeImages::LatencyMs() const {
  return std::chrono::duration<double, std::milli>(Clock::now() - taken_due_).count();
}

int RealtimeImages::num_dropped() const {
  const std::scoped_lock lock(mutex_);
  return num_dropped_;
}

void RealtimeImages::DeliverAll(const std::stop_token& stop) {
  std::exception_ptr error;
  try {
    while (std::optional<TimedImage> image = source_.Next()) {
      const Clock::time_point due = DueTimeOf(*image);
      if (!WaitUntil(due, stop)) break;
      Deliver({std::move(*image), due});
    }
  } catch (...) {
    error = std::current_exception();
  }
  const std::scoped_lock lock(mutex_);
  error_ = error;
  has_ended_ = true;
  changed_.notify_all();
}

void RealtimeImages::Deliver(Delivery delivery) {
  const std::scoped_lock lock(mutex_);
  if (waiting_) ++num_dropped_;
  waiting_ = std::move(delivery);
  changed_.notify_all();
}

RealtimeImages::Clock::time_point RealtimeImages::DueTimeOf(const TimedImage& image) {
  const Clock::time_point now = Clock::now();
  if (source_.is_live()) return now;
  const std::chrono::nanoseconds time(image.time_ns);
  if (!zero_) zero_ = now - time;
  return *zero_ + time;
}

bool RealtimeImages::WaitUntil(Clock::time_point time, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, stop, time, [] { return false; });
  return !stop.stop_requested();
}

}  // namespace corvo
