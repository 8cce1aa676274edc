// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace corvo {

/// A line of a text file, without whitespace at its ends. Lines count from 1.
struct TextLine {
  int number = 0;
  std::string text;
};

/// Returns the lines of a text file except blank lines and `#` comments. Throws corvo::Error if the
/// file cannot be read.
std::vector<TextLine> ReadTextLines(const std::filesystem::path& file);

/// Returns the fields of a line. A blank as separator stands for any run of whitespace; with any
/// other separator, whitespace at the ends of fields is removed.
std::vector<std::string> SplitFields(std::string_view text, char separator);

/// Returns "<file>:<line>: ", as compilers write it.
std::string LinePrefix(const std::filesystem::path& file, const TextLine& line);

/// Returns the finite number that is the whole of `text`. Throws corvo::Error, whose message starts
/// with `where`, for any other text.
double ParseNumber(std::string_view text, std::string_view where);

}  // namespace corvo
