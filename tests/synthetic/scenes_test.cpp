// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <tbb/global_control.h>
#include <Eigen/LU>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "apps/synthetic/random.h"
#include "apps/synthetic/sequence.h"
#include "tests/cli/expect_error.h"
#include "tests/support/data.h"
#include "tests/support/matchers.h"

namespace corvo::synthetic {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::ErrorOf;

constexpr double kDegree = 3.14159265358979323846 / 180;

SequenceOptions Small(int frames, int width) {
  SequenceOptions options;
  options.frames = frames;
  options.width = width;
  return options;
}

SE3 Motion(const Sequence& sequence, std::size_t from, std::size_t to) {
  return sequence.poses()[to].world_from_camera.Inverse() *
         sequence.poses()[from].world_from_camera;
}

/// Maps a pixel of one frame to its position in another, using the ground truth; NaN if the pixel
/// shows no surface or its point is outside the other image.
class Warp {
 public:
  Warp(const Sequence& sequence, int from, int to)
      : camera_(sequence.camera()),
        depth_(sequence.RenderDepth(from)),
        to_from_(Motion(sequence, static_cast<std::size_t>(from), static_cast<std::size_t>(to))) {}

  Vector2d operator()(const cv::Point& pixel, double* depth = nullptr) const {
    const Vector2d outside = Vector2d::Constant(std::nan(""));
    const double z = depth_.at<float>(pixel);
    const auto ray = camera_.Undistort(Vector2d(pixel.x, pixel.y));
    if (z <= 0 || !ray) return outside;
    const Vector3d point = to_from_ * Vector3d(z * ray->x(), z * ray->y(), z);
    const auto projected = camera_.Project(point);
    if (!projected || !camera_.Contains(*projected)) return outside;
    if (depth) *depth = point.z();
    return *projected;
  }

 private:
  Camera camera_;
  cv::Mat depth_;
  SE3 to_from_;
};

std::vector<cv::KeyPoint> Corners(const cv::Mat& image) {
  std::vector<cv::KeyPoint> corners;
  cv::FAST(image, corners, 20);
  return corners;
}

/// Returns the share of the FAST corners of a frame, among those inside the next image, that have a
/// corner of the next frame within 2 px of their predicted position.
double Repeatability(const Sequence& sequence, int frame) {
  const Warp warp(sequence, frame, frame + 1);
  const std::vector<cv::KeyPoint> next = Corners(sequence.Render(frame + 1));
  int seen = 0, repeated = 0;
  for (const cv::KeyPoint& corner : Corners(sequence.Render(frame))) {
    const Vector2d expected = warp(cv::Point(corner.pt));
    if (!expected.allFinite()) continue;
    ++seen;
    repeated += std::any_of(next.begin(), next.end(), [&](const cv::KeyPoint& other) {
      return (Vector2d(other.pt.x, other.pt.y) - expected).norm() <= 2;
    });
  }
  return static_cast<double>(repeated) / seen;
}

double Interpolate(const cv::Mat& image, const Vector2d& place) {
  const int x = static_cast<int>(place.x()), y = static_cast<int>(place.y());
  const double a = place.x() - x, b = place.y() - y;
  const auto gray = [&](int i, int j) -> double { return image.at<std::uint8_t>(y + j, x + i); };
  return (1 - b) * ((1 - a) * gray(0, 0) + a * gray(1, 0)) +
         b * ((1 - a) * gray(0, 1) + a * gray(1, 1));
}

/// Returns the median absolute gray difference over pixels of frame `from` whose surface is also
/// visible in frame `to`.
double MedianPhotometricError(const Sequence& sequence, int from, int to) {
  const cv::Mat first = sequence.Render(from), second = sequence.Render(to);
  const cv::Mat second_depth = sequence.RenderDepth(to);
  const Warp warp(sequence, from, to);
  std::vector<double> errors;
  for (int i = 0; i < first.rows * first.cols; i += 7) {
    const cv::Point pixel(i % first.cols, i / first.cols);
    double depth = 0;
    const Vector2d place = warp(pixel, &depth);
    const bool inside = place.x() >= 0 && place.y() >= 0 && place.x() < first.cols - 1 &&
                        place.y() < first.rows - 1;
    if (!inside) continue;
    const double seen =
        second_depth.at<float>(cv::Point(std::lround(place.x()), std::lround(place.y())));
    if (std::abs(seen - depth) > 0.05 * depth) continue;
    errors.push_back(std::abs(Interpolate(second, place) - first.at<std::uint8_t>(pixel)));
  }
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

std::uint64_t HashOf(const cv::Mat& image) {
  std::uint64_t hash = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) hash = Hash(hash, image.at<std::uint8_t>(y, x));
  }
  return hash;
}

