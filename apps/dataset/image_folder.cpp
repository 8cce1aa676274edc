// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <regex>

#include <glob.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/dataset/image_layouts.h"
#include "apps/dataset/image_times.h"
#include "apps/dataset/layout_hints.h"
#include "apps/output/log_once.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Appends images with the times in their names, or else index / frame rate.
void AddTimes(const std::vector<fs::path>& files, const InputOptions& options, ImageList& list) {
  const auto times = options.frame_rate_hz ? std::nullopt : TimesInNames(files);
  if (!times) return AddIndexTimes(files, options, list);
  AddTimedImages(files, *times, list);
}

/// Warns if the names without their digits have several forms of equally many images, such as left_
/// and right_.
void WarnOfSeveralCameras(const fs::path& folder, const std::vector<fs::path>& files) {
  std::map<std::string, int> forms;
  for (const fs::path& file : files) {
    std::string form = file.stem().string();
    std::erase_if(form, [](unsigned char c) { return std::isdigit(c) != 0; });
    ++forms[form];
  }
  const bool are_even = std::ranges::all_of(
      forms, [&](const auto& form) { return form.second == forms.begin()->second; });
  if (forms.size() < 2 || forms.begin()->second < 2 || !are_even) return;
  std::string names;
  for (const auto& [form, count] : forms) names += fmt::format(" '{}'", form);
  LogOnce(spdlog::level::warn,
          fmt::format("{}: the names of the images have {} forms ({} images each):{}; if these are "
                      "several cameras, give a pattern for the names of one",
                      folder.string(), forms.size(), forms.begin()->second, names));
}

/// Returns a pattern for glob() in which the wildcards of existing folders are escaped.
std::string WithPlainFolders(const fs::path& pattern) {
  fs::path literal, escaped;
  for (const fs::path& part : pattern) {
    std::string text = part.string();
    if (fs::exists(literal /= part)) {
      text = std::regex_replace(text, std::regex(R"([*?\[\\])"), R"(\$&)");
    }
    escaped /= text;
  }
  return escaped.string();
}

/// Returns the subfolders that contain images, in natural order.
std::vector<fs::path> SubfoldersWithImages(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory() && !ImageFilesIn(entry.path()).empty()) found.push_back(entry.path());
  }
  SortByName(found);
  return found;
}

[[noreturn]] void ThrowNoImages(const fs::path& input, const std::vector<fs::path>& subfolders) {
  std::string hint = LayoutHints(input);
  if (!subfolders.empty()) {
    std::vector<std::string> names;
    for (const fs::path& folder : subfolders) names.push_back(folder.string());
    hint += fmt::format("; give one of its folders that do: {}", fmt::join(names, " "));
  }
  throw Error(
      fmt::format("{}: contains no images ({}) and is not a KITTI, KITTI raw, EuRoC, TUM, "
                  "TUM-mono or TartanAir sequence{}",
                  input.string(), fmt::join(kImageExtensions, ", "), hint));
}

}  // namespace

void AddIndexTimes(const std::vector<fs::path>& files, const InputOptions& options,
                   ImageList& list) {
  const double rate_hz = options.frame_rate_hz.value_or(options.default_frame_rate_hz);
  for (const fs::path& file : files) {
    const double time_s = static_cast<double>(list.images.size()) / rate_hz;
    list.images.push_back({file, std::llround(1e9 * time_s)});
  }
}

void AddTimedImages(const std::vector<fs::path>& files, const std::vector<TimeNs>& times,
                    ImageList& list) {
  for (std::size_t i = 0; i < files.size(); ++i) list.images.push_back({files[i], times[i]});
}

void CheckNumTimes(const fs::path& times_file, std::size_t num_times, const fs::path& image_folder,
                   std::size_t num_images) {
  if (num_times == num_images) return;
  throw Error(fmt::format("{}: {} timestamps for the {} images in {}", times_file.string(),
                          num_times, num_images, image_folder.string()));
}

bool IsPattern(const fs::path& input) {
  return input.string().find_first_of("*?[") != std::string::npos;
}

ImageList ListMatchingImages(const fs::path& pattern, const InputOptions& options) {
  std::vector<fs::path> files;
  glob_t found{};
  if (glob(WithPlainFolders(pattern).c_str(), 0, nullptr, &found) == 0) {
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
  AddTimes(files, options, list);
  return list;
}

ImageList ListFolderImages(const fs::path& input, const InputOptions& options) {
  ImageList list{"folder", {}, {}};
  std::vector<fs::path> files = ImageFilesIn(input);
  if (files.empty()) {
    const std::vector<fs::path> subfolders = SubfoldersWithImages(input);
    if (subfolders.size() != 1) ThrowNoImages(input, subfolders);
    files = ImageFilesIn(subfolders.front());
    LogOnce(spdlog::level::info,
            fmt::format("{}: has its images in {}", input.string(), subfolders.front().string()));
  }
  WarnOfSeveralCameras(files.front().parent_path(), files);
  AddTimes(files, options, list);
  return list;
}

}  // namespace corvo
