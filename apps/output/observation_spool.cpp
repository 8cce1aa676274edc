#include "apps/output/observation_spool.h"

#include <cerrno>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {
namespace {

/// Before the landmarks, their positions and the merges of a frame.
struct Header {
  std::int32_t frame, segment, keyframe;
  std::uint32_t num_landmarks, num_positions, num_merges;
};
static_assert(sizeof(Header) == 24);
static_assert(sizeof(Observation) == 16 && sizeof(LandmarkMerge) == 8);

[[noreturn]] void Fail() {
  throw Error(fmt::format("temporary file of what frames saw: {}", std::strerror(errno)));
}

template <typename T>
std::size_t Write(const T* values, std::size_t count, std::FILE* file) {
  if (std::fwrite(values, sizeof(T), count, file) != count) Fail();
  return sizeof(T) * count;
}

template <typename T>
void Read(T* values, std::size_t count, std::FILE* file) {
  if (std::fread(values, sizeof(T), count, file) != count) Fail();
}

std::uint32_t SizeOf(const auto& values) { return static_cast<std::uint32_t>(values.size()); }

}  // namespace

void ObservationSpool::Add(const FrameObservations& frame) {
  if (!file_) file_.reset(std::tmpfile());
  if (!file_) Fail();
  if (std::fseek(file_.get(), 0, SEEK_END) != 0) Fail();
  const Header header{frame.frame,
                      frame.segment,
                      frame.keyframe,
                      SizeOf(frame.landmarks),
                      SizeOf(frame.in_world),
                      SizeOf(frame.merges)};
  num_bytes_ += Write(&header, 1, file_.get());
  num_bytes_ += Write(frame.landmarks.data(), frame.landmarks.size(), file_.get());
  num_bytes_ += Write(frame.in_world.data(), frame.in_world.size(), file_.get());
  num_bytes_ += Write(frame.merges.data(), frame.merges.size(), file_.get());
  ++size_;
}

void ObservationSpool::ForEach(const ObservationCallback& visit) const {
  if (!file_) return;
  std::rewind(file_.get());
  for (int i = 0; i < size_; ++i) {
    Header header;
    Read(&header, 1, file_.get());
    FrameObservations frame{header.frame, header.segment, header.keyframe, {}, {}, {}};
    frame.landmarks.resize(header.num_landmarks);
    frame.in_world.resize(header.num_positions);
    frame.merges.resize(header.num_merges);
    Read(frame.landmarks.data(), frame.landmarks.size(), file_.get());
    Read(frame.in_world.data(), frame.in_world.size(), file_.get());
    Read(frame.merges.data(), frame.merges.size(), file_.get());
    visit(frame);
  }
}

}  // namespace corvo