struct SceneCase {
  const char* name;
  Sequence (*make)(const SequenceOptions&);
  int width;                  ///< Image width in the tests, px.
  std::uint64_t fingerprint;  ///< Fingerprint of the scene.
  std::uint64_t image_hash;   ///< Hash of frame 7 of a sequence of eight.
};

void PrintTo(const SceneCase& scene, std::ostream* stream) { *stream << scene.name; }

class EveryScene : public ::testing::TestWithParam<SceneCase> {};

/// The scenes are fixed, so that results on them are comparable across versions. A deliberate
/// change of a scene must update these numbers.
TEST_P(EveryScene, MatchesItsRecordedFingerprintAndImage) {
  const Sequence sequence = GetParam().make(Small(8, GetParam().width));
  EXPECT_EQ(sequence.scene().Fingerprint(), GetParam().fingerprint);
  EXPECT_EQ(HashOf(sequence.Render(7)), GetParam().image_hash);
}

TEST_P(EveryScene, ImagesDoNotDependOnTheNumberOfThreads) {
  const Sequence sequence = GetParam().make(Small(2, GetParam().width));
  const cv::Mat image = sequence.Render(1);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(cv::norm(sequence.Render(1), image, cv::NORM_INF), 0);
}

TEST_P(EveryScene, ImagesDoNotDependOnTheSequenceLength) {
  CORVO_SKIP_IF_SHORT();
  const Sequence brief = GetParam().make(Small(3, GetParam().width));
  const Sequence longer = GetParam().make(Small(400, GetParam().width));
  EXPECT_EQ(cv::norm(brief.Render(2), longer.Render(2), cv::NORM_INF), 0);
}

TEST_P(EveryScene, StartsAtTheOriginAndTimestampsFollowTheFrameRate) {
  const Sequence sequence = GetParam().make(Small(20, GetParam().width));
  EXPECT_EQ(sequence.poses()[0].time_ns, 0);
  EXPECT_EQ(sequence.poses()[0].world_from_camera, SE3());
  for (std::size_t i = 1; i < sequence.poses().size(); ++i) {
    const double seconds = static_cast<double>(i) / sequence.frame_rate_hz();
    EXPECT_NEAR(static_cast<double>(sequence.poses()[i].time_ns), 1e9 * seconds, 0.51);
  }
}

/// The next frame shows the same gray at the position that the ground truth predicts.
TEST_P(EveryScene, IsPhotometricallyConsistent) {
  CORVO_SKIP_IF_SHORT();
  const Sequence sequence = GetParam().make(Small(4, GetParam().width));
  EXPECT_LT(MedianPhotometricError(sequence, 2, 3), 1.5);
}

class TexturedScene : public EveryScene {};

/// Real images have as many corners with the same repeatability: on KITTI 03 and 05, and on
/// 7-Scenes, 65% to 82% of the corners that optical flow can follow are detected again.
TEST_P(TexturedScene, HasRealisticCorners) {
  CORVO_SKIP_IF_SHORT();
  const Sequence sequence = GetParam().make(Small(2, GetParam().width));
  EXPECT_GT(Corners(sequence.Render(0)).size(), 1000u);
  EXPECT_GT(Repeatability(sequence, 0), 0.65);
}

const SceneCase kRoom = {"room", MakeRoom, 480, 0x098567f0545c54cbU, 0x3262a8aedc25b698U};
const SceneCase kStreet = {"street", MakeStreet, 1241, 0xcf339a94fcc6f22cU, 0x8415c19f6daad9ebU};
const SceneCase kWall = {"wall", MakePlanarWall, 480, 0xc9ee95895556300aU, 0x95c11b171b4e0ef7U};
const SceneCase kRotation = {"rotation", MakePureRotation, 480, 0x098567f0545c54cbU,
                             0x38a970d1a50aa0e7U};
const SceneCase kCorridor = {"corridor", MakeCorridor, 480, 0x8da3a5b55eac9539U,
                             0x3c96623fd2ffded3U};

std::string NameOf(const testing::TestParamInfo<SceneCase>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene,
                         testing::Values(kRoom, kStreet, kWall, kRotation, kCorridor), NameOf);
INSTANTIATE_TEST_SUITE_P(Scenes, TexturedScene, testing::Values(kRoom, kStreet, kWall, kRotation),
                         NameOf);

