// SPDX-License-Identifier: MIT
#include "apps/run/sequence_stream.h"

#include <memory>
#include <optional>
#include <utility>

namespace corvo {
namespace {

class SequenceStream : public ImageStream {
 public:
  explicit SequenceStream(ImageSource source) : source_(std::move(source)) {}

  std::optional<StreamImage> Next() override {
    std::optional<TimedImage> next = source_.Next();
    if (!next) return std::nullopt;
    return StreamImage{next->image, next->time_ns, next->mask, next->name, next->missing};
  }
  bool Skip() override { return source_.Skip(); }
  /// Returns std::nullopt for a video, whose length is unknown until its end.
  std::optional<int> size() const override {
    return source_.list().images.empty() ? std::nullopt : source_.size();
  }

 private:
  ImageSource source_;
};

}  // namespace

StreamOpener ToStreamOpener(std::function<ImageSource()> open) {
  return [open = std::move(open)] { return std::make_unique<SequenceStream>(open()); };
}

}  // namespace corvo
