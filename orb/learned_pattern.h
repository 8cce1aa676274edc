// SPDX-License-Identifier: MIT
#pragma once

#include "orb/pattern.h"

namespace corvo::orb {

/// The tests that `corvo learn` chose from photographs (see LearnPattern() and NOTICE).
Pattern LearnedPattern();

/// Like LearnedPattern(), but from photographs that are free for any use.
Pattern FreePattern();

}  // namespace corvo::orb
