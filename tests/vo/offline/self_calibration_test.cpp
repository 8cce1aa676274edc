// SPDX-License-Identifier: MIT
#include "vo/offline/self_calibration.h"

#include <gmock/gmock.h>

#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/vo/two_walls.h"

namespace corvo {
namespace {

/// Images at intervals of a tenth of a second.
class ImagesInMemory : public ImageStream {
 public:
  explicit ImagesInMemory(std::vector<cv::Mat> images) : images_(std::move(images)) {}

  std::optional<StreamImage> Next() override {
    if (next_ == images_.size()) return std::nullopt;
    const TimeNs time_ns = 100'000'000 * static_cast<TimeNs>(next_);
    return StreamImage{images_[next_++], time_ns, {}, {}};
  }
  bool Skip() override { return Next().has_value(); }

 private:
  std::vector<cv::Mat> images_;
  std::size_t next_ = 0;
};

TEST(FindCameraTest, PassesWithAFixedCameraAreAsManyAsAllowedAndOneVerifies) {
  SelfCalibrationOptions options;
  options.max_rounds = 1;
  options.image_pairs.max_pairs = 2;
  options.focal_search.num_coarse = 9;
  std::set<int> passes;
  const auto open = [] { return std::make_unique<ImagesInMemory>(test::MakeDrive(12, 1)); };
  EXPECT_TRUE(FindCamera(open, options, [&](const CalibrationStep& step) {
    if (step.stage == CalibrationStep::Stage::kTracking) passes.insert(step.round);
    return true;
  }));
  EXPECT_EQ(passes, (std::set<int>{1, 2}));
}

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
  options.max_focal_sigma = 0.05;  // Less than the least.
  EXPECT_THAT(
      [&] {
        StatedFocalPrior(520, {640, 480}, options);
      },
      test::ThrowsError("self_calibration.max_focal_sigma is 0.05", "0.1 to 10"));
}

}  // namespace
}  // namespace corvo
