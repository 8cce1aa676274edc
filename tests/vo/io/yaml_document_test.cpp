// SPDX-License-Identifier: MIT
#include "vo/io/yaml_document.h"

#include <gmock/gmock.h>

#include <random>

#include "orb/error.h"
#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

using test::ThrowsError;

/// YAML::LoadAll() needs unbounded memory for most of these texts.
TEST(ParseYaml, EndsForMisplacedIndicators) {
  for (const char* text : {"&a,", "!t,", "[1,2],", "{a: 1},", "\"a\",", ",", "]", "}"}) {
    EXPECT_THAT([&] { ParseYaml(text, "a.yaml"); }, ThrowsError("a.yaml:1:")) << text;
  }
  for (const char* text : {"*a,", "[&a,", "? ,", "a: ]", "a: b: c", "a\n,b: c"}) {
    try {
      ParseYaml(text, "a.yaml");
    } catch (const Error&) {  // What counts is that it ends.
    }
  }
}

TEST(ParseYaml, EndsForRandomIndicators) {
  constexpr std::string_view kAlphabet = "&*!a,[]{}: -?|>\n#\"%@`'";
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    const std::size_t size = 1 + random() % 10;
    for (std::size_t k = 0; k < size; ++k) text += kAlphabet[random() % kAlphabet.size()];
    try {
      ParseYaml(text, "a.yaml");
    } catch (const Error&) {
    }
  }
}

TEST(ParseYaml, ReadsOneDocument) {
  EXPECT_EQ(ParseYaml("a: 1\n", "")["a"].as<int>(), 1);
  EXPECT_EQ(ParseYaml("\xEF\xBB\xBF"
                      "a: !!opencv-matrix\n  rows: 1\n",
                      "")["a"]["rows"]
                .as<int>(),
            1);
  EXPECT_TRUE(ParseYaml("", "").IsNull());
  EXPECT_THAT([] { ParseYaml("a: 1\n---\nb: 1\n", "a.yaml"); },
              ThrowsError("a.yaml:", "more than one document"));
}

TEST(ReadYaml, RejectsLargeFiles) {
  const test::TemporaryFolder dir;
  const auto file = dir.Write("a.yaml", std::string(kMaxYamlBytes + 1, '#'));
  EXPECT_THAT([&] { ReadYaml(file); }, ThrowsError("a.yaml: has more than 1048576 bytes"));
  EXPECT_THAT([] { ReadYaml("/dev/zero"); }, ThrowsError("/dev/zero: has more than 1048576"));
}

}  // namespace
}  // namespace corvo
