// SPDX-License-Identifier: MIT
#include "vo/io/yaml_document.h"

#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include "orb/error.h"
#include "vo/io/file_bytes.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

/// A handler of a document that keeps nothing but the place where it starts.
class DocumentStart : public YAML::EventHandler {
 public:
  int line() const { return line_; }

 private:
  void OnDocumentStart(const YAML::Mark& mark) override { line_ = mark.line + 1; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

  int line_ = 1;
};

void CheckOneDocument(const std::string& text, const std::filesystem::path& file) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStart start;
  if (!parser.HandleNextDocument(start) || !parser.HandleNextDocument(start)) return;
  throw Error(fmt::format("{}:{}: holds more than one document, or text after it", file.string(),
                          start.line()));
}

}  // namespace

YAML::Node ParseYaml(const std::string& text, const std::filesystem::path& file) {
  const std::string plain(WithoutByteOrderMark(text, file.string()));
  try {
    CheckOneDocument(plain, file);
    return YAML::Load(plain);
  } catch (const YAML::Exception& error) {
    const std::string line = error.mark.is_null() ? "" : fmt::format("{}:", error.mark.line + 1);
    throw Error(fmt::format("{}:{} {}", file.string(), line, error.msg));
  }
}

YAML::Node ReadYaml(const std::filesystem::path& file) {
  return ParseYaml(ReadFileBytes(file, kMaxYamlBytes), file);
}

}  // namespace corvo
