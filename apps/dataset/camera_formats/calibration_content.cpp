// SPDX-License-Identifier: MIT
#include "apps/dataset/camera_formats/calibration_content.h"

#include "apps/dataset/camera_formats/document.h"

namespace corvo {

CalibrationContent::CalibrationContent(std::string bytes, std::filesystem::path file)
    : file_(std::move(file)), bytes_(std::move(bytes)) {
  const std::string_view text = WithoutByteOrderMark(bytes_, file_.string());
  kind_ = text.find('\0') != std::string_view::npos ? Kind::kBinary
          : StartsLikeJson(text)                    ? Kind::kJson
          : StartsLikeXml(text)                     ? Kind::kXml
                                                    : Kind::kText;
}

std::string CalibrationContent::where() const { return file_.string() + ": "; }

const std::vector<TextLine>& CalibrationContent::lines() const {
  if (!lines_) {
    lines_.emplace();
    if (kind_ == Kind::kText) *lines_ = ParseTextLines(bytes_, file_);
  }
  return *lines_;
}

const YAML::Node& CalibrationContent::root() const {
  if (!root_) {
    const YAML::Node root =
        is_binary() ? YAML::Node(YAML::NodeType::Null) : ParseDocument(bytes_, file_);
    root_ = root.IsMap() ? root : YAML::Node(YAML::NodeType::Null);
  }
  return *root_;
}

std::vector<std::string> CalibrationFields(const TextLine& line) {
  constexpr std::size_t kMaxLength = 2000;
  return line.text.size() > kMaxLength ? std::vector<std::string>() : SplitFields(line.text);
}

}  // namespace corvo
