// SPDX-License-Identifier: MIT
#include "apps/output/landmark_spool.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {
namespace {

struct Record {
  std::int32_t id;
  std::int32_t segment;
  std::int32_t num_joins;
  std::int32_t unused;
  double x, y, z;
};
static_assert(sizeof(Record) == 40);

[[noreturn]] void ThrowLandmarkFileError() {
  throw Error(fmt::format("temporary file of landmarks: {}", std::strerror(errno)));
}

}  // namespace

void LandmarkSpool::Add(const MarginalizedLandmark& landmark) {
  if (!file_) file_.reset(std::tmpfile());
  if (!file_) ThrowLandmarkFileError();
  const Eigen::Vector3d& point = landmark.in_world;
  const Record record{landmark.id, landmark.segment, landmark.num_joins, 0,
                      point.x(),   point.y(),        point.z()};
  if (std::fseek(file_.get(), 0, SEEK_END) != 0) ThrowLandmarkFileError();
  if (std::fwrite(&record, sizeof record, 1, file_.get()) != 1) ThrowLandmarkFileError();
  ++size_;
}

std::size_t LandmarkSpool::num_bytes() const {
  return sizeof(Record) * static_cast<std::size_t>(size_);
}

void LandmarkSpool::ForEach(const std::function<void(const MarginalizedLandmark&)>& visit) const {
  if (!file_) return;
  std::rewind(file_.get());
  for (int i = 0; i < size_; ++i) {
    Record record;
    if (std::fread(&record, sizeof record, 1, file_.get()) != 1) ThrowLandmarkFileError();
    visit({record.id, record.segment, {record.x, record.y, record.z}, record.num_joins});
  }
}

}  // namespace corvo
