#include "vo/calibration.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/point_scene.h"
#include "vo/camera.h"

namespace corvo {
namespace {

CameraParameters Given() {
  CameraParameters given = test::PinholeCamera().parameters();
  given.fy = 510;
  given.k1 = -0.2;
  given.k2 = 0.05;
  given.p1 = 1e-3;
  return given;
}

TEST(CalibrationTest, ChangesFocalLengthAndRadialDistortion) {
  const CameraParameters applied = ApplyCalibration(Given(), {std::log(1.02), 0.03, -0.01});
  EXPECT_DOUBLE_EQ(applied.fx, 510);
  EXPECT_DOUBLE_EQ(applied.fy, 520.2);
  EXPECT_DOUBLE_EQ(applied.k1, -0.17);
  EXPECT_DOUBLE_EQ(applied.k2, 0.04);
  EXPECT_EQ(applied.cx, Given().cx);
  EXPECT_EQ(ApplyCalibration(Given(), Calibration::Zero()), Given());
}

TEST(CalibrationTest, PixelDerivativeIsTheNumericOne) {
  test::Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d point(random.Uniform(-2, 2), random.Uniform(-1.5, 1.5), 4);
    const auto project = [&](const Calibration& calibration) {
      return *Camera(ApplyCalibration(Given(), calibration)).Project(point);
    };
    const auto expected = test::NumericJacobianAt<2, 3>(Calibration(0, 0, 0), project);
    EXPECT_THAT(PixelByCalibration(Given(), point.hnormalized(), project({0, 0, 0})),
                test::IsMatrixNear(expected, 1e-6));
  }
}

TEST(CalibrationTest, PriorAllowsAFewSigmas) {
  CalibrationOptions options;
  options.focal_sigma = 0.01;
  options.k1_sigma = 0.02;
  options.k2_sigma = 0.03;
  EXPECT_THAT(PriorEstimate(options).covariance.diagonal().eval(),
              test::IsMatrixNear(Eigen::Vector3d(1e-4, 4e-4, 9e-4), 1e-15));
  EXPECT_TRUE(IsWithinPrior({0.02, 0.04, -0.06}, options));
  EXPECT_FALSE(IsWithinPrior({0.05, 0, 0}, options));
  EXPECT_FALSE(IsWithinPrior({0, 0.06, 0.09}, options));
}

TEST(CalibrationTest, AsAPriorItMovesTheSameCamera) {
  const CalibrationOptions options;
  const CameraPrior prior = MakePrior(test::PinholeCamera().parameters(), options);
  const Calibration calibration(0.003, 0.02, -0.01);
  EXPECT_EQ(prior.Apply(calibration), ApplyCalibration(prior.given, calibration));
  EXPECT_EQ(prior.SquaredError(PriorSigmas(options)), 3);
}

}  // namespace
}  // namespace corvo
