// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"
#include "tests/data/data_path.h"

namespace corvo::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Ne;

TEST(BillOfMaterials, NamesEveryLibraryOfTheCommandWithVersionAndLicense) {
  if (!std::filesystem::exists("/usr/bin/dpkg-query")) GTEST_SKIP() << "no Debian packages here";
  const CommandResult result =
      RunProgram("/bin/bash", {(SourceDir() / "scripts/make_sbom.sh").string(), CORVO_COMMAND},
                 {"PATH=/usr/bin:/bin", "SOURCE_DATE_EPOCH=0"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json bill = nlohmann::json::parse(result.out);
  EXPECT_EQ(bill.at("spdxVersion"), "SPDX-2.3");
  EXPECT_EQ(bill.at("creationInfo").at("created"), "1970-01-01T00:00:00Z");
  std::string libraries;
  for (const nlohmann::json& package : bill.at("packages")) {
    EXPECT_THAT(package.at("versionInfo"), Ne("unknown")) << package;
    EXPECT_THAT(package.at("licenseDeclared"), Ne("NOASSERTION")) << package;
    libraries += package.value("comment", "") + " " + package.at("name").get<std::string>() + "\n";
  }
  for (const char* name : {"libopencv_core.so", "libopencv_videoio.so", "libyaml-cpp.so",
                           "libc.so.6", "libceres-dev", "libeigen3-dev"}) {
    EXPECT_THAT(libraries, HasSubstr(name));
  }
  EXPECT_EQ(bill.at("relationships").size(), bill.at("packages").size());
}

}  // namespace
}  // namespace corvo::test
