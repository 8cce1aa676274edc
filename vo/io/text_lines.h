// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace corvo {

/// The largest number of lines of a text file that is read, without blank lines and comments.
inline constexpr std::size_t kMaxTextLines = 2'000'000;

/// A line of a text file, without whitespace at its ends. Lines count from 1.
struct TextLine {
  int number = 0;
  std::string text;
};

/// Returns a text without the byte-order mark of UTF-8 at its start. Throws corvo::Error, whose
/// message starts with `name`, if the text is UTF-16 according to its byte-order mark.
std::string_view WithoutByteOrderMark(std::string_view text, const std::string& name);

/// Returns the lines of a text file except blank lines and `#` comments. Lines end with LF, CR LF
/// or CR; a byte-order mark is skipped. Throws corvo::Error if the file cannot be read, is larger
/// than kMaxTextBytes, has more than kMaxTextLines, holds a NUL byte or is UTF-16.
std::vector<TextLine> ReadTextLines(const std::filesystem::path& file);

/// Like ReadTextLines(), for the content of a file. `file` is for messages.
std::vector<TextLine> ParseTextLines(std::string_view bytes, const std::filesystem::path& file);

/// Like ReadTextLines(), but without a header: the first line is left out if none of its fields is
/// a number, NaN included.
std::vector<TextLine> ReadTableLines(const std::filesystem::path& file);

/// Returns the fields of a line. Fields are separated by blanks, tabs, or a comma or semicolon with
/// or without blanks around it. An empty field between two commas remains.
std::vector<std::string> SplitFields(std::string_view text);

/// Returns whether a text is a number, NaN and infinity included.
bool IsNumber(std::string_view text);

/// Returns the text after the first field of a line and its separator.
std::string_view AfterFirstField(std::string_view text);

/// Returns "<file>:<line>: ", as compilers write it.
std::string LinePrefix(const std::filesystem::path& file, const TextLine& line);

/// Returns the finite number that is the whole of `text`. Throws corvo::Error, whose message starts
/// with `where`, for any other text.
double ParseNumber(std::string_view text, std::string_view where);

}  // namespace corvo
