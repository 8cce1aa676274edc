// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "apps/synthetic/sequence.h"
#include "tests/system/sequence_runner.h"
#include "vo/camera/camera_parameters.h"
#include "vo/core/trajectory.h"
#include "vo/offline/image_stream.h"

namespace corvo::test {

/// A short recording in memory with a ground-truth pose for each image.
struct Recording {
  std::vector<TimedImage> images;
  PoseSequence truth;
  CameraParameters camera;

  int size() const { return static_cast<int>(images.size()); }
};

/// Renders every n-th frame of a sequence.
Recording Render(const synthetic::Sequence& sequence, int every = 1);

/// The images of a recording, which must outlive the stream.
class RecordedStream : public ImageStream {
 public:
  explicit RecordedStream(const Recording& recording) : recording_(recording) {}

  std::optional<StreamImage> Next() override;
  bool Skip() override { return next_++ < recording_.size(); }
  std::optional<int> size() const override { return recording_.size(); }

 private:
  const Recording& recording_;
  int next_ = 0;
};

}  // namespace corvo::test
