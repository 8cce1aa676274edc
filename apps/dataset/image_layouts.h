// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "apps/dataset/image_files.h"
#include "apps/dataset/image_list.h"

/// A pair of functions per dataset layout: one returns whether a folder has the layout, the other
/// lists its images. The latter throw corvo::Error with file, line and value if something is
/// missing or malformed.
namespace corvo {

/// The KITTI layout: `image_0` (or `image_2`, `image_1`, `image_3`), `times.txt`, and `calib.txt`
/// with the projection matrix of that camera. Without `times.txt`, images get index / frame rate.
bool IsKittiSequence(const std::filesystem::path& input);
ImageList ListKittiImages(const std::filesystem::path& input, const InputOptions& options);

/// The layout of KITTI's raw data: a drive with `image_00` (or `image_02`, `image_01`, `image_03`),
/// or that folder, or its `data`, with `timestamps.txt` beside it, and the calibration in
/// `calib_cam_to_cam.txt` beside the drive.
bool IsKittiRawSequence(const std::filesystem::path& input);
ImageList ListKittiRawImages(const std::filesystem::path& input, const InputOptions& options);

/// The EuRoC layout: a `mav0` folder, its parent, or one of its camera folders, of which `cam0`
/// precedes `cam1`. It has the images in `data`, listed in `data.csv` or else with their times in
/// ns as names, and the calibration in `sensor.yaml` (EuRoC) or in `dso/camchain.yaml` beside
/// `mav0` (TUM-VI).
bool IsEurocSequence(const std::filesystem::path& input);
ImageList ListEurocImages(const std::filesystem::path& input, const InputOptions& options);

/// The TUM RGB-D layout: `rgb.txt` with a timestamp in seconds and a file name per line, or else
/// `associations.txt`, which has those of a depth image in the same line before or behind (also
/// ICL-NUIM). The dataset has no calibration file.
bool IsTumSequence(const std::filesystem::path& input);
ImageList ListTumImages(const std::filesystem::path& input);

/// The TUM-mono layout: `times.txt` (per line: image name, timestamp in seconds, exposure),
/// `images`, `camera.txt`.
bool IsTumMonoSequence(const std::filesystem::path& input);
ImageList ListTumMonoImages(const std::filesystem::path& input, const InputOptions& options);

/// The TartanAir layout: `image_left` and `pose_left.txt`. All its sequences have the same camera.
bool IsTartanAirSequence(const std::filesystem::path& input);
ImageList ListTartanAirImages(const std::filesystem::path& input, const InputOptions& options);

/// The ground truth of a TartanAir sequence.
inline constexpr const char* kTartanAirPoses = "pose_left.txt";

/// Returns whether a path contains one of the shell's wildcards * ? [.
bool IsPattern(const std::filesystem::path& input);
/// Lists the images that a pattern matches, in natural order of their paths. Wildcards in the names
/// of existing folders are ordinary characters.
ImageList ListMatchingImages(const std::filesystem::path& pattern, const InputOptions& options);

/// Lists the images of any folder, or else of its only subfolder with images, in natural order of
/// their names.
ImageList ListFolderImages(const std::filesystem::path& input, const InputOptions& options);

/// Appends images with their times, one for each.
void AddTimedImages(const std::vector<std::filesystem::path>& files,
                    const std::vector<TimeNs>& times, ImageList& list);

/// Throws corvo::Error with the names and both numbers unless a file of times has as many as there
/// are images in a folder.
void CheckNumTimes(const std::filesystem::path& times_file, std::size_t num_times,
                   const std::filesystem::path& image_folder, std::size_t num_images);

/// Appends images with the times index / frame rate.
void AddIndexTimes(const std::vector<std::filesystem::path>& files, const InputOptions& options,
                   ImageList& list);

}  // namespace corvo
