// SPDX-License-Identifier: MIT
#include "apps/run/stated_focal.h"

#include <cmath>

#include "tests/cli/expect_error.h"

namespace corvo {
namespace {

using test::ErrorOf;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(StatedFocal, IsTheNumberOrFollowsFromTheFieldOfView) {
  EXPECT_EQ(StatedFocal("520.5", std::nullopt, 640), 520.5);
  EXPECT_NEAR(StatedFocal("", 90, 640).value(), 320, 1e-9);
  EXPECT_NEAR(StatedFocal("", 60, 640).value(), 320 * std::sqrt(3), 1e-9);
}

TEST(StatedFocal, IsNoneWithoutANumber) {
  EXPECT_FALSE(StatedFocal("", std::nullopt, 640));
  EXPECT_FALSE(StatedFocal("auto", std::nullopt, 640));
}

TEST(StatedFocal, ErrorNamesTheValueAndTheRangeForTheWidth) {
  EXPECT_THAT(ErrorOf([] { StatedFocal("26", std::nullopt, 640); }),
              AllOf(HasSubstr("--focal is 26; allowed is 85.7 to 7329.2 px"),
                    HasSubstr("640 px of width"), HasSubstr("150 to 5 degrees")));
  EXPECT_THAT(ErrorOf([] { StatedFocal("8000", std::nullopt, 640); }),
              HasSubstr("--focal is 8000"));
  EXPECT_EQ(StatedFocal("8000", std::nullopt, 1280), 8000);
}

TEST(StatedFocal, TextIsAutoOrANumber) {
  EXPECT_NO_THROW(CheckFocalText("auto"));
  EXPECT_NO_THROW(CheckFocalText("520.5"));
  for (const char* text : {"wide", "520px", "", "nan"}) {
    EXPECT_THAT(ErrorOf([&] { CheckFocalText(text); }), HasSubstr("--focal is \"")) << text;
  }
}

}  // namespace
}  // namespace corvo
