// SPDX-License-Identifier: MIT
#include "apps/dataset/camera_formats/document_fields.h"

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/io/config.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

/// Appends the text of a scalar, or the texts of a list, to `texts`, but not many more than `max`.
void AppendTexts(const YAML::Node& node, std::size_t max, std::vector<std::string>& texts) {
  if (node.IsScalar()) {
    for (std::string& field : SplitFields(node.Scalar())) texts.push_back(std::move(field));
  } else if (node.IsSequence()) {
    for (const YAML::Node& entry : node) {
      if (texts.size() > max) return;
      texts.push_back(entry.IsScalar() ? entry.Scalar() : "");
    }
  }
}

/// Returns the texts of a scalar, a list, a list of lists, or the "data" of a mapping.
std::vector<std::string> TextsOf(const YAML::Node& node, std::size_t max) {
  std::vector<std::string> texts;
  const YAML::Node values = node.IsMap() ? node["data"] : node;
  if (!values.IsDefined()) return texts;
  const bool is_nested = values.IsSequence() && values.size() > 0 && values[0].IsSequence();
  if (!is_nested) AppendTexts(values, max, texts);
  if (is_nested) {
    for (const YAML::Node& row : values) {
      if (texts.size() <= max) AppendTexts(row, max, texts);
    }
  }
  return texts;
}

}  // namespace

YAML::Node DocumentFields::Find(const std::string& key) const {
  if (map_.IsMap()) {
    for (const auto& entry : map_) {
      if (entry.first.IsScalar() && entry.first.Scalar() == key) return entry.second;
    }
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

std::string DocumentFields::FirstOf(Keys keys) const {
  for (const char* key : keys) {
    if (Has(key)) return key;
  }
  return *keys.begin();
}

std::string DocumentFields::Text(const std::string& key) const {
  const YAML::Node node = Find(key);
  if (!node.IsDefined() || node.IsNull()) return "";
  if (!node.IsScalar()) throw Error(fmt::format("{}{} is not a text", where_, key));
  return node.Scalar();
}

double DocumentFields::Number(const std::string& key) const {
  const std::optional<double> number = FindNumber(key);
  if (!number) throw Error(fmt::format("{}{} is missing", where_, key));
  return *number;
}

std::optional<double> DocumentFields::FindNumber(const std::string& key) const {
  const YAML::Node node = Find(key);
  if (!node.IsDefined()) return std::nullopt;
  return ParseNumber(Text(key), fmt::format("{}{}: ", where_, key));
}

std::vector<double> DocumentFields::Numbers(const std::string& key, std::size_t min,
                                            std::size_t max) const {
  const YAML::Node node = Find(key);
  if (!node.IsDefined()) {
    if (min == 0) return {};
    throw Error(fmt::format("{}{} is missing", where_, key));
  }
  const std::vector<std::string> texts = TextsOf(node, max);
  if (texts.size() < min || texts.size() > max) {
    throw Error(
        fmt::format("{}{} is not a list of {} numbers", where_, key,
                    min == max ? fmt::format("{}", min) : fmt::format("{} to {}", min, max)));
  }
  std::vector<double> numbers;
  for (const std::string& text : texts) {
    numbers.push_back(ParseNumber(text, fmt::format("{}{}: ", where_, key)));
  }
  return numbers;
}

DocumentFields DocumentFields::Section(const std::string& key) const {
  return {Find(key), fmt::format("{}{}.", where_, key)};
}

std::vector<DocumentFields> DocumentFields::Sections(const std::string& key) const {
  std::vector<DocumentFields> sections;
  const YAML::Node list = Find(key);
  if (!list.IsDefined() || !list.IsSequence()) return sections;
  for (const YAML::Node& entry : list) {
    sections.emplace_back(entry, fmt::format("{}{}[{}].", where_, key, sections.size()));
  }
  return sections;
}

std::vector<std::string> KeysOf(const YAML::Node& map) {
  std::vector<std::string> keys;
  if (!map.IsMap()) return keys;
  for (const auto& entry : map) {
    if (entry.first.IsScalar()) keys.push_back(entry.first.Scalar());
  }
  return keys;
}

std::optional<double> StatedFrameRate(const DocumentFields& fields, const std::string& key) {
  const std::optional<double> rate_hz = fields.FindNumber(key);
  if (!rate_hz || *rate_hz == 0) return std::nullopt;
  CheckRange(fields.where() + key, *rate_hz, kMinFrameRateHz, kMaxFrameRateHz);
  return rate_hz;
}

}  // namespace corvo
