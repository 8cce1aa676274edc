// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "vo/map/observation_callback.h"

namespace corvo {

/// Keeps what the frames of a sequence observed in a temporary file, which goes with the object,
/// for adjustments of the whole sequence:
///
///     ObservationLog log;
///     odometry.SetObservationCallback(log.Callback());
///     ... // Process all images, and Finish.
///     const Refinement refinement = Refine(odometry, log);
class ObservationLog {
 public:
  ObservationLog();
  ~ObservationLog();
  ObservationLog(ObservationLog&&) noexcept;
  ObservationLog& operator=(ObservationLog&&) noexcept;

  /// Adds to the log; may outlive it. Throws corvo::Error where nothing can be written.
  ObservationCallback Callback();

  int size() const;               ///< Frames and keyframes reported.
  std::size_t num_bytes() const;  ///< Of the file.

  /// Calls `visit` with everything that was added, in the same order. Throws corvo::Error where the
  /// file cannot be read.
  void Visit(const ObservationCallback& visit) const;

 private:
  class File;
  std::shared_ptr<File> file_;
};

}  // namespace corvo
