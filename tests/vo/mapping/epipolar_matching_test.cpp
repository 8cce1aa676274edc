// SPDX-License-Identifier: MIT
#include "vo/mapping/epipolar_matching.h"

#include <gmock/gmock.h>

#include "tests/vo/mapping/mapping_fixture.h"

namespace corvo {
namespace {

using EpipolarMatchingTest = test::MappingTest;

TEST_F(EpipolarMatchingTest, MatchesAreCorrectAndUseOnlyKeypointsWithoutLandmarks) {
  MakeViews(2, 100);
  const auto matches = MatchAlongEpipolarLines(map_.keyframe(0).frame, map_.keyframe(1).frame,
                                               map_.model(), {.min_depth = 1});
  EXPECT_GT(matches.size(), 100u);
  for (const orb::Match& match : matches) {
    EXPECT_EQ(views_[0].points[match.query], views_[1].points[match.train]);
    EXPECT_GE(views_[0].points[match.query], 100);
  }
}

TEST_F(EpipolarMatchingTest, EpipolarLinesDisambiguateEqualDescriptors) {
  // Two points share one descriptor, but not the epipolar line, which is the image row here.
  scene_.in_world = {{-0.5, -0.5, 5}, {0.5, 0.5, 5}};
  scene_.descriptors.resize(1);
  scene_.descriptors.push_back(scene_.descriptors[0]);
  MakeViews(2, 0);
  const auto matches = MatchAlongEpipolarLines(map_.keyframe(0).frame, map_.keyframe(1).frame,
                                               map_.model(), {.min_depth = 1});
  ASSERT_EQ(matches.size(), 2u);
  for (const orb::Match& match : matches) {
    EXPECT_EQ(views_[0].points[match.query], views_[1].points[match.train]);
  }
}

}  // namespace
}  // namespace corvo
