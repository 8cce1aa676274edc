// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/dataset/image_layouts.h"
#include "apps/dataset/list_entry.h"
#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

constexpr const char* kImageList = "rgb.txt";

/// Returns the image's name in "time name", also if it has blanks, or in "time name time name", as
/// in a list of associated images.
std::string ImageName(const std::vector<std::string>& fields, const std::string& text) {
  const bool is_association = fields.size() == 4 && IsNumber(fields[2]);
  return is_association ? fields[1] : std::string(AfterFirstField(text));
}

}  // namespace

bool IsTumSequence(const std::filesystem::path& input) {
  return std::filesystem::exists(input / kImageList);
}

ImageList ListTumImages(const std::filesystem::path& input) {
  ImageList list{"tum", {}, {}};
  const std::filesystem::path file = input / kImageList;
  const std::vector<TextLine> lines = ReadTableLines(file);
  const TimeUnit unit =
      lines.empty() ? TimeUnit::kSeconds : GuessTimeUnit(SplitFields(lines[0].text)[0]);
  for (const TextLine& line : lines) {
    const std::string where = LinePrefix(file, line);
    const std::vector<std::string> fields = SplitFields(line.text);
    if (fields.size() < 2) {
      throw Error(fmt::format("{}'{}' is not 'timestamp filename'", where, line.text));
    }
    list.images.push_back(
        {EntryPath(input, ImageName(fields, line.text), where), ParseTime(fields[0], unit, where)});
  }
  return list;
}

}  // namespace corvo
