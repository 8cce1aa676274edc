// SPDX-License-Identifier: MIT
#include "vo/camera/camera_plausibility.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"

namespace corvo {
namespace {

using test::ThrowsError;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A usual camera of 640 x 480 px, of which each test changes something.
class CameraPlausibility : public testing::Test {
 protected:
  void SetFocal(double focal_px) { camera_.fx = camera_.fy = focal_px; }
  void SetCenter(double cx, double cy) {
    camera_.cx = cx;
    camera_.cy = cy;
  }

  CameraParameters camera_{
      .width = 640, .height = 480, .fx = 520, .fy = 520, .cx = 319.5, .cy = 239.5};
};

TEST_F(CameraPlausibility, UsualCameraPasses) {
  EXPECT_NO_THROW(CheckPlausible(camera_));
  EXPECT_THAT(UnusualValues(camera_), IsEmpty());
  SetCenter(250, 300);  // Off by 11% of the width.
  EXPECT_THAT(UnusualValues(camera_), IsEmpty());
}

TEST_F(CameraPlausibility, RejectsAFocalLengthAsAShareOfTheImage) {
  camera_.fx = 0.81;
  camera_.fy = 1.08;
  SetCenter(0.5, 0.5);
  EXPECT_THAT([&] { CheckPlausible(camera_); },
              ThrowsError("camera.fx is 0.81; allowed is 5 px or more", "share of the image width",
                          "640 px"));
  camera_.fx = 520;
  EXPECT_THAT([&] { CheckPlausible(camera_); }, ThrowsError("camera.fy is 1.08", "height"));
}

TEST_F(CameraPlausibility, RejectsAPrincipalPointAtZeroOrOutsideOfTheImage) {
  SetCenter(0, 0);
  EXPECT_THAT([&] { CheckPlausible(camera_); },
              ThrowsError("camera.cx is 0; allowed is more than 0 and less than the image width, "
                          "640 px"));
  SetCenter(319.5, -20);
  EXPECT_THAT([&] { CheckPlausible(camera_); }, ThrowsError("camera.cy is -20", "480 px"));
  SetCenter(319.5, 480);
  EXPECT_THAT([&] { CheckPlausible(camera_); }, ThrowsError("camera.cy is 480", "480 px"));
  SetCenter(639.5, 479.5);
  EXPECT_NO_THROW(CheckPlausible(camera_)) << "inside of the image";
}

TEST_F(CameraPlausibility, NamesACalibrationOfImagesOfAnotherSize) {
  SetCenter(650, 470);
  EXPECT_THAT([&] { CheckPlausible(camera_); },
              ThrowsError("camera.cx is 650", "images of twice the size"));
  SetCenter(630, 470);
  EXPECT_THAT(UnusualValues(camera_), ElementsAre(HasSubstr("images of twice the size"),
                                                  HasSubstr("images of twice the size")));
  SetCenter(160, 120);
  EXPECT_THAT(UnusualValues(camera_),
              ElementsAre(AllOf(HasSubstr("camera.cx is 160 px, far from the center"),
                                HasSubstr("usual is 191.5 to 447.5 px"),
                                HasSubstr("images of half the size"))));
  SetCenter(160, 239.5);
  EXPECT_THAT(UnusualValues(camera_), ElementsAre(Not(HasSubstr("the size"))));
}

TEST_F(CameraPlausibility, NamesAFocalLengthThatIsTooShortOrTooLong) {
  SetFocal(26);  // A phone's, in mm of the full frame.
  EXPECT_THAT(UnusualValues(camera_),
              ElementsAre(AllOf(HasSubstr("camera.fx is 26 px, a horizontal field of view of 171"),
                                HasSubstr("usual is 5 to 150 degrees"), HasSubstr("in mm")),
                          HasSubstr("camera.fy is 26 px, a vertical field of view")));
  SetFocal(9000);
  EXPECT_THAT(UnusualValues(camera_), ElementsAre(HasSubstr("larger images"), testing::_));
  SetFocal(86);  // 149.9 degrees.
  EXPECT_THAT(UnusualValues(camera_), IsEmpty());
}

TEST_F(CameraPlausibility, FisheyeMaySeeMoreThanAPinhole) {
  SetFocal(110);  // 333 degrees along x if it were equidistant throughout.
  camera_.model = CameraModel::kKb4;
  EXPECT_THAT(UnusualValues(camera_), IsEmpty());
  SetFocal(26);
  EXPECT_THAT(UnusualValues(camera_),
              ElementsAre(HasSubstr("usual is 5 to 360 degrees"), testing::_));
  camera_.model = CameraModel::kFov;  // Its field of view depends on omega.
  EXPECT_THAT(UnusualValues(camera_), IsEmpty());
}

}  // namespace
}  // namespace corvo
