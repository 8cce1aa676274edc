// SPDX-License-Identifier: MIT
#include "apps/output/map_ply.h"

#include <cstring>

#include <fmt/format.h>

#include "apps/output/binary_data.h"
#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

constexpr std::size_t kRecordSize = 3 * sizeof(double) + 3 + 3 * sizeof(std::int32_t);

std::string Header(std::size_t num_vertices) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment corvo map, version 1\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property int id\nproperty int segment\nproperty int observations\nend_header\n",
      num_vertices);
}

MapPoint TakePoint(const char*& bytes) {
  MapPoint point;
  for (int i = 0; i < 3; ++i) point.in_world[i] = TakeBytes<double>(bytes);
  for (std::uint8_t& channel : point.rgb) channel = TakeBytes<std::uint8_t>(bytes);
  point.id = TakeBytes<std::int32_t>(bytes);
  point.segment = TakeBytes<std::int32_t>(bytes);
  point.num_observations = TakeBytes<std::int32_t>(bytes);
  return point;
}

}  // namespace

std::string ToPly(const std::vector<MapPoint>& points) {
  std::string bytes = Header(points.size());
  bytes.reserve(bytes.size() + kRecordSize * points.size());
  for (const MapPoint& point : points) {
    for (int i = 0; i < 3; ++i) AppendBytes(point.in_world[i], bytes);
    for (const std::uint8_t channel : point.rgb) AppendBytes(channel, bytes);
    AppendBytes(std::int32_t{point.id}, bytes);
    AppendBytes(std::int32_t{point.segment}, bytes);
    AppendBytes(std::int32_t{point.num_observations}, bytes);
  }
  return bytes;
}

std::vector<MapPoint> ReadMapPly(const std::filesystem::path& file) {
  const std::string bytes = ReadFileBytes(file, kMaxResultBytes);
  const std::size_t header_size = bytes.find("end_header\n") + std::strlen("end_header\n");
  const std::size_t num_points =
      bytes.size() < header_size ? 0 : (bytes.size() - header_size) / kRecordSize;
  // The header is fixed but for the number of points, which the size of the file has to confirm.
  const std::string header = Header(num_points);
  if (bytes.compare(0, header.size(), header) != 0 ||
      bytes.size() != header.size() + kRecordSize * num_points) {
    throw Error(fmt::format("{}: is not the map of a run, or damaged", file.string()));
  }
  const char* next = bytes.data() + header.size();
  std::vector<MapPoint> points;
  points.reserve(num_points);
  for (std::size_t i = 0; i < num_points; ++i) points.push_back(TakePoint(next));
  return points;
}

}  // namespace corvo