TEST(Room, IsALoopOfEightMetersAtWalkingPace) {
  const Sequence room = MakeRoom(Small(301, 64));
  double path = 0;
  for (std::size_t i = 1; i < room.poses().size(); ++i) {
    const SE3 step = Motion(room, i - 1, i);
    path += step.translation().norm();
    EXPECT_LT(step.translation().norm(), 0.05);
    EXPECT_LT(step.rotation().Angle(), 1.5 * kDegree);
  }
  EXPECT_NEAR(path, 8, 0.5);
  EXPECT_LT(Motion(room, 0, 300).translation().norm(), 0.05);
}

TEST(Room, HasTheDepthsOfARoom) {
  cv::Mat depth = MakeRoom(Small(1, 320)).RenderDepth(0);
  double nearest = 0, farthest = 0;
  cv::minMaxLoc(depth, &nearest, &farthest);
  EXPECT_GT(nearest, 0.4);
  EXPECT_LT(farthest, 7);
}

TEST(Street, AdvancesAtTheSpeedOfACar) {
  const Sequence street = MakeStreet(Small(300, 64));
  for (std::size_t i = 1; i < street.poses().size(); ++i) {
    const SE3 step = Motion(street, i - 1, i);
    EXPECT_GT(step.translation().norm(), 0.5);
    EXPECT_LT(step.translation().norm(), 0.81);
    EXPECT_LT(step.rotation().Angle(), 4 * kDegree);
    EXPECT_LT(std::abs(step.translation().x()), 0.05);
  }
}

TEST(Street, TurnsByARightAngle) {
  const Sequence street = MakeStreet(Small(300, 64));
  double widest = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    widest = std::max(widest, street.poses()[i].world_from_camera.rotation().Angle());
  }
  EXPECT_NEAR(widest, 90 * kDegree, 20 * kDegree);
}

/// No object is closer than 2.5 m to the camera.
TEST(Street, RoadAheadIsFreeOfObstacles) {
  const Sequence street = MakeStreet(Small(300, 124));
  for (int i = 0; i < street.size(); i += 10) {
    double nearest = 0;
    cv::Mat depth = street.RenderDepth(i);
    depth.setTo(1000, depth == 0);
    cv::minMaxLoc(depth, &nearest, nullptr);
    EXPECT_GT(nearest, 2.5) << "frame " << i;
  }
}

/// A corridor has less than a tenth of the corners of a room, but more than 20.
TEST(Corridor, HasLittleTexture) {
  const cv::Mat corridor = MakeCorridor(Small(1, 640)).Render(0);
  const std::size_t corners = Corners(corridor).size();
  EXPECT_GT(corners, 20u);
  EXPECT_LT(corners, Corners(MakeRoom(Small(1, 640)).Render(0)).size() / 10);
}

TEST(Corridor, PathFollowsTheCorridorWithoutHittingAWall) {
  const Sequence corridor = MakeCorridor(Small(4500, 64));
  double farthest = 0;
  for (std::size_t i = 1; i < corridor.poses().size(); ++i) {
    EXPECT_LT(Motion(corridor, i - 1, i).translation().norm(), 0.06);
    farthest = std::max(farthest, Motion(corridor, 0, i).translation().norm());
  }
  EXPECT_GT(farthest, 40);
  for (int i = 0; i < corridor.size(); i += 250) {
    double nearest = 0;
    cv::minMaxLoc(corridor.RenderDepth(i), &nearest, nullptr);
    EXPECT_GT(nearest, 0.5) << "frame " << i;
  }
}

/// Two views of a plane n . x = d are related by the homography H = R + t nᵀ / d.
TEST(PlanarWall, TwoViewsAreRelatedByAHomography) {
  const Sequence wall = MakePlanarWall(Small(40, 320));
  const Warp warp(wall, 10, 25);
  const SE3 scene_from_first = wall.scene_from_camera(10);
  const Vector3d normal = scene_from_first.rotation().Inverse() * Vector3d::UnitX();
  const double distance = -scene_from_first.translation().x();
  const SE3 second_from_first = Motion(wall, 10, 25);
  const Eigen::Matrix3d homography =
      second_from_first.rotation().matrix() +
      second_from_first.translation() * normal.transpose() / distance;
  for (const cv::Point& pixel : {cv::Point(40, 30), cv::Point(140, 120), cv::Point(190, 160)}) {
    const Vector2d ray = *wall.camera().Undistort(Vector2d(pixel.x, pixel.y));
    const Vector2d expected = *wall.camera().Project(homography * ray.homogeneous());
    EXPECT_THAT(warp(pixel), test::IsMatrixNear(expected, 1e-3));
  }
}

