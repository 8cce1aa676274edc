// SPDX-License-Identifier: MIT
#include "apps/dataset/image_list.h"

#include <fmt/format.h>

#include "apps/dataset/image_layouts.h"
#include "apps/dataset/image_times.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

ImageList ListByLayout(const fs::path& input, const InputOptions& options) {
  if (IsKittiSequence(input)) return ListKittiImages(input, options);
  if (IsKittiRawSequence(input)) return ListKittiRawImages(input, options);
  if (IsEurocSequence(input)) return ListEurocImages(input, options);
  if (IsTumSequence(input)) return ListTumImages(input);
  if (IsTumMonoSequence(input)) return ListTumMonoImages(input, options);
  if (IsTartanAirSequence(input)) return ListTartanAirImages(input, options);
  return ListFolderImages(input, options);
}

void ReplaceTimes(const fs::path& file, ImageList& list) {
  std::vector<fs::path> images;
  for (const TimedFile& image : list.images) images.push_back(image.file);
  const std::vector<TimeNs> times = ReadImageTimes(file, images);
  for (std::size_t i = 0; i < times.size(); ++i) list.images[i].time_ns = times[i];
}

void CheckTimesAscend(const std::vector<TimedFile>& images) {
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (images[i].time_ns > images[i - 1].time_ns) continue;
    throw Error(fmt::format("{}: its timestamp {} ns is not later than {} ns, that of {}",
                            images[i].file.string(), images[i].time_ns, images[i - 1].time_ns,
                            images[i - 1].file.filename().string()));
  }
}

/// Throws corvo::Error if the input is neither a folder nor a pattern.
void CheckInput(const fs::path& input, bool exists) {
  const std::string name = input.string();
  if (name.find("://") != std::string::npos) {
    throw Error(
        fmt::format("{}: is a stream's address; record the stream and give the file, or "
                    "give a connected camera as camera:0",
                    name));
  }
  if (!exists && !IsPattern(input)) throw Error(fmt::format("{}: no such folder", name));
  if (!exists || fs::is_directory(input)) return;
  if (name.starts_with("/dev/video")) {
    throw Error(fmt::format("{}: is a device; give a connected camera as camera:{}", name,
                            name.substr(std::string_view("/dev/video").size())));
  }
  throw Error(fmt::format("{}: not a folder; give the folder of an image sequence", name));
}

}  // namespace

ImageList ListImages(const fs::path& input, const InputOptions& options) {
  const bool exists = fs::exists(input);
  CheckInput(input, exists);
  ImageList list = exists ? ListByLayout(input, options) : ListMatchingImages(input, options);
  if (list.images.empty()) throw Error(fmt::format("{}: contains no images", input.string()));
  if (!options.times.empty()) ReplaceTimes(options.times, list);
  CheckTimesAscend(list.images);
  return list;
}

}  // namespace corvo
