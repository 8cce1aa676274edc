// SPDX-License-Identifier: MIT
#include "vo/offline/observation_log.h"

#include <gmock/gmock.h>

#include <vector>

namespace corvo {
namespace {

FrameObservations MakeFrame(int frame, KeyframeId keyframe, int num_landmarks) {
  FrameObservations seen{frame, frame / 10, keyframe, {}, {}, {}};
  for (int i = 0; i < num_landmarks; ++i) {
    const auto shift = static_cast<float>(i);
    seen.observations.push_back({7 * frame + i, kNoId, {shift / 3, 100 - shift}, 0.6F + shift});
    if (keyframe != kNoId) seen.in_world.emplace_back(i / 7.0, -i, 1e-9 * frame);
  }
  if (frame % 2 == 1) seen.merges = {{frame, 2}, {3, frame}};
  seen.num_joins = frame % 3;
  return seen;
}

TEST(ObservationLogTest, VisitReturnsTheLoggedObservations) {
  ObservationLog log;
  const ObservationCallback add = log.Callback();
  log.Visit([](const FrameObservations&) { FAIL(); });
  const std::vector<FrameObservations> given = {MakeFrame(0, kNoId, 3), MakeFrame(11, 4, 2),
                                                MakeFrame(12, kNoId, 0), MakeFrame(13, kNoId, 1)};
  std::size_t num_bytes = 0;
  for (std::size_t count = 1; count <= given.size(); ++count) {
    const FrameObservations& last = given[count - 1];
    add(last);
    num_bytes +=
        28 + 16 * last.observations.size() + 24 * last.in_world.size() + 8 * last.merges.size();
    std::size_t i = 0;
    log.Visit([&](const FrameObservations& seen) {  // Reading does not disturb writing.
      ASSERT_LT(i, count);
      EXPECT_EQ(seen.frame, given[i].frame);
      EXPECT_EQ(seen.segment, given[i].segment);
      EXPECT_EQ(seen.keyframe, given[i].keyframe);
      EXPECT_EQ(seen.observations, given[i].observations);
      EXPECT_EQ(seen.in_world, given[i].in_world);
      EXPECT_EQ(seen.merges, given[i].merges);
      EXPECT_EQ(seen.num_joins, given[i].num_joins);
      ++i;
    });
    EXPECT_EQ(i, count);
    EXPECT_EQ(log.size(), static_cast<int>(count));
    EXPECT_EQ(log.num_bytes(), num_bytes);
  }
}

TEST(ObservationLogTest, ANewMapReplacesTheReportsOfTheOneBefore) {
  ObservationLog log;
  const ObservationCallback add = log.Callback();
  add(MakeFrame(0, kNoId, 3));
  FrameObservations of_new_map = MakeFrame(0, kNoId, 2);
  of_new_map.first_landmark = 7;
  add(of_new_map);
  EXPECT_EQ(log.size(), 1);
  log.Visit([&](const FrameObservations& seen) {
    EXPECT_EQ(seen.observations, of_new_map.observations);
    EXPECT_EQ(seen.first_landmark, 7);
  });
}

TEST(ObservationLogTest, CallbackMayOutliveTheLog) {
  ObservationCallback add = ObservationLog().Callback();
  EXPECT_NO_THROW(add(MakeFrame(0, kNoId, 3)));
}

}  // namespace
}  // namespace corvo
