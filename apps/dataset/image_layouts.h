// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "apps/dataset/image_source.h"

/// A pair of functions per dataset layout: one returns whether a folder has the layout, the other
/// lists its images. The latter throw corvo::Error with file, line and value if something is
/// missing or malformed.
namespace corvo {

/// The KITTI layout: `image_0` (or `image_2` of the color camera), `times.txt`, and `calib.txt`
/// with the projection matrix of that camera.
bool IsKittiSequence(const std::filesystem::path& input);
ImageList ListKittiImages(const std::filesystem::path& input);

/// The EuRoC layout: a `mav0` folder or its parent, with `cam0/data.csv`, `cam0/data`, and the
/// calibration in `cam0/sensor.yaml` (EuRoC) or in `dso/camchain.yaml` beside `mav0` (TUM-VI).
bool IsEurocSequence(const std::filesystem::path& input);
ImageList ListEurocImages(const std::filesystem::path& input);

/// The TUM RGB-D layout: `rgb.txt` with a timestamp in seconds and a file name per line. The
/// dataset has no calibration file.
bool IsTumSequence(const std::filesystem::path& input);
ImageList ListTumImages(const std::filesystem::path& input);

/// The TUM-mono layout: `times.txt` (per line: image name, timestamp in seconds, exposure),
/// `images`, `camera.txt`.
bool IsTumMonoSequence(const std::filesystem::path& input);
ImageList ListTumMonoImages(const std::filesystem::path& input);

/// Returns whether a path contains one of the shell's wildcards * ? [.
bool IsPattern(const std::filesystem::path& input);
/// Lists the images that a pattern matches, in natural order of their paths.
ImageList ListMatchingImages(const std::filesystem::path& pattern, double frame_rate_hz);

/// Lists the images of any folder, in natural order of their names.
ImageList ListFolderImages(const std::filesystem::path& input, double frame_rate_hz);

/// Returns whether a file has the extension png, jpg, jpeg, bmp, pgm, tif or tiff.
bool HasImageExtension(const std::filesystem::path& file);

/// Returns the image files of a folder, in natural order, without hidden ones and those that corvo
/// wrote.
std::vector<std::filesystem::path> ImageFilesIn(const std::filesystem::path& folder);

/// Returns whether `a` precedes `b` in natural order, in which runs of digits are compared as
/// numbers: "2.png" precedes "10.png".
bool NaturalLess(std::string_view a, std::string_view b);

}  // namespace corvo
