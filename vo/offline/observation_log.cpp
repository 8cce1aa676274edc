// SPDX-License-Identifier: MIT
#include "vo/offline/observation_log.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {
namespace {

/// The header that precedes the observations, positions and merges of a frame.
struct Header {
  std::int32_t frame, segment, keyframe, num_joins;
  std::uint32_t num_observations, num_positions, num_merges;
};

/// An observation in the file, in the single precision in which it is recorded.
struct StoredObservation {
  std::int32_t landmark;
  float x, y, sigma_px;
};

static_assert(sizeof(Header) == 28 && sizeof(StoredObservation) == 16);
static_assert(sizeof(Eigen::Vector3d) == 24 && sizeof(LandmarkMerge) == 8);

[[noreturn]] void Fail() {
  throw Error(fmt::format("temporary file of observations: {}", std::strerror(errno)));
}

StoredObservation Store(const Observation& observation) {
  return {observation.landmark, static_cast<float>(observation.pixel.x()),
          static_cast<float>(observation.pixel.y()), static_cast<float>(observation.sigma_px)};
}

Observation Load(const StoredObservation& stored) {
  return {stored.landmark, kNoId, {stored.x, stored.y}, stored.sigma_px};
}

std::uint32_t SizeOf(const auto& values) { return static_cast<std::uint32_t>(values.size()); }

}  // namespace

class ObservationLog::File {
 public:
  void Add(const FrameObservations& frame) {
    if (frame.first_landmark != first_landmark_) Clear();
    first_landmark_ = frame.first_landmark;
    Open();
    std::vector<StoredObservation> observations;
    for (const Observation& o : frame.observations) observations.push_back(Store(o));
    const std::vector<Header> header{{frame.frame, frame.segment, frame.keyframe, frame.num_joins,
                                      SizeOf(observations), SizeOf(frame.in_world),
                                      SizeOf(frame.merges)}};
    if (std::fseek(file_.get(), 0, SEEK_END) != 0) Fail();
    Write(header);
    Write(observations);
    Write(frame.in_world);
    Write(frame.merges);
    ++size_;
  }

  void Visit(const ObservationCallback& visit) const {
    if (!file_) return;
    std::rewind(file_.get());
    for (int i = 0; i < size_; ++i) {
      const Header header = Read<Header>(1).front();
      FrameObservations frame{header.frame, header.segment,   header.keyframe, {}, {},
                              {},           header.num_joins, first_landmark_};
      for (const StoredObservation& stored : Read<StoredObservation>(header.num_observations)) {
        frame.observations.push_back(Load(stored));
      }
      frame.in_world = Read<Eigen::Vector3d>(header.num_positions);
      frame.merges = Read<LandmarkMerge>(header.num_merges);
      visit(frame);
    }
  }

  int size() const { return size_; }
  std::size_t num_bytes() const { return num_bytes_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void Clear() {
    file_.reset();
    size_ = 0;
    num_bytes_ = 0;
  }

  void Open() {
    if (!file_) file_.reset(std::tmpfile());
    if (!file_) Fail();
  }

  template <typename T>
  void Write(const std::vector<T>& values) {
    if (values.empty()) return;  // Its data may be null, which fwrite does not accept.
    if (std::fwrite(values.data(), sizeof(T), values.size(), file_.get()) != values.size()) Fail();
    num_bytes_ += sizeof(T) * values.size();
  }

  template <typename T>
  std::vector<T> Read(std::size_t count) const {
    std::vector<T> values(count);
    if (count == 0) return values;
    if (std::fread(values.data(), sizeof(T), count, file_.get()) != count) Fail();
    return values;
  }

  std::unique_ptr<std::FILE, Close> file_;
  LandmarkId first_landmark_ = 0;
  int size_ = 0;
  std::size_t num_bytes_ = 0;
};

ObservationLog::ObservationLog() : file_(std::make_shared<File>()) {}
ObservationLog::~ObservationLog() = default;
ObservationLog::ObservationLog(ObservationLog&&) noexcept = default;
ObservationLog& ObservationLog::operator=(ObservationLog&&) noexcept = default;

ObservationCallback ObservationLog::Callback() {
  return [file = file_](const FrameObservations& frame) { file->Add(frame); };
}

int ObservationLog::size() const { return file_->size(); }
std::size_t ObservationLog::num_bytes() const { return file_->num_bytes(); }

void ObservationLog::Visit(const ObservationCallback& visit) const { file_->Visit(visit); }

}  // namespace corvo
