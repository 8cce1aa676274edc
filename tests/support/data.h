// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/data/data_path.h"
#include "tests/data/temporary_folder.h"

namespace corvo::test {

/// Returns whether missing data is a failure, which is so if $CI is set, rather than a skip.
bool DataIsRequired();

/// Returns whether $CORVO_SHORT_TESTS is set, as for the sanitizers: sequences are then cut short
/// and their accuracy is not judged.
bool IsShortRun();

/// Returns the contents of a file. Fails the test if it cannot be read.
std::string ReadText(const std::filesystem::path& path);

}  // namespace corvo::test

/// The first statement of a test that would take minutes under the sanitizers and whose code is
/// covered by other tests as well.
#define CORVO_SKIP_IF_SHORT()                                                    \
  do {                                                                           \
    if (::corvo::test::IsShortRun()) GTEST_SKIP() << "too long for a short run"; \
  } while (false)

/// The first statement of a test that reads real images: CORVO_REQUIRE_DATA("kitti/sequences/03");
#define CORVO_REQUIRE_DATA(relative)                                                      \
  do {                                                                                    \
    const std::filesystem::path corvo_data_path = ::corvo::test::DataPath(relative);      \
    if (std::filesystem::exists(corvo_data_path)) break;                                  \
    if (::corvo::test::DataIsRequired()) FAIL() << "no test data at " << corvo_data_path; \
    GTEST_SKIP() << "no test data at " << corvo_data_path;                                \
  } while (false)