TEST(PureRotation, CameraTurnsWithoutTranslation) {
  const Sequence rotation = MakePureRotation(Small(300, 64));
  double widest = 0;
  for (const TimedPose& pose : rotation.poses()) {
    EXPECT_LT(pose.world_from_camera.translation().norm(), 1e-12);
    widest = std::max(widest, pose.world_from_camera.rotation().Angle());
  }
  EXPECT_GT(widest, 30 * kDegree);
}

class EveryLens : public testing::TestWithParam<CameraModel> {};

/// The images agree with the projection equations of the camera model.
TEST_P(EveryLens, ImagesAgreeWithTheCameraModel) {
  CameraParameters lens = MakePlanarWall(Small(1, 320)).camera().parameters();
  lens.model = GetParam();
  if (GetParam() == CameraModel::kFov) {
    lens.omega = 0.9;
  } else {
    lens.k1 = -0.2;
    lens.k2 = 0.05;
  }
  SequenceOptions options = Small(3, 320);
  options.camera = lens;
  const Sequence sequence = MakePlanarWall(options);
  EXPECT_EQ(sequence.camera().parameters(), lens);
  EXPECT_LT(MedianPhotometricError(sequence, 1, 2), 1.5);
}

INSTANTIATE_TEST_SUITE_P(Lenses, EveryLens,
                         testing::Values(CameraModel::kPinhole, CameraModel::kKb4,
                                         CameraModel::kFov),
                         [](const auto& test) {
                           std::string name(ToString(test.param));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

class NoisyWall : public ::testing::Test {
 protected:
  static cv::Mat Noise(int frame, double sigma, std::uint64_t seed) {
    SequenceOptions options = Small(3, 320);
    const cv::Mat clean = MakePlanarWall(options).Render(frame);
    options.noise_sigma = sigma;
    options.noise_seed = seed;
    cv::Mat noise;
    cv::subtract(MakePlanarWall(options).Render(frame), clean, noise, cv::noArray(), CV_16S);
    return noise;
  }
};

TEST_F(NoisyWall, NoiseHasTheGivenStandardDeviation) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(Noise(0, 5, 1), mean, deviation);
  EXPECT_NEAR(mean[0], 0, 0.1);
  EXPECT_NEAR(deviation[0], 5, 0.1);
}

TEST_F(NoisyWall, NoiseDependsOnFrameAndSeedOnly) {
  CORVO_SKIP_IF_SHORT();
  const cv::Mat noise = Noise(0, 5, 1);
  EXPECT_EQ(cv::norm(noise, Noise(0, 5, 1), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(noise, Noise(1, 5, 1), cv::NORM_INF), 10);
  EXPECT_GT(cv::norm(noise, Noise(0, 5, 2), cv::NORM_INF), 10);
}

TEST(SequenceOptions, ErrorsNameTheFieldOutOfRange) {
  SequenceOptions options;
  options.frames = 0;
  EXPECT_THAT(ErrorOf([&] { MakeRoom(options); }), ::testing::HasSubstr("frames is 0"));
  options = {};
  options.width = 10;
  EXPECT_THAT(ErrorOf([&] { MakeStreet(options); }), ::testing::HasSubstr("width is 10"));
  options = {};
  options.noise_sigma = std::nan("");
  EXPECT_THAT(ErrorOf([&] { MakeRoom(options); }), ::testing::HasSubstr("noise_sigma is nan"));
}

TEST(TurnTest, TheCameraTurnsAboutItsOwnCenterAndThenContinuesItsPath) {
  SequenceOptions options = Small(80, 64);
  const PoseSequence plain = MakeRoom(options).poses();
  options.turn = {1, 1};  // Frames 30 to 59.
  const PoseSequence turned = MakeRoom(options).poses();
  ASSERT_EQ(turned.size(), plain.size());
  for (std::size_t i = 0; i < turned.size(); ++i) {
    const SE3& pose = turned[i].world_from_camera;
    const SE3& stands = plain[i < 30 ? i : i < 60 ? 30 : i - 30].world_from_camera;
    const double turn = (stands.rotation().Inverse() * pose.rotation()).Angle();
    const double phase =
        i < 30 || i >= 60 ? 0 : 2 * 180 * kDegree * (static_cast<double>(i) - 30) / 30;
    EXPECT_THAT(pose.translation(), test::IsMatrixNear(stands.translation(), 1e-12));
    EXPECT_NEAR(turn, 0.7 * std::abs(std::sin(phase)), 1e-9) << i;
  }
}

}  // namespace
}  // namespace corvo::synthetic
