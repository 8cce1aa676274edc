// SPDX-License-Identifier: MIT
#include "tests/system/recording.h"

namespace corvo::test {

Recording Render(const synthetic::Sequence& sequence, int every) {
  Recording recording;
  recording.camera = sequence.camera().parameters();
  for (int i = 0; i < sequence.size(); i += every) {
    recording.images.push_back({sequence.Render(i), sequence.poses()[i].time_ns});
    recording.truth.push_back(sequence.poses()[i]);
  }
  return recording;
}

std::optional<StreamImage> RecordedStream::Next() {
  if (next_ == recording_.size()) return std::nullopt;
  const TimedImage& image = recording_.images[next_++];
  return StreamImage{image.image, image.time_ns, {}, ""};
}

}  // namespace corvo::test
