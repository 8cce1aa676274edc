// SPDX-License-Identifier: MIT
#include "vo/io/decimal_time.h"

#include <gmock/gmock.h>

#include <string>

#include "tests/support/matchers.h"

namespace corvo {
namespace {

using test::ThrowsError;

TEST(ParseSeconds, KeepsEveryDecimalOfLargeTimes) {
  EXPECT_EQ(ParseSeconds("1305031229.528748", ""), 1305031229528748000);
  EXPECT_EQ(ParseSeconds("1403636579.763555584", ""), 1403636579763555584);
}

TEST(ParseSeconds, ReadsExponents) {
  EXPECT_EQ(ParseSeconds("0.000000e+00", ""), 0);
  EXPECT_EQ(ParseSeconds("1.000000e-01", ""), 100000000);
  EXPECT_EQ(ParseSeconds("2.990000e+01", ""), 29900000000);
  EXPECT_EQ(ParseSeconds("1E3", ""), 1000000000000);
}

TEST(ParseSeconds, RoundsToNanoseconds) {
  EXPECT_EQ(ParseSeconds("0.0000000014", ""), 1);
  EXPECT_EQ(ParseSeconds("0.0000000015", ""), 2);
  EXPECT_EQ(ParseSeconds("1e-12", ""), 0);
}

TEST(ParseSeconds, ReadsSigns) {
  EXPECT_EQ(ParseSeconds("-1.5", ""), -1500000000);
  EXPECT_EQ(ParseSeconds("+.5", ""), 500000000);
}

TEST(ParseSeconds, RejectsInvalidTimes) {
  for (const char* text : {"", "abc", "1.2.3", "1e", "1e999", "nan", "inf", "0x10", "1 2", "-",
                           "99999999999999999999"}) {
    EXPECT_THAT([&] { ParseSeconds(text, "times.txt:7: "); },
                ThrowsError("times.txt:7: '" + std::string(text) + "'"));
  }
}

TEST(ParseSeconds, RejectsWhatRoundingMakesTooLarge) {
  EXPECT_EQ(ParseSeconds("9223372036.8547758074", ""), 9223372036854775807);
  EXPECT_EQ(ParseSeconds("-9223372036.8547758074", ""), -9223372036854775807);
  for (const char* text : {"9223372036.8547758075", "-9223372036.8547758075", "9223372036.9"}) {
    EXPECT_THAT([&] { ParseSeconds(text, "t: "); }, ThrowsError("t: ", text)) << text;
  }
}

TEST(GuessTimeUnit, FollowsTheMagnitude) {
  EXPECT_EQ(GuessTimeUnit("1305031229.528748"), TimeUnit::kSeconds);
  EXPECT_EQ(GuessTimeUnit("0.05"), TimeUnit::kSeconds);
  EXPECT_EQ(GuessTimeUnit("0000000000000000000012.5"), TimeUnit::kSeconds);
  EXPECT_EQ(GuessTimeUnit("1305031229528.748"), TimeUnit::kMilliseconds);
  EXPECT_EQ(GuessTimeUnit("1305031229528748"), TimeUnit::kMicroseconds);
  EXPECT_EQ(GuessTimeUnit("1403636579763555584"), TimeUnit::kNanoseconds);
  EXPECT_EQ(GuessTimeUnit("1.403636579763555584e+18"), TimeUnit::kNanoseconds);
  EXPECT_EQ(GuessTimeUnit("name"), TimeUnit::kSeconds);
  EXPECT_EQ(GuessTimeUnit("99999999999.9"), TimeUnit::kSeconds);
  EXPECT_EQ(GuessTimeUnit("100000000000"), TimeUnit::kMilliseconds);
  EXPECT_EQ(GuessTimeUnit("99999999999999"), TimeUnit::kMilliseconds);
  EXPECT_EQ(GuessTimeUnit("100000000000000"), TimeUnit::kMicroseconds);
  EXPECT_EQ(GuessTimeUnit("99999999999999999"), TimeUnit::kMicroseconds);
  EXPECT_EQ(GuessTimeUnit("100000000000000000"), TimeUnit::kNanoseconds);
  EXPECT_EQ(GuessEurocTimeUnit("33333333"), TimeUnit::kNanoseconds);
  EXPECT_EQ(GuessEurocTimeUnit("1403636579.763"), TimeUnit::kSeconds);
}

TEST(FormatSeconds, HasNineDecimalsAndIsReadBackExactly) {
  EXPECT_EQ(FormatSeconds(0), "0.000000000");
  EXPECT_EQ(FormatSeconds(-500000000), "-0.500000000");
  EXPECT_EQ(FormatSeconds(1403636579763555584), "1403636579.763555584");
  for (const TimeNs time_ns : {-1LL, 1LL, 999999999LL, -1000000001LL, 9223372036854775807LL}) {
    EXPECT_EQ(ParseSeconds(FormatSeconds(time_ns), ""), time_ns);
  }
}

TEST(ParseNanoseconds, IsExact) {
  EXPECT_EQ(ParseNanoseconds("1403636579763555584", ""), 1403636579763555584);
  EXPECT_EQ(ParseNanoseconds("1.403636579763555584e+18", ""), 1403636579763555584);
  EXPECT_EQ(ParseNanoseconds("1.5", ""), 2);
  EXPECT_THAT([] { ParseNanoseconds("1e19", "t: "); }, ThrowsError("t: '1e19'", "nanoseconds"));
  EXPECT_THAT([] { ParseNanoseconds("a.png", "t: "); }, ThrowsError("t: 'a.png'"));
  EXPECT_THAT([] { ParseNanoseconds("", "t: "); }, ThrowsError("t: ''"));
}

}  // namespace
}  // namespace corvo
