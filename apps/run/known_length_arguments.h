// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vo/offline/known_lengths.h"

namespace corvo {

/// Reads a known distance from "FRAME,FRAME,METERS". Throws corvo::Error if it is malformed.
KnownDistance ParseKnownDistance(const std::string& text);

/// Reads the ends of an object, in two or more frames, and its size from
/// "FRAME,X,Y,X,Y,FRAME,X,Y,X,Y,METERS". Throws corvo::Error if it is malformed.
KnownSize ParseKnownSize(const std::string& text);

}  // namespace corvo
