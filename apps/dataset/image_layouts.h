// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "apps/dataset/image_source.h"

/// One pair of functions a layout: whether a folder has it, and its list of images. Both look
/// only at `input`; what is missing or malformed is a corvo::Error naming file, line and value.
namespace corvo {

/// `image_0` (or the color camera's `image_2`), `times.txt`, and `calib.txt` with that camera's
/// projection matrix.
bool IsKittiSequence(const std::filesystem::path& input);
ImageList ListKittiImages(const std::filesystem::path& input);

/// A `mav0` folder, or the one that holds it: `cam0/data.csv`, `cam0/data`, and the calibration in
/// `cam0/sensor.yaml` (EuRoC) or `dso/camchain.yaml` beside `mav0` (TUM-VI).
bool IsEurocSequence(const std::filesystem::path& input);
ImageList ListEurocImages(const std::filesystem::path& input);

/// `rgb.txt`: a time in seconds and a file name a line. The dataset ships no calibration.
bool IsTumSequence(const std::filesystem::path& input);
ImageList ListTumImages(const std::filesystem::path& input);

/// `times.txt` (an image's name, its time in seconds, its exposure a line), `images`,
/// `camera.txt`.
bool IsTumMonoSequence(const std::filesystem::path& input);
ImageList ListTumMonoImages(const std::filesystem::path& input);

/// Whether a path has one of the wildcards * ? [ of a shell's pattern.
bool IsPattern(const std::filesystem::path& input);
/// The images that a pattern matches, ordered by path with numbers compared as numbers.
ImageList ListMatchingImages(const std::filesystem::path& pattern, double frame_rate_hz);

/// Any folder of images, ordered by name with numbers compared as numbers.
ImageList ListFolderImages(const std::filesystem::path& input, double frame_rate_hz);

/// Whether a file's name ends as an image's: png, jpg, jpeg, bmp, pgm, tif or tiff.
bool HasImageExtension(const std::filesystem::path& file);

/// The image files of a folder, in natural order.
std::vector<std::filesystem::path> ImageFilesIn(const std::filesystem::path& folder);

/// Whether `a` comes before `b` with runs of digits compared as numbers: "2.png" before "10.png".
bool NaturalLess(std::string_view a, std::string_view b);

}  // namespace corvo
