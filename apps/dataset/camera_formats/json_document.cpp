// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/dataset/camera_formats/document.h"
#include "orb/error.h"

namespace corvo {
namespace {

using nlohmann::json;

/// Makes YAML's nodes from those of JSON.
class Converter {
 public:
  explicit Converter(std::string where) : where_(std::move(where)) {}

  YAML::Node Convert(const json& value, int depth = 0) {
    if (++num_nodes_ > kMaxDocumentNodes || depth > kMaxDocumentDepth) {
      throw Error(where_ + "holds more than a camera: too many or too deeply nested values");
    }
    if (value.is_object()) return ConvertObject(value, depth);
    if (value.is_array()) return ConvertArray(value, depth);
    if (value.is_null()) return YAML::Node(YAML::NodeType::Null);
    if (value.is_string()) return YAML::Node(value.get<std::string>());
    return YAML::Node(value.dump());
  }

 private:
  YAML::Node ConvertObject(const json& object, int depth) {
    YAML::Node map(YAML::NodeType::Map);
    for (const auto& [key, value] : object.items()) {
      map.force_insert(key, Convert(value, depth + 1));
    }
    return map;
  }

  YAML::Node ConvertArray(const json& array, int depth) {
    YAML::Node list(YAML::NodeType::Sequence);
    for (const json& value : array) list.push_back(Convert(value, depth + 1));
    return list;
  }

  std::string where_;
  int num_nodes_ = 0;
};

}  // namespace

YAML::Node ParseJson(std::string_view text, const std::filesystem::path& file) {
  // The poses of a reconstruction may be large, and are not needed.
  const auto is_kept = [](int depth, json::parse_event_t event, const json& parsed) {
    return depth != 1 || event != json::parse_event_t::key || parsed != "frames";
  };
  const json root = json::parse(text, is_kept, false);
  if (root.is_discarded()) return YAML::Node(YAML::NodeType::Undefined);
  return Converter(fmt::format("{}: ", file.string())).Convert(root);
}

}  // namespace corvo
