// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace corvo {

/// The size of the header of a file of NpyWriter, bytes.
inline constexpr std::size_t kNpyHeaderSize = 256;

/// Returns the header of a one-dimensional structured array in NumPy's format (version 1.0).
/// `fields` is the list of its fields as NumPy writes it.
std::string NpyHeader(std::string_view fields, std::size_t num_rows);

/// Writes rows as a structured array that `numpy.load` reads.
class NpyWriter {
 public:
  /// Throws corvo::Error if the file cannot be created.
  NpyWriter(const std::filesystem::path& file, std::string_view fields);

  /// Appends the bytes of one row.
  void Add(std::string_view row);
  /// Completes the file. Throws corvo::Error if it could not be written as a whole.
  void Finish();

 private:
  void Check() const;

  std::filesystem::path path_;
  std::string fields_;
  std::ofstream out_;
  std::size_t num_rows_ = 0;
};

}  // namespace corvo
