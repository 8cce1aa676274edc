// SPDX-License-Identifier: MIT
#include "apps/output/observation_table.h"

#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <Eigen/Core>

#include "apps/output/binary_data.h"
#include "apps/output/npy_file.h"
#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

constexpr std::size_t kRowSize = 18;
constexpr const char* kObservationFields =
    "('frame', '<u4'), ('landmark', '<u4'), ('x', '<f4'), ('y', '<f4'), ('sigma', '<f2')";

}  // namespace

ObservationWriter::ObservationWriter(const std::filesystem::path& file)
    : file_(file, kObservationFields) {}

void ObservationWriter::Add(const ObservationRow& row) {
  std::string bytes;
  AppendBytes(static_cast<std::uint32_t>(row.frame), bytes);
  AppendBytes(static_cast<std::uint32_t>(row.landmark), bytes);
  AppendBytes(row.x, bytes);
  AppendBytes(row.y, bytes);
  AppendBytes(Eigen::half(row.sigma_px).x, bytes);
  file_.Add(bytes);
}

void ObservationWriter::Finish() { file_.Finish(); }

std::vector<ObservationRow> ReadObservations(const std::filesystem::path& file) {
  const std::string bytes = ReadFileBytes(file, kMaxResultBytes);
  const std::size_t num_rows =
      bytes.size() < kNpyHeaderSize ? 0 : (bytes.size() - kNpyHeaderSize) / kRowSize;
  if (bytes.compare(0, kNpyHeaderSize, NpyHeader(kObservationFields, num_rows)) != 0 ||
      bytes.size() != kNpyHeaderSize + kRowSize * num_rows) {
    throw Error(fmt::format("{}: is not the observations of a run, or damaged", file.string()));
  }
  const char* next = bytes.data() + kNpyHeaderSize;
  std::vector<ObservationRow> rows(num_rows);
  for (ObservationRow& row : rows) {
    row.frame = static_cast<int>(TakeBytes<std::uint32_t>(next));
    row.landmark = static_cast<int>(TakeBytes<std::uint32_t>(next));
    row.x = TakeBytes<float>(next);
    row.y = TakeBytes<float>(next);
    const auto half_bits = TakeBytes<std::uint16_t>(next);
    row.sigma_px = static_cast<float>(
        Eigen::half_impl::half_to_float(Eigen::half_impl::raw_uint16_to_half(half_bits)));
  }
  return rows;
}

}  // namespace corvo
