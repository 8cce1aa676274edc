// SPDX-License-Identifier: MIT
#include "apps/output/npy_file.h"

#include <cstdint>

#include <fmt/format.h>

#include "apps/output/binary_data.h"
#include "orb/error.h"

namespace corvo {

std::string NpyHeader(std::string_view fields, std::size_t num_rows) {
  std::string text =
      fmt::format("{{'descr': [{}], 'fortran_order': False, 'shape': ({},), }}", fields, num_rows);
  std::string header("\x93NUMPY\x01\x00", 8);
  const auto text_size = static_cast<std::uint16_t>(kNpyHeaderSize - header.size() - 2);
  AppendBytes(text_size, header);
  text.resize(text_size - 1, ' ');
  return header + text + '\n';
}

NpyWriter::NpyWriter(const std::filesystem::path& file, std::string_view fields)
    : path_(file), fields_(fields), out_(file, std::ios::binary) {
  out_ << NpyHeader(fields_, 0);  // The number of rows is written once it is known.
  Check();
}

void NpyWriter::Add(std::string_view row) {
  out_ << row;
  ++num_rows_;
}

void NpyWriter::Finish() {
  out_.seekp(0);
  out_ << NpyHeader(fields_, num_rows_);
  out_.close();
  Check();
}

void NpyWriter::Check() const {
  if (!out_) throw Error(fmt::format("{}: cannot be written", path_.string()));
}

}  // namespace corvo
