// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/dataset/image_layouts.h"
#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

constexpr const char* kImageList = "rgb.txt";

}  // namespace

bool IsTumSequence(const std::filesystem::path& input) {
  return std::filesystem::exists(input / kImageList);
}

ImageList ListTumImages(const std::filesystem::path& input) {
  ImageList list{"tum", {}, {}};
  const std::filesystem::path file = input / kImageList;
  for (const TextLine& line : ReadTextLines(file)) {
    const std::string where = LinePrefix(file, line);
    const std::vector<std::string> fields = SplitFields(line.text, ' ');
    if (fields.size() != 2) {
      throw Error(fmt::format("{}'{}' is not 'timestamp filename'", where, line.text));
    }
    list.images.push_back({input / fields[1], ParseSeconds(fields[0], where)});
  }
  return list;
}

}  // namespace corvo
