// SPDX-License-Identifier: MIT
#include "apps/output/observation_table.h"

#include <cstring>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <Eigen/Core>

#include "apps/output/binary_data.h"
#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

constexpr std::size_t kRowSize = 18;
/// NumPy aligns the data at 64 bytes; the number of rows is written once it is known.
constexpr std::size_t kHeaderSize = 192;

std::string Header(std::size_t num_rows) {
  std::string text = fmt::format(
      "{{'descr': [('frame', '<u4'), ('landmark', '<u4'), ('x', '<f4'), ('y', '<f4'), "
      "('sigma', '<f2')], 'fortran_order': False, 'shape': ({},), }}",
      num_rows);
  std::string header("\x93NUMPY\x01\x00", 8);
  const auto text_size = static_cast<std::uint16_t>(kHeaderSize - header.size() - 2);
  header.append(reinterpret_cast<const char*>(&text_size), sizeof text_size);
  text.resize(text_size - 1, ' ');
  return header + text + '\n';
}

}  // namespace

struct ObservationWriter::File {
  std::filesystem::path path;
  std::ofstream out;
  std::size_t num_rows = 0;
};

ObservationWriter::ObservationWriter(const std::filesystem::path& file)
    : file_(std::make_unique<File>(File{file, std::ofstream(file, std::ios::binary), 0})) {
  file_->out << Header(0);
  if (!file_->out) throw Error(fmt::format("{}: cannot be written", file.string()));
}

ObservationWriter::~ObservationWriter() = default;

void ObservationWriter::Add(const ObservationRow& row) {
  std::string bytes;
  AppendBytes(static_cast<std::uint32_t>(row.frame), bytes);
  AppendBytes(static_cast<std::uint32_t>(row.landmark), bytes);
  AppendBytes(row.x, bytes);
  AppendBytes(row.y, bytes);
  AppendBytes(Eigen::half(row.sigma_px).x, bytes);
  file_->out << bytes;
  ++file_->num_rows;
}

void ObservationWriter::Finish() {
  file_->out.seekp(0);
  file_->out << Header(file_->num_rows);
  file_->out.close();
  if (!file_->out) throw Error(fmt::format("{}: cannot be written", file_->path.string()));
}

std::vector<ObservationRow> ReadObservations(const std::filesystem::path& file) {
  const std::string bytes = ReadFileBytes(file, kMaxResultBytes);
  const std::size_t num_rows =
      bytes.size() < kHeaderSize ? 0 : (bytes.size() - kHeaderSize) / kRowSize;
  if (bytes.compare(0, kHeaderSize, Header(num_rows)) != 0 ||
      bytes.size() != kHeaderSize + kRowSize * num_rows) {
    throw Error(fmt::format("{}: is not the observations of a run, or damaged", file.string()));
  }
  const char* next = bytes.data() + kHeaderSize;
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
