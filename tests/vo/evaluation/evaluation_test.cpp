// SPDX-License-Identifier: MIT
#include "vo/evaluation/evaluation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/support/random.h"
#include "vo/io/trajectory_io.h"

namespace corvo {
namespace {

using test::IsMatrixNear;
using test::IsPoseNear;
using test::IsSimilarityNear;
using test::ThrowsError;
using ::testing::DoubleNear;

constexpr TimeNs kSecond = 1'000'000'000;

SE3 At(double x, double y = 0, double z = 0) { return SE3(SO3(), Eigen::Vector3d(x, y, z)); }

PoseSequence Stamped(const std::vector<TimeNs>& times_ns) {
  PoseSequence poses;
  for (const TimeNs time_ns : times_ns) poses.push_back({time_ns, At(1e-9 * time_ns)});
  return poses;
}

/// Makes one pair per second from poses given as functions of the index.
std::vector<PosePair> MakePairs(int count, const std::function<SE3(int)>& estimate,
                                const std::function<SE3(int)>& truth) {
  std::vector<PosePair> pairs;
  for (int i = 0; i < count; ++i) pairs.push_back({i * kSecond, estimate(i), truth(i)});
  return pairs;
}

/// Makes random true poses, and estimates that truth_from_estimate maps onto them.
std::vector<PosePair> MakeMovedPairs(const Sim3& truth_from_estimate, test::Random& random) {
  const Sim3 estimate_from_truth = truth_from_estimate.Inverse();
  std::vector<PosePair> pairs;
  for (int i = 0; i < 20; ++i) {
    const SE3 truth = random.Pose(3, 50);
    pairs.push_back({i * kSecond, TransformPose(estimate_from_truth, truth), truth});
  }
  return pairs;
}

TEST(HalfFrameTest, IsHalfTheMedianStep) {
  EXPECT_EQ(HalfFrame(Stamped({0, 100, 200, 900, 1000})), 50);
  EXPECT_EQ(HalfFrame(Stamped({5, 12})), 3);
  EXPECT_EQ(HalfFrame(Stamped({7})), kSecond / 50);
  EXPECT_EQ(HalfFrame({}), kSecond / 50);
}

TEST(AssociateTest, MatchesTheNearestPoseWithinTheLimit) {
  const auto pairs = Associate(Stamped({100, 205, 300}), Stamped({90, 104, 195, 210, 311}), 10);
  ASSERT_EQ(pairs.size(), 2);
  EXPECT_EQ(pairs[0].time_ns, 100);
  EXPECT_EQ(pairs[0].truth_from_camera, At(104e-9));
  EXPECT_EQ(pairs[1].time_ns, 205);
  EXPECT_EQ(pairs[1].truth_from_camera, At(210e-9));
}

TEST(AssociateTest, TheLimitIsIncluded) {
  EXPECT_EQ(Associate(Stamped({100}), Stamped({110}), 10).size(), 1);
  EXPECT_EQ(Associate(Stamped({100}), Stamped({110}), 9).size(), 0);
  EXPECT_EQ(Associate(Stamped({100}), Stamped({100}), 0).size(), 1);
}

TEST(AssociateTest, MatchesTheEarlierOfTwoEquallyNearPoses) {
  const auto pairs = Associate(Stamped({100}), Stamped({95, 105}), 10);
  ASSERT_EQ(pairs.size(), 1);
  EXPECT_EQ(pairs[0].truth_from_camera, At(95e-9));
}

TEST(AssociateTest, MatchesEachTruePoseOnlyToTheNearestEstimate) {
  const auto pairs = Associate(Stamped({96, 99, 101, 108}), Stamped({100}), 10);
  ASSERT_EQ(pairs.size(), 1);
  EXPECT_EQ(pairs[0].time_ns, 99);
}

TEST(AssociateTest, EmptySequencesHaveNoPairs) {
  EXPECT_TRUE(Associate({}, Stamped({1}), 10).empty());
  EXPECT_TRUE(Associate(Stamped({1}), {}, 10).empty());
}

TEST(AssociateTest, KeepsNanosecondsOfLargeTimes) {
  const TimeNs time_ns = 1403636579763555584;
  EXPECT_EQ(Associate(Stamped({time_ns}), Stamped({time_ns + 1}), 0).size(), 0);
  EXPECT_EQ(Associate(Stamped({time_ns}), Stamped({time_ns + 1}), 1).size(), 1);
}

TEST(AlignTest, RecoversAKnownSimilarity) {
  // The ground truth is the estimate rotated by 90 degrees about z, scaled by 2 and translated by
  // (10, 0, 5).
  const std::vector<PosePair> pairs = {{0, At(0, 0, 0), At(10, 0, 5)},
                                       {1, At(1, 0, 0), At(10, 2, 5)},
                                       {2, At(0, 1, 0), At(8, 0, 5)}};
  const Sim3 expected(2, SO3::Exp(Eigen::Vector3d(0, 0, std::numbers::pi / 2)),
                      Eigen::Vector3d(10, 0, 5));
  EXPECT_THAT(Align(pairs, Alignment::kSim3), IsSimilarityNear(expected, 1e-12, 1e-12, 1e-14));
}

TEST(AlignTest, RecoversAnySimilarity) {
  test::Random random(21);
  for (int i = 0; i < 100; ++i) {
    const Sim3 truth_from_estimate(std::exp(random.Uniform(-4, 4)), random.Rotation(),
                                   random.Vector<3>(100));
    const auto pairs = MakeMovedPairs(truth_from_estimate, random);
    const Sim3 aligned = Align(pairs, Alignment::kSim3);
    EXPECT_THAT(aligned, IsSimilarityNear(truth_from_estimate, 1e-10, 1e-10, 1e-12));
    for (const PosePair& pair : MoveEstimates(aligned, pairs)) {
      EXPECT_THAT(pair.estimate_from_camera, IsPoseNear(pair.truth_from_camera, 1e-10, 1e-10));
    }
  }
}

TEST(AlignTest, NeverMirrors) {
  test::Random random(22);
  for (int i = 0; i < 100; ++i) {
    std::vector<PosePair> pairs = MakeMovedPairs(Sim3(), random);
    for (PosePair& pair : pairs) {
      Eigen::Vector3d mirrored = pair.truth_from_camera.translation();
      mirrored.x() *= -1;
      if (i % 2 == 0) mirrored.z() = 0;  // A rotation can mirror a plane.
      pair.estimate_from_camera = SE3(SO3(), mirrored);
    }
    EXPECT_NEAR(Align(pairs, Alignment::kSim3).rotation().matrix().determinant(), 1, 1e-12);
  }
}

TEST(AlignTest, MinimizesTheRmseAmongTransformsOfItsKind) {
  test::Random random(23);
  std::vector<PosePair> pairs = MakeMovedPairs(Sim3(), random);
  for (PosePair& pair : pairs) {
    pair.estimate_from_camera = SE3(pair.estimate_from_camera.rotation(),
                                    pair.estimate_from_camera.translation() + random.Vector<3>(5));
  }
  const auto rmse = [&](const Sim3& truth_from_estimate) {
    return Summarize(PositionErrors(MoveEstimates(truth_from_estimate, pairs))).rmse;
  };
  const Sim3 similar = Align(pairs, Alignment::kSim3), rigid = Align(pairs, Alignment::kSe3);
  EXPECT_EQ(rigid.scale(), 1);
  EXPECT_LT(rmse(similar), rmse(rigid));
  EXPECT_LT(rmse(rigid), rmse(Sim3()));
  for (int i = 0; i < 100; ++i) {
    Sim3::Tangent delta = 1e-3 * random.Vector<7>();
    EXPECT_GT(rmse(similar * Sim3::Exp(delta)), rmse(similar));
    delta(6) = 0;
    EXPECT_GT(rmse(rigid * Sim3::Exp(delta)), rmse(rigid));
  }
}

TEST(AlignTest, ScaleOnlyAlignmentFindsTheScaleOfTheSimilarity) {
  test::Random random(24);
  const Sim3 truth_from_estimate(3, random.Rotation(), random.Vector<3>(10));
  const Sim3 scale = Align(MakeMovedPairs(truth_from_estimate, random), Alignment::kScale);
  EXPECT_THAT(scale, IsSimilarityNear(Sim3(3, SO3(), Eigen::Vector3d::Zero()), 0.0, 0.0, 1e-12));
}

TEST(AlignTest, AlignsCollinearPositionsWithoutError) {
  const auto pairs = MakePairs(
      10, [](int i) { return At(i, 2 * i, 0); }, [](int i) { return At(5, 0, 3 * i); });
  const auto aligned = MoveEstimates(Align(pairs, Alignment::kSim3), pairs);
  EXPECT_LT(Summarize(PositionErrors(aligned)).max, 1e-12);
}

TEST(AlignTest, RejectsTooFewPairsAndCoincidentPositions) {
  const auto moving = [](int i) { return At(i, i * i, 0); };
  const auto still = [](int) { return At(1, 2, 3); };
  for (const Alignment alignment : {Alignment::kSim3, Alignment::kSe3, Alignment::kScale}) {
    EXPECT_THAT([&] { Align(MakePairs(2, moving, moving), alignment); },
                ThrowsError("3 pairs", "there are 2"));
    EXPECT_THAT([&] { Align({}, alignment); }, ThrowsError("there are 0"));
    EXPECT_THAT([&] { Align(MakePairs(9, still, moving), alignment); }, ThrowsError("estimated"));
    EXPECT_THAT([&] { Align(MakePairs(9, moving, still), alignment); }, ThrowsError("true"));
  }
  const auto rounded = [](int i) { return At(1e6 + 1e-8 * i, 2, 3); };  // To double precision.
  EXPECT_THAT([&] { Align(MakePairs(9, rounded, moving), Alignment::kSim3); },
              ThrowsError("estimated"));
  EXPECT_EQ(Align(MakePairs(2, still, still), Alignment::kNone), Sim3());
}

TEST(AlignmentTest, NamesRoundTrip) {
  for (const Alignment alignment :
       {Alignment::kSim3, Alignment::kSe3, Alignment::kScale, Alignment::kNone}) {
    EXPECT_EQ(ParseAlignment(ToString(alignment)), alignment);
  }
  EXPECT_THAT([] { ParseAlignment("sim4"); }, ThrowsError("sim4", "sim3, se3, scale or none"));
}

TEST(SummarizeTest, ComputesStatisticsOfKnownErrors) {
  const ErrorStatistics even = Summarize({4, 3});
  EXPECT_EQ(even.count, 2);
  EXPECT_EQ(even.rmse, std::sqrt(12.5));
  EXPECT_EQ(even.mean, 3.5);
  EXPECT_EQ(even.median, 3.5);
  EXPECT_EQ(even.max, 4);
  EXPECT_EQ(Summarize({9, 1, 2}).median, 2);
}

TEST(SummarizeTest, StatisticsOfNoErrorsAreNan) {
  EXPECT_EQ(Summarize({}).count, 0);
  EXPECT_TRUE(std::isnan(Summarize({}).rmse));
  EXPECT_TRUE(std::isnan(Summarize({}).max));
}

TEST(RelativeErrorTest, MeasuresStepsThatAreTooLong) {
  const auto pairs = MakePairs(
      11, [](int i) { return At(1.1 * i); }, [](int i) { return At(i); });
  const RelativeError one = RelativeErrorOverFrames(pairs, 1);
  EXPECT_EQ(one.translation.count, 10);
  EXPECT_NEAR(one.translation.rmse, 0.1, 1e-14);
  EXPECT_NEAR(one.rotation_deg.max, 0, 1e-12);
  EXPECT_NEAR(RelativeErrorOverFrames(pairs, 5).translation.mean, 0.5, 1e-14);
  EXPECT_EQ(RelativeErrorOverFrames(pairs, 10).translation.count, 1);
  EXPECT_EQ(RelativeErrorOverFrames(pairs, 11).translation.count, 0);
  EXPECT_THAT([&] { RelativeErrorOverFrames(pairs, 0); }, ThrowsError("delta is 0"));
}

TEST(RelativeErrorTest, MeasuresASpuriousRotation) {
  const auto pairs = MakePairs(
      5, [](int i) { return SE3(SO3::Exp(Eigen::Vector3d(0, 0.02 * i, 0)), At(i).translation()); },
      [](int i) { return At(i); });
  EXPECT_NEAR(RelativeErrorOverFrames(pairs, 2).rotation_deg.mean, 0.04 * 180 / std::numbers::pi,
              1e-12);
}

TEST(RelativeErrorTest, DoesNotDependOnTheWorldFrame) {
  test::Random random(25);
  std::vector<PosePair> pairs = MakeMovedPairs(Sim3(random.Pose(3, 10)), random);
  EXPECT_LT(RelativeErrorOverFrames(pairs, 1).translation.max, 1e-12);
  EXPECT_LT(RelativeErrorOverFrames(pairs, 1).rotation_deg.max, 1e-10);
}

TEST(RelativeErrorTest, ErrorOverTimeSkipsGaps) {
  auto pairs = MakePairs(
      6, [](int i) { return At(1.1 * i); }, [](int i) { return At(i); });
  for (int i = 3; i < 6; ++i) pairs[i].time_ns += 10 * kSecond;
  const RelativeError two_seconds =
      RelativeErrorOverTime(pairs, 2 * kSecond);  // Pairs 0 to 2, 3 to 5.
  EXPECT_EQ(two_seconds.translation.count, 2);
  EXPECT_NEAR(two_seconds.translation.mean, 0.2, 1e-14);
  EXPECT_EQ(RelativeErrorOverTime(pairs, 1).translation.count, 0);
  EXPECT_THAT([&] { RelativeErrorOverTime(pairs, 0); }, ThrowsError("delta_ns is 0"));
}

TEST(RelativeErrorTest, ErrorOverPathUsesConsecutiveStretches) {
  // The path has 10 steps of 1 m: each stretch of 2.5 m ends after 3 steps, where the next begins.
  const auto pairs = MakePairs(
      11, [](int i) { return At(1.1 * i); }, [](int i) { return At(i); });
  const RelativeError error = RelativeErrorOverPath(pairs, 2.5);
  EXPECT_EQ(error.translation.count, 3);
  EXPECT_NEAR(error.translation.mean, 0.3, 1e-14);
  EXPECT_EQ(RelativeErrorOverPath(pairs, 1).translation.count, 10);  // The limit is included.
  EXPECT_EQ(RelativeErrorOverPath(pairs, 10.5).translation.count, 0);
  EXPECT_EQ(RelativeErrorOverPath({}, 1).translation.count, 0);
  EXPECT_THAT([&] { RelativeErrorOverPath(pairs, 0); }, ThrowsError("delta is 0"));
}

TEST(KittiDriftTest, MeasuresAScaleError) {
  // The path has 300 m in steps of 1 m. Stretches of 100 m start at 0, 10 ... 190 and have 101
  // steps (the first pair beyond 100 m ends them); those of 200 m start at 0, 10 ... 90 and have
  // 201 steps.
  const auto pairs = MakePairs(
      301, [](int i) { return At(0, 0, 1.02 * i); }, [](int i) { return At(0, 0, i); });
  const auto drift = ComputeKittiDrift(pairs);
  ASSERT_TRUE(drift);
  ASSERT_EQ(drift->lengths.size(), 2);
  EXPECT_EQ(drift->lengths[0].length_m, 100);
  EXPECT_EQ(drift->lengths[0].count, 20);
  EXPECT_NEAR(drift->lengths[0].t_rel_percent, 2.02, 1e-10);
  EXPECT_EQ(drift->lengths[1].count, 10);
  EXPECT_NEAR(drift->lengths[1].t_rel_percent, 2.01, 1e-10);
  EXPECT_NEAR(drift->t_rel_percent, (20 * 2.02 + 10 * 2.01) / 30, 1e-10);
  EXPECT_NEAR(drift->r_rel_deg_per_100m, 0, 1e-10);
}

TEST(KittiDriftTest, MeasuresARotationError) {
  const double step = 0.01 * std::numbers::pi / 180;
  const auto pairs = MakePairs(
      150,
      [&](int i) { return SE3(SO3::Exp(Eigen::Vector3d(0, step * i, 0)), At(i).translation()); },
      [](int i) { return At(i); });
  EXPECT_NEAR(ComputeKittiDrift(pairs)->r_rel_deg_per_100m, 1.01, 1e-10);
}

TEST(KittiDriftTest, EvaluatesEveryLengthFromEveryTenthFrame) {
  // The path has 1000 m in steps of 2 m, 501 poses. A stretch of L m ends at the first pose more
  // than L m along the path, L / 2 + 1 steps later, so stretches start at frames 0, 10 ... up to
  // 500 - L / 2 - 1. The estimate turns by a fixed angle and moves 3% too far in each step.
  const double step_rad = 0.02 * std::numbers::pi / 180;
  const auto pairs = MakePairs(
      501,
      [&](int i) {
        return SE3(SO3::Exp(Eigen::Vector3d(0, step_rad * i, 0)), {0, 2.06 * i, 0});
      },
      [](int i) { return At(0, 2 * i); });
  const auto drift = ComputeKittiDrift(pairs);
  ASSERT_TRUE(drift);
  ASSERT_EQ(drift->lengths.size(), 8);
  double count = 0, t_rel = 0, r_rel = 0;
  for (int k = 0; k < 8; ++k) {
    const int length = 100 * (k + 1), steps = length / 2 + 1, stretches = (500 - steps) / 10 + 1;
    EXPECT_EQ(drift->lengths[k].length_m, length);
    EXPECT_EQ(drift->lengths[k].count, stretches);
    EXPECT_NEAR(drift->lengths[k].t_rel_percent, 100 * 0.06 * steps / length, 1e-9);
    EXPECT_NEAR(drift->lengths[k].r_rel_deg_per_100m, 100 * 0.02 * steps / length, 1e-9);
    count += stretches;
    t_rel += stretches * drift->lengths[k].t_rel_percent;
    r_rel += stretches * drift->lengths[k].r_rel_deg_per_100m;
  }
  EXPECT_NEAR(drift->t_rel_percent, t_rel / count, 1e-9);
  EXPECT_NEAR(drift->r_rel_deg_per_100m, r_rel / count, 1e-9);
}

TEST(KittiDriftTest, PathsOfAtMost100MetersHaveNoDrift) {
  const auto same = [](int i) { return At(i); };
  EXPECT_FALSE(ComputeKittiDrift({}));
  EXPECT_FALSE(ComputeKittiDrift(MakePairs(101, same, same)));  // No pair is beyond 100 m.
  EXPECT_TRUE(ComputeKittiDrift(MakePairs(102, same, same)));
}

TEST(ScaleDriftTest, MeasuresAKnownScaleDrift) {
  // The estimated steps are 1, 1.1 and 1.2 for a true 1 m, over 30 m each.
  double x = 0;
  const auto pairs = MakePairs(
      91, [&](int i) { return At(i == 0 ? 0 : x += 1 + 0.1 * ((i - 1) / 30)); },
      [](int i) { return At(i); });
  const auto drift = ComputeScaleDrift(pairs);
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->last_over_first, 1.2, 1e-12);
  EXPECT_NEAR(drift->percent_per_km, 20 / 0.06, 1e-9);
}

TEST(ScaleDriftTest, DoesNotDependOnTheScale) {
  const auto drift = ComputeScaleDrift(MakePairs(
      10, [](int i) { return At(0.01 * i); }, [](int i) { return At(0, i, 0); }));
  EXPECT_NEAR(drift->last_over_first, 1, 1e-12);
  EXPECT_NEAR(drift->percent_per_km, 0, 1e-6);
}

TEST(ScaleDriftTest, NeedsEnoughPairsAndMotion) {
  const auto moving = [](int i) { return At(i); };
  const auto still = [](int) { return At(1); };
  EXPECT_FALSE(ComputeScaleDrift(MakePairs(5, moving, moving)));
  EXPECT_FALSE(ComputeScaleDrift(MakePairs(9, still, moving)));
  EXPECT_FALSE(ComputeScaleDrift(MakePairs(9, moving, still)));
  EXPECT_TRUE(ComputeScaleDrift(MakePairs(9, moving, moving)));
}

TEST(CoverageTest, IsTheShareOfTruePosesNearAnEstimate) {
  const PoseSequence truth = Stamped({0, 10, 20, 30});
  EXPECT_EQ(Coverage(Stamped({1, 11}), truth, 2), 0.5);
  EXPECT_EQ(Coverage(truth, truth, 0), 1);
  EXPECT_EQ(Coverage({}, truth, 5), 0);
  EXPECT_EQ(Coverage(truth, {}, 5), 0);
}

TEST(PathLengthTest, SumsTheSteps) {
  EXPECT_EQ(PathLength({}), 0);
  EXPECT_EQ(PathLength({{0, At(7)}}), 0);
  EXPECT_EQ(PathLength({{0, At(0, 0)}, {1, At(3, 4)}, {2, At(3, 4)}, {3, At(0, 4)}}), 8);
}

TEST(EvaluateTest, AlignsAnEstimateOfAnotherScaleAndWorldFrame) {
  test::Random random(26);
  const Sim3 estimate_from_truth(0.1, random.Rotation(), random.Vector<3>(5));
  PoseSequence truth, estimate;
  for (int i = 0; i < 40; ++i) {
    truth.push_back({i * kSecond / 2, At(i, 0.01 * i * i)});
    if (i < 10) continue;
    estimate.push_back(
        {truth[i].time_ns + 1000, TransformPose(estimate_from_truth, truth[i].world_from_camera)});
  }
  const Evaluation evaluation = Evaluate(estimate, truth);
  EXPECT_EQ(evaluation.num_pairs, 30);
  EXPECT_EQ(evaluation.coverage, 0.75);
  EXPECT_THAT(evaluation.truth_from_estimate,
              IsSimilarityNear(estimate_from_truth.Inverse(), 1e-9, 1e-9, 1e-12));
  EXPECT_LT(evaluation.absolute.max, 1e-10);
  EXPECT_EQ(evaluation.relative_frames.translation.count, 29);
  EXPECT_EQ(evaluation.relative_time.translation.count, 28);
  EXPECT_LT(evaluation.relative_time.translation.max, 1e-10);
  EXPECT_FALSE(evaluation.kitti);
  EXPECT_NEAR(evaluation.scale_drift->last_over_first, 1, 1e-10);
  EXPECT_GT(evaluation.truth_path_length, 29);
}

TEST(EvaluateTest, ThrowsIfNoTimestampsMatch) {
  EXPECT_THAT(
      [] {
        Evaluate(Stamped({0, kSecond / 2, kSecond}), Stamped({2 * kSecond, 3 * kSecond}));
      },
      ThrowsError("no pose of 3 lies within 0.25 s of one of the truth's 2"));
}

TEST(EvaluateTest, RealGroundTruthHasNoErrorAgainstItself) {
  CORVO_REQUIRE_DATA("kitti/poses/03.txt");
  const PoseSequence truth =
      WithTimes(ReadKittiPoses(test::DataPath("kitti/poses/03.txt")),
                ReadKittiTimes(test::DataPath("kitti/sequences/03/times.txt")));
  const Sim3 moved(0.05, SO3::Exp(Eigen::Vector3d(1, 2, 0.5)), Eigen::Vector3d(7, 8, 9));
  PoseSequence estimate = truth;
  for (TimedPose& pose : estimate) {
    pose.world_from_camera = TransformPose(moved, pose.world_from_camera);
  }
  const Evaluation evaluation = Evaluate(estimate, truth);
  EXPECT_EQ(evaluation.coverage, 1);
  EXPECT_NEAR(evaluation.truth_path_length, 200.55, 0.01);
  EXPECT_LT(evaluation.absolute.rmse, 1e-9);
  ASSERT_TRUE(evaluation.kitti);
  EXPECT_LT(evaluation.kitti->t_rel_percent, 1e-9);
  EXPECT_LT(evaluation.kitti->r_rel_deg_per_100m, 1e-9);
}

TEST(EvaluateTest, PosesThatNoComputationHoldsAreErrors) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PoseSequence good;
  for (int i = 0; i < 5; ++i) good.push_back({i * kSecond, At(i, i % 2, i % 3)});
  for (const double bad : {nan, std::numeric_limits<double>::infinity(), 1e160, -1e160}) {
    PoseSequence wrong = good;
    wrong[3].world_from_camera = At(0, bad);
    EXPECT_THAT([&] { Evaluate(wrong, good); }, ThrowsError("pose 3 of the estimate: y is"));
    EXPECT_THAT([&] { Evaluate(good, wrong); }, ThrowsError("pose 3 of the ground truth: y is"));
  }
  PoseSequence late = good;
  late.back().time_ns = std::numeric_limits<TimeNs>::max();
  EXPECT_THAT([&] { Evaluate(late, good); }, ThrowsError("pose 4 of the estimate: time"));
  EXPECT_EQ(
      HalfFrame(Stamped({std::numeric_limits<TimeNs>::min(), std::numeric_limits<TimeNs>::max()})),
      std::numeric_limits<TimeNs>::max());
  PoseSequence tiny = good;
  for (TimedPose& pose : tiny) pose.world_from_camera = At(1e-170 * (pose.time_ns % 7));
  EXPECT_THAT([&] { Evaluate(tiny, good); }, ThrowsError("estimated positions are equal"));
}

}  // namespace
}  // namespace corvo
