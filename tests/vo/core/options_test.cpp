// SPDX-License-Identifier: MIT
#include "vo/core/options.h"

#include <gmock/gmock.h>

#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/support/matchers.h"
#include "vo/core/option_fields.h"

namespace corvo {
namespace {

using test::ThrowsError;

/// Sets every number in turn just outside its range and expects Validate() to name it.
struct RangeBreaker {
  OdometryOptions& options;
  std::string section;

  template <typename T>
  void operator()(const char* name, T& value, const std::type_identity_t<T>& min,
                  const std::type_identity_t<T>& max, const char*) const {
    const T before = value;
    for (const T& outside : {Below(min), Above(max)}) {
      value = outside;
      EXPECT_THAT([this] { options.Validate(); }, ThrowsError(section + "." + name + " is "));
    }
    value = before;
  }

  template <typename T>
  void operator()(const char*, T&, const char*) const {}

  static double Below(double x) { return x - 1e-3; }
  static double Above(double x) { return x + 1e-3; }
  static int Below(int x) { return x - 1; }
  static int Above(int x) { return x + 1; }
};

TEST(OptionsTest, DefaultsAreValid) { EXPECT_NO_THROW(OdometryOptions().Validate()); }

TEST(OptionsTest, EveryNumberOutOfRangeIsNamedWithItsSection) {
  OdometryOptions options;
  OdometryOptions::VisitSections(options, [&](const char* name, auto& fields) {
    VisitAllFields(fields, RangeBreaker{options, name});
  });
  EXPECT_NO_THROW(options.Validate());
}

TEST(OptionsTest, NanIsOutOfRange) {
  OdometryOptions options;
  options.extractor.scale_factor = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { options.Validate(); }, ThrowsError("extractor.scale_factor is nan"));
}

TEST(OptionsTest, FieldsThatContradictEachOtherAreNamedWithTheirSection) {
  OdometryOptions options;
  options.extractor.fast_threshold = 20;
  options.extractor.min_fast_threshold = 21;
  EXPECT_THAT([&] { options.Validate(); },
              ThrowsError("extractor.min_fast_threshold is 21", "1 to 20"));
}

}  // namespace
}  // namespace corvo
