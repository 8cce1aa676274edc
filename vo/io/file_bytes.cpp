// SPDX-License-Identifier: MIT
#include "vo/io/file_bytes.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {

std::string ReadFileBytes(const std::filesystem::path& file, std::size_t max_bytes) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw Error(fmt::format("{}: is a folder and cannot be read as a file", file.string()));
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(fmt::format("{}: cannot be read", file.string()));
  std::string bytes;
  for (std::size_t block = 1 << 16; stream && bytes.size() <= max_bytes; block *= 2) {
    const std::size_t size = bytes.size();
    const std::size_t wanted = std::min(block, max_bytes + 1 - size);
    bytes.resize(size + wanted);
    stream.read(bytes.data() + size, static_cast<std::streamsize>(wanted));
    bytes.resize(size + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw Error(fmt::format("{}: cannot be read", file.string()));
  if (bytes.size() <= max_bytes) return bytes;
  throw Error(fmt::format("{}: has more than {} bytes; allowed is 0 to {}", file.string(),
                          max_bytes, max_bytes));
}

}  // namespace corvo
