// SPDX-License-Identifier: MIT
#pragma once

// This header provides corvo's features as a cv::Feature2D, and conversions from and to OpenCV's
// types. It is header-only, so that corvo::orb does not depend on OpenCV's features2d; the CMake
// target is corvo::opencv.

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "orb/error.h"
#include "orb/extractor.h"
#include "orb/types.h"

namespace corvo::orb {

/// The side of the patch that a descriptor covers, px of its level; equal to cv::ORB's.
inline constexpr int kPatchSize = 31;

/// Converts keypoints to OpenCV's type. `octave_scales` are the extractor's: a keypoint's size is
/// kPatchSize times the scale of its octave. Angles and coordinates have the same meaning in both
/// types. Throws corvo::Error if an octave has no scale.
inline std::vector<cv::KeyPoint> ToKeyPoints(std::span<const Keypoint> keypoints,
                                             std::span<const double> octave_scales) {
  std::vector<cv::KeyPoint> converted;
  converted.reserve(keypoints.size());
  for (const Keypoint& keypoint : keypoints) {
    CheckRange("octave", keypoint.octave, 0, static_cast<int>(octave_scales.size()) - 1);
    const auto size = static_cast<float>(kPatchSize * octave_scales[keypoint.octave]);
    converted.emplace_back(keypoint.x, keypoint.y, size, keypoint.angle_deg, keypoint.response,
                           keypoint.octave);
  }
  return converted;
}

/// Converts keypoints from OpenCV's type, without their sizes and class ids.
inline std::vector<Keypoint> FromKeyPoints(std::span<const cv::KeyPoint> keypoints) {
  std::vector<Keypoint> converted;
  converted.reserve(keypoints.size());
  for (const cv::KeyPoint& keypoint : keypoints) {
    converted.push_back(
        {keypoint.pt.x, keypoint.pt.y, keypoint.angle, keypoint.response, keypoint.octave});
  }
  return converted;
}

/// Returns one row of 32 bytes (CV_8UC1) for each descriptor, the format of OpenCV's matchers, or
/// an empty matrix if there are none.
inline cv::Mat ToDescriptorMat(std::span<const Descriptor> descriptors) {
  if (descriptors.empty()) return {};
  cv::Mat rows(static_cast<int>(descriptors.size()), sizeof(Descriptor::bytes), CV_8UC1);
  for (int i = 0; i < rows.rows; ++i) {
    std::memcpy(rows.ptr(i), descriptors[i].bytes.data(), sizeof(Descriptor::bytes));
  }
  return rows;
}

/// Converts a matrix of the form that ToDescriptorMat() returns back to descriptors. Throws
/// corvo::Error if the matrix is neither empty nor of that form.
inline std::vector<Descriptor> FromDescriptorMat(const cv::Mat& rows) {
  if (rows.empty()) return {};
  if (rows.type() != CV_8UC1 || rows.cols != static_cast<int>(sizeof(Descriptor::bytes))) {
    throw Error("descriptors have " + std::to_string(rows.cols) + " columns of OpenCV type " +
                std::to_string(rows.type()) + "; allowed is 32 of CV_8UC1");
  }
  std::vector<Descriptor> descriptors(rows.rows);
  for (int i = 0; i < rows.rows; ++i) {
    std::memcpy(descriptors[i].bytes.data(), rows.ptr(i), sizeof(Descriptor::bytes));
  }
  return descriptors;
}

/// Adapts Extractor to OpenCV's interface, which documents the functions; create it with
/// CreateFeature2D(). Images are 8-bit: gray, BGR or BGRA. Like cv::ORB, it removes given keypoints
/// that cannot be described (see Extractor::Describe()) and applies a mask to detection only. An
/// empty image has no features. Throws cv::Exception on bad input, like OpenCV's own features. One
/// object may be used by several threads at once.
class Feature2DAdaptor final : public cv::Feature2D {
 public:
  Feature2DAdaptor(const ExtractorOptions& options, int threads) : extractor_(options, threads) {}

  void detectAndCompute(cv::InputArray image, cv::InputArray mask,
                        std::vector<cv::KeyPoint>& keypoints, cv::OutputArray descriptors,
                        bool use_provided_keypoints = false) override {
    try {
      const cv::Mat gray = ToGray(image.getMat());
      const Features features =
          use_provided_keypoints ? Describe(gray, keypoints) : Detect(gray, mask, keypoints);
      if (!descriptors.needed()) return;
      ToDescriptorMat(features.descriptors).copyTo(descriptors);
    } catch (const Error& error) {
      CV_Error(cv::Error::StsBadArg, error.what());
    }
  }

  int descriptorSize() const override { return sizeof(Descriptor::bytes); }
  int descriptorType() const override { return CV_8U; }
  int defaultNorm() const override { return cv::NORM_HAMMING; }
  bool empty() const override { return false; }
  cv::String getDefaultName() const override { return "Feature2D.corvo"; }

 private:
  static cv::Mat ToGray(const cv::Mat& image) {
    if (image.empty() || image.type() == CV_8UC1) return image;
    cv::Mat gray;
    if (image.type() == CV_8UC3) {
      cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
    } else if (image.type() == CV_8UC4) {
      cv::cvtColor(image, gray, cv::COLOR_BGRA2GRAY);
    } else {
      throw Error("image has OpenCV type " + std::to_string(image.type()) +
                  "; allowed is 8-bit gray (CV_8UC1), BGR (CV_8UC3) or BGRA (CV_8UC4)");
    }
    return gray;
  }

  Features Detect(const cv::Mat& gray, cv::InputArray mask,
                  std::vector<cv::KeyPoint>& keypoints) const {
    Features features;
    if (!gray.empty()) features = extractor_.Extract(gray, mask.getMat());
    keypoints = ToKeyPoints(features.keypoints, extractor_.octave_scales());
    return features;
  }

  /// Removes the keypoints that cannot be described from `keypoints` and returns the features of
  /// the others, in order.
  Features Describe(const cv::Mat& gray, std::vector<cv::KeyPoint>& keypoints) const {
    DescribedKeypoints described;
    if (!gray.empty()) described = extractor_.Describe(gray, FromKeyPoints(keypoints));
    std::vector<cv::KeyPoint> kept;
    for (std::size_t i = 0; i < described.indices.size(); ++i) {
      kept.push_back(keypoints[described.indices[i]]);
      kept.back().angle = described.features.keypoints[i].angle_deg;
    }
    keypoints = kept;
    return described.features;
  }

  Extractor extractor_;
};

/// Creates a cv::Feature2D that extracts corvo's features, processing up to `threads` levels in
/// parallel; the features do not depend on `threads`. Throws corvo::Error if the options are out of
/// range.
inline cv::Ptr<cv::Feature2D> CreateFeature2D(const ExtractorOptions& options, int threads = 1) {
  return cv::makePtr<Feature2DAdaptor>(options, threads);
}

/// Like cv::ORB::create(num_features), but with corvo's defaults: keypoints are spread over a grid.
/// 0 stands for 1000, or 2000 for images whose longer side has at least 900 px.
inline cv::Ptr<cv::Feature2D> CreateFeature2D(int num_features = 0) {
  ExtractorOptions options;
  options.num_features = num_features;
  return CreateFeature2D(options);
}

}  // namespace corvo::orb
