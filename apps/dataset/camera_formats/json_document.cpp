// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/dataset/camera_formats/document.h"
#include "orb/error.h"

namespace corvo {
namespace {

using nlohmann::json;
using Event = json::parse_event_t;

/// Decides while JSON is parsed what of it is kept: all but the poses of a reconstruction, which
/// may be large and are not needed. Throws corvo::Error if it is more than a camera has.
class JsonFilter {
 public:
  explicit JsonFilter(const std::filesystem::path& file) : file_(file) {}

  bool Keep(int depth, Event event, const json& parsed) {
    if (event == Event::key && depth == 1) is_in_frames_ = parsed == "frames";
    if (!is_in_frames_) ++num_values_;
    if (num_values_ > kMaxDocumentNodes || depth > kMaxDocumentDepth) {
      throw Error(fmt::format("{}: holds more than a camera: too many or too deeply nested values",
                              file_.string()));
    }
    const bool is_root = depth == 0;
    return is_root || !is_in_frames_;
  }

 private:
  std::filesystem::path file_;
  int num_values_ = 0;
  bool is_in_frames_ = false;  ///< Whether the current key of the top level is "frames".
};

/// Makes YAML's nodes from those of JSON.
YAML::Node Convert(const json& value) {
  if (value.is_null()) return YAML::Node(YAML::NodeType::Null);
  if (value.is_string()) return YAML::Node(value.get<std::string>());
  if (!value.is_structured()) return YAML::Node(value.dump());
  YAML::Node node(value.is_object() ? YAML::NodeType::Map : YAML::NodeType::Sequence);
  for (const auto& [key, child] : value.items()) {
    if (value.is_object()) {
      node.force_insert(key, Convert(child));
    } else {
      node.push_back(Convert(child));
    }
  }
  return node;
}

}  // namespace

YAML::Node ParseJson(std::string_view text, const std::filesystem::path& file) {
  JsonFilter filter(file);
  const auto keep = [&filter](int depth, Event event, const json& parsed) {
    return filter.Keep(depth, event, parsed);
  };
  const json root = json::parse(text, keep, false);
  return root.is_discarded() ? YAML::Node(YAML::NodeType::Undefined) : Convert(root);
}

}  // namespace corvo
