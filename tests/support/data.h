// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/data/data_path.h"

namespace corvo::test {

/// Returns whether missing data is a failure, which is so if $CI is set, rather than a skip.
bool DataIsRequired();

/// Returns whether $CORVO_SHORT_TESTS is set, as for the sanitizers: sequences are then cut short
/// and their accuracy is not judged.
bool IsShortRun();

/// An empty folder for one test's files, removed with the object.
class TemporaryDir {
 public:
  TemporaryDir();
  ~TemporaryDir();
  TemporaryDir(const TemporaryDir&) = delete;
  TemporaryDir& operator=(const TemporaryDir&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes a file into the folder and returns its path.
  std::filesystem::path Write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

/// Returns the contents of a file. Fails the test if it cannot be read.
std::string ReadFile(const std::filesystem::path& path);

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
