// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "orb/pattern.h"

namespace corvo::orb {

// A pattern file has a line "px, py, qx, qy," for each test, in order, each coordinate -kMaxOffset
// to kMaxOffset; blank lines and lines that begin with // mean nothing. So it is also the
// initialiser of an array in C++.

/// Throws corvo::Error naming file, line and value where the file cannot be read, a line is no
/// test, a test's ends are not apart, two tests are equivalent, or there are not exactly kNumTests.
Pattern ReadPattern(const std::filesystem::path& file);

/// The text of a file that ReadPattern() reads back the same.
std::string PatternText(const Pattern& pattern);

/// The pattern of that name, "learned" (LearnedPattern) or "brief" (MakeBriefPattern), or else that
/// of the file. Throws corvo::Error as ReadPattern().
Pattern LoadPattern(const std::string& name_or_file);

}  // namespace corvo::orb
