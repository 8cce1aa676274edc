#pragma once

#include <limits>
#include <string>

#include "apps/dataset/image_source.h"
#include "apps/run/interruption.h"
#include "vo/odometry.h"

namespace corvo {

/// Gives an odometry the images of a sequence that is prepared, at most so many of them, under a
/// bar with this text, and ends it. Throws corvo::Error and Interrupted.
void PassThrough(ImageSource source, const std::string& text, const Interruption& interruption,
                 Odometry& odometry, int max_images = std::numeric_limits<int>::max());

}  // namespace corvo
