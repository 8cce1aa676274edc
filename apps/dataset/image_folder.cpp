// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <glob.h>

#include <fmt/format.h>

#include "apps/dataset/image_layouts.h"
#include "apps/output/manifest.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// Removes the leading run of digits from `text`, or else its first character, and returns it
/// without leading zeros.
std::string_view TakeToken(std::string_view& text) {
  std::size_t size = 1;
  if (IsDigit(text.front())) {
    while (size < text.size() && IsDigit(text[size])) ++size;
  }
  std::string_view token = text.substr(0, size);
  text.remove_prefix(size);
  while (token.size() > 1 && token.front() == '0') token.remove_prefix(1);
  return token;
}

/// Returns whether the file is a depth image of 7-Scenes, which has one beside each color image.
bool IsDepthImage(const fs::path& file) { return file.stem().extension() == ".depth"; }

/// The files that corvo wrote: a manifest beside them lists them with their size.
class WrittenFiles {
 public:
  bool Contain(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const auto [listed, is_new] = listed_.try_emplace(folder);
    if (is_new) listed->second = ListResults(folder);
    return std::ranges::any_of(listed->second, [&](const ManifestFile& result) {
      std::error_code error;
      return result.name == file.filename().string() &&
             result.num_bytes == fs::file_size(file, error) && !error;
    });
  }

 private:
  std::map<fs::path, std::vector<ManifestFile>> listed_;
};

/// Removes files that corvo wrote: output never becomes input.
void RemoveOutput(std::vector<fs::path>& files) {
  WrittenFiles written;
  std::erase_if(files, [&](const fs::path& file) { return written.Contain(file); });
}

void AddTimes(const std::vector<fs::path>& files, double frame_rate_hz, ImageList& list) {
  for (const fs::path& file : files) {
    const double time_s = static_cast<double>(list.images.size()) / frame_rate_hz;
    list.images.push_back({file, std::llround(1e9 * time_s)});
  }
}

}  // namespace

bool HasImageExtension(const fs::path& file) {
  constexpr std::array<std::string_view, 7> kExtensions = {".png", ".jpg", ".jpeg", ".bmp",
                                                           ".pgm", ".tif", ".tiff"};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

bool NaturalLess(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  while (!a.empty() && !b.empty()) {
    const std::string_view token_a = TakeToken(a);
    const std::string_view token_b = TakeToken(b);
    const bool numbers = IsDigit(token_a.front()) && IsDigit(token_b.front());
    if (numbers && token_a.size() != token_b.size()) return token_a.size() < token_b.size();
    if (token_a != token_b) return token_a < token_b;
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;
}

std::vector<fs::path> ImageFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    const bool hidden = file.filename().string().front() == '.';
    if (!hidden && HasImageExtension(file) && !IsDepthImage(file)) files.push_back(file);
  }
  RemoveOutput(files);
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.filename().string(), b.filename().string());
  });
  return files;
}

bool IsPattern(const fs::path& input) {
  return input.string().find_first_of("*?[") != std::string::npos;
}

ImageList ListMatchingImages(const fs::path& pattern, double frame_rate_hz) {
  std::vector<fs::path> files;
  glob_t found{};
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0) {
    for (std::size_t i = 0; i < found.gl_pathc; ++i) {
      if (HasImageExtension(found.gl_pathv[i])) files.emplace_back(found.gl_pathv[i]);
    }
  }
  globfree(&found);
  RemoveOutput(files);
  if (files.empty()) throw Error(fmt::format("{}: matches no image", pattern.string()));
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.string(), b.string());
  });
  ImageList list{"glob", {}, {}};
  AddTimes(files, frame_rate_hz, list);
  return list;
}

ImageList ListFolderImages(const fs::path& input, double frame_rate_hz) {
  ImageList list{"folder", {}, {}};
  AddTimes(ImageFilesIn(input), frame_rate_hz, list);
  if (list.images.empty()) {
    throw Error(
        fmt::format("{}: contains no images (png, jpg, jpeg, bmp, pgm, tif) and is not a "
                    "KITTI, EuRoC, TUM or TUM-mono sequence",
                    input.string()));
  }
  return list;
}

}  // namespace corvo
