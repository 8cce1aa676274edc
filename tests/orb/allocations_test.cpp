// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "orb/extractor.h"
#include "tests/orb/images.h"

namespace {

std::atomic<int> num_allocations = 0;

}  // namespace

void* operator new(std::size_t size) {
  ++num_allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace corvo::orb {
namespace {

TEST(AllocationsTest, ExtractingAllocatesNothingAfterTheFirstImage) {
  const cv::Mat image = test::ShapesImage({640, 480}, 1);
  const cv::Mat mask(image.size(), CV_8UC1, cv::Scalar(1));
  for (const bool grid : {true, false}) {
    ExtractorOptions options;
    options.grid = grid;
    const Extractor extractor(options);
    Features features;
    extractor.Extract(image, mask, features);
    const Features expected = features;
    const int before = num_allocations;
    extractor.Extract(image, mask, features);
    EXPECT_EQ(num_allocations, before) << "grid " << grid;
    EXPECT_EQ(features, expected);
  }
}

TEST(AllocationsTest, NewIncrementsTheCounter) {
  const int before = num_allocations;
  const auto number = std::make_unique<int>(1);
  EXPECT_EQ(num_allocations, before + 1);
}

}  // namespace
}  // namespace corvo::orb
