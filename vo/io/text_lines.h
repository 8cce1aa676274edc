// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace corvo {

/// One line of a text file, without blanks at its ends. Lines count from 1.
struct TextLine {
  int number = 0;
  std::string text;
};

/// The lines of a text file that hold something: no blank lines, no `#` comments. Throws
/// corvo::Error where the file cannot be read.
std::vector<TextLine> ReadTextLines(const std::filesystem::path& file);

/// The fields of a line. A blank as separator stands for any run of blanks and tabs; with any other
/// separator, fields lose the blanks at their ends.
std::vector<std::string> SplitFields(std::string_view text, char separator);

/// "<file>:<line>: ", as compilers write it.
std::string LinePrefix(const std::filesystem::path& file, const TextLine& line);

/// A finite number that is the whole of `text`; `where` starts the message of the corvo::Error.
double ParseNumber(std::string_view text, std::string_view where);

}  // namespace corvo
