// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <memory>

namespace corvo {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// A file of std::tmpfile(), which has no name and is deleted when it is closed.
using TemporaryFile = std::unique_ptr<std::FILE, CloseFile>;

}  // namespace corvo
