// SPDX-License-Identifier: MIT
#include "vo/offline/self_calibration.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"

namespace corvo {
namespace {

TEST(StatedFocalPriorTest, IsACenteredPinholeWithAnUncertainFocalLength) {
  SelfCalibrationOptions options;
  options.stated_focal_sigma = 0.04;
  const CameraPrior prior = StatedFocalPrior(520, {640, 480}, options);
  EXPECT_EQ(prior.given,
            (CameraParameters{
                .width = 640, .height = 480, .fx = 520, .fy = 520, .cx = 319.5, .cy = 239.5}));
  const std::vector<FreeParameter> expected = {{"focal", 0.04},
                                               {"cx", 640 * options.center_sigma_share},
                                               {"cy", 640 * options.center_sigma_share},
                                               {"k1", options.stated_k1_sigma},
                                               {"k2", options.stated_k2_sigma}};
  EXPECT_EQ(prior.free, expected);
  EXPECT_NO_THROW(prior.Validate());
}

TEST(StatedFocalPriorTest, RejectsValuesOutOfRange) {
  EXPECT_THAT([] { StatedFocalPrior(0, {640, 480}); }, test::ThrowsError("camera.fx is 0"));
  SelfCalibrationOptions options;
  options.stated_focal_sigma = 0;
  EXPECT_THAT(
      [&] {
        StatedFocalPrior(520, {640, 480}, options);
      },
      test::ThrowsError("self_calibration.stated_focal_sigma is 0"));
  options = {};
  options.max_focal_sigma = 15;
  EXPECT_THAT(
      [&] {
        StatedFocalPrior(520, {640, 480}, options);
      },
      test::ThrowsError("self_calibration.max_focal_sigma is 15"));
}

}  // namespace
}  // namespace corvo
