// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/dataset/image_layouts.h"
#include "apps/dataset/list_entry.h"
#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns the list of images, or an empty path if there is none.
fs::path FindList(const fs::path& input) {
  for (const char* name : {"rgb.txt", "associations.txt"}) {
    if (fs::exists(input / name)) return input / name;
  }
  return {};
}

/// The time and name of an image in its line.
struct Entry {
  std::string time;
  std::string name;
};

/// Parses "time name", in which the name may have blanks, or "time name time name", as in a list of
/// associated images, of which the one that is not in a depth folder counts.
Entry ParseEntry(const std::vector<std::string>& fields, const std::string& text) {
  const bool is_association = fields.size() == 4 && IsNumber(fields[2]);
  if (!is_association) return {fields[0], std::string(AfterFirstField(text))};
  const bool depth_first = fields[1].find("depth") != std::string::npos;
  return depth_first ? Entry{fields[2], fields[3]} : Entry{fields[0], fields[1]};
}

}  // namespace

bool IsTumSequence(const fs::path& input) { return !FindList(input).empty(); }

ImageList ListTumImages(const fs::path& input) {
  ImageList list{"tum", {}, {}};
  const fs::path file = FindList(input);
  const std::vector<TextLine> lines = ReadTableLines(file);
  const TimeUnit unit =
      lines.empty() ? TimeUnit::kSeconds : GuessTimeUnit(SplitFields(lines[0].text)[0]);
  for (const TextLine& line : lines) {
    const std::string where = LinePrefix(file, line);
    const std::vector<std::string> fields = SplitFields(line.text);
    if (fields.size() < 2) {
      throw Error(fmt::format("{}'{}' is not 'timestamp filename'", where, line.text));
    }
    const Entry entry = ParseEntry(fields, line.text);
    list.images.push_back(
        {EntryPath(input, entry.name, where), ParseTime(entry.time, unit, where)});
  }
  return list;
}

}  // namespace corvo
