#include "apps/decimal_time.h"

#include "tests/cli/expect_error.h"

namespace corvo {
namespace {

using ::testing::HasSubstr;

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

TEST(ParseSeconds, RoundsBeyondNanoseconds) {
  EXPECT_EQ(ParseSeconds("0.0000000014", ""), 1);
  EXPECT_EQ(ParseSeconds("0.0000000015", ""), 2);
  EXPECT_EQ(ParseSeconds("1e-12", ""), 0);
}

TEST(ParseSeconds, ReadsSigns) {
  EXPECT_EQ(ParseSeconds("-1.5", ""), -1500000000);
  EXPECT_EQ(ParseSeconds("+.5", ""), 500000000);
}

TEST(ParseSeconds, RejectsWhatIsNoTime) {
  for (const char* text : {"", "abc", "1.2.3", "1e", "1e999", "nan", "inf", "0x10", "1 2", "-",
                           "99999999999999999999"}) {
    EXPECT_THAT(test::ErrorOf([&] { ParseSeconds(text, "times.txt:7: "); }),
                HasSubstr("times.txt:7: '" + std::string(text) + "'"));
  }
}

TEST(ParseNanoseconds, IsExact) {
  EXPECT_EQ(ParseNanoseconds("1403636579763555584", ""), 1403636579763555584);
  test::ErrorOf([] { ParseNanoseconds("1.5", ""); });
  test::ErrorOf([] { ParseNanoseconds("", ""); });
}

}  // namespace
}  // namespace corvo
