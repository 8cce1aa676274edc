// SPDX-License-Identifier: MIT
#include "apps/dataset/image_files.h"

#include <algorithm>
#include <map>
#include <string>

#include "apps/output/file_extension.h"
#include "apps/output/manifest.h"

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

}  // namespace

bool HasImageExtension(const fs::path& file) {
  std::string extension = LowerExtension(file);
  if (!extension.empty()) extension.erase(0, 1);
  return std::find(kImageExtensions.begin(), kImageExtensions.end(), extension) !=
         kImageExtensions.end();
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

void RemoveOutput(std::vector<fs::path>& files) {
  WrittenFiles written;
  std::erase_if(files, [&](const fs::path& file) { return written.Contain(file); });
}

void SortByName(std::vector<fs::path>& paths) {
  std::ranges::sort(paths, [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.filename().string(), b.filename().string());
  });
}

fs::path AbsoluteFolder(const fs::path& folder) {
  return fs::absolute(folder / "").lexically_normal().parent_path();
}

std::vector<fs::path> ImageFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    const bool hidden = file.filename().string().front() == '.';
    if (!hidden && HasImageExtension(file) && !IsDepthImage(file)) files.push_back(file);
  }
  RemoveOutput(files);
  SortByName(files);
  return files;
}

}  // namespace corvo
