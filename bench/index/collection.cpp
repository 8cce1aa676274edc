// SPDX-License-Identifier: MIT
#include "bench/index/collection.h"

#include <algorithm>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>

#include "orb/error.h"
#include "orb/extractor.h"
#include "tests/data/data_path.h"

namespace corvo::bench {
namespace {

constexpr const char* kPatterns[] = {
    "kitti/sequences/03/image_0/*.png", "kitti/sequences/05/image_0/*.png",
    "kitti/sequences/06/image_0/*.png", "7scenes/redkitchen/*.color.jpg"};

/// Returns the next number of SplitMix64.
std::uint64_t NextRandom(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

int Draw(int min, int max, std::uint64_t& state) {
  return min + static_cast<int>(NextRandom(state) % static_cast<std::uint64_t>(max - min + 1));
}

/// Appends the descriptors of all images that match.
void AppendImages(const char* pattern, const orb::Extractor& extractor, Collection& collection) {
  std::vector<cv::String> files;
  cv::glob(test::DataPath(pattern).string(), files);
  if (files.empty()) throw Error(test::DataPath(pattern).string() + ": no such files");
  for (const std::string& file : files) {
    const cv::Mat image = cv::imread(file, cv::IMREAD_GRAYSCALE);
    if (image.empty()) throw Error(file + ": no image that can be read");
    const std::vector<orb::Descriptor> found = extractor.Extract(image).descriptors;
    collection.descriptors.insert(collection.descriptors.end(), found.begin(), found.end());
    ++collection.num_images;
  }
}

}  // namespace

orb::Descriptor FlipBits(orb::Descriptor descriptor, int count, std::uint64_t& state) {
  std::vector<bool> flipped(256, false);
  while (count > 0) {
    const int bit = Draw(0, 255, state);
    if (flipped[bit]) continue;
    flipped[bit] = true;
    descriptor.bytes[bit / 8] ^= static_cast<std::uint8_t>(1 << (bit % 8));
    --count;
  }
  return descriptor;
}

Collection MakeCollection(int size) {
  orb::ExtractorOptions options;
  options.num_features = 1500;
  const orb::Extractor extractor(options);
  Collection collection;
  for (const char* pattern : kPatterns) AppendImages(pattern, extractor, collection);
  std::vector<orb::Descriptor>& descriptors = collection.descriptors;
  collection.num_real = std::min(size, static_cast<int>(descriptors.size()));
  descriptors.resize(collection.num_real);
  std::uint64_t state = 2;
  for (int i = 0; i < size - collection.num_real; ++i) {
    descriptors.push_back(FlipBits(descriptors[i], Draw(1, 8, state), state));
  }
  descriptors.shrink_to_fit();
  return collection;
}

std::vector<orb::Descriptor> MakeQueries(const std::vector<orb::Descriptor>& collection, int count,
                                         std::uint64_t seed) {
  std::uint64_t state = seed;
  std::vector<orb::Descriptor> queries;
  for (int i = 0; i < count; ++i) {
    const int source = Draw(0, static_cast<int>(collection.size()) - 1, state);
    queries.push_back(FlipBits(collection[source], Draw(25, 50, state), state));
  }
  return queries;
}

}  // namespace corvo::bench
