// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "orb/pattern.h"

namespace corvo::orb {

// A pattern file has a line "px, py, qx, qy," for each test, in order, each coordinate -kMaxOffset
// to kMaxOffset; blank lines and lines that begin with // are ignored. The file is therefore also a
// valid array initializer in C++.

/// Reads a pattern file. Throws corvo::Error with file, line and value if the file cannot be read,
/// a line is not a test, a test's ends are not apart, two tests are equivalent, or there are not
/// exactly kNumTests tests.
Pattern ReadPattern(const std::filesystem::path& file);

/// Returns the text of a file that ReadPattern() reads back as an equal pattern.
std::string PatternText(const Pattern& pattern);

/// Returns the pattern named "learned" (LearnedPattern()), "free" (FreePattern()) or "brief"
/// (MakeBriefPattern()), or the pattern in the file with any other name. Throws corvo::Error under
/// the conditions of ReadPattern().
Pattern LoadPattern(const std::string& name_or_file);

}  // namespace corvo::orb
