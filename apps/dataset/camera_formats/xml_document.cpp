// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "apps/dataset/camera_formats/document.h"
#include "orb/error.h"

namespace corvo {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kRoot = "opencv_storage";

/// The start tag of an element.
struct Tag {
  std::string name;
  bool is_closed = false;  ///< Whether the element is empty: <name/>.
};

/// Reads the XML that OpenCV writes: elements with text or with elements in them, comments and a
/// declaration. Document types, entities and CDATA sections are not part of it.
class XmlReader {
 public:
  XmlReader(std::string_view text, const std::filesystem::path& file)
      : text_(text), rest_(text), file_(file) {}

  YAML::Node ReadRoot() {
    SkipMisc();
    const Tag tag = ReadTag();
    if (tag.name != kRoot) Throw(fmt::format("<{}> is not <{}>", tag.name, kRoot));
    YAML::Node root = ReadContent(tag, 0);
    SkipMisc();
    if (!rest_.empty()) Throw("there is text after </opencv_storage>");
    return root;
  }

 private:
  [[noreturn]] void Throw(const std::string& problem) const {
    const std::string_view before = text_.substr(0, text_.size() - rest_.size());
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    throw Error(fmt::format("{}:{}: {}", file_.string(), line, problem));
  }

  /// Skips `count` characters.
  void Skip(std::size_t count) { rest_.remove_prefix(std::min(count, rest_.size())); }

  /// Returns the text before `end` and skips both.
  std::string_view TakeUntil(std::string_view end) {
    const std::size_t size = rest_.find(end);
    if (size == std::string_view::npos) Throw(fmt::format("'{}' is missing", end));
    const std::string_view taken = rest_.substr(0, size);
    Skip(size + end.size());
    return taken;
  }

  /// Skips blanks, comments and declarations.
  void SkipMisc() {
    for (;;) {
      Skip(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
      if (rest_.starts_with("<!--")) {
        TakeUntil("-->");
      } else if (rest_.starts_with("<?")) {
        TakeUntil("?>");
      } else {
        return;
      }
    }
  }

  Tag ReadTag() {
    if (!rest_.starts_with('<')) Throw("an element is missing");
    Skip(1);
    std::string_view inside = TakeUntil(">");
    Tag tag;
    tag.is_closed = inside.ends_with('/');
    if (tag.is_closed) inside.remove_suffix(1);
    tag.name = inside.substr(0, std::min(inside.find_first_of(kBlanks), inside.size()));
    if (tag.name.empty() || tag.name[0] == '!' || tag.name[0] == '/') {
      Throw(fmt::format("<{}> is not the start of an element", tag.name));
    }
    return tag;
  }

  /// Reads what is between a start tag and its end tag: a mapping, or else a scalar.
  YAML::Node ReadContent(const Tag& tag, int depth) {
    if (++num_elements_ > kMaxDocumentNodes || depth > kMaxDocumentDepth) {
      Throw("holds more than a camera: too many or too deeply nested elements");
    }
    if (tag.is_closed) return YAML::Node(YAML::NodeType::Null);
    const std::string end = "</" + tag.name + ">";
    SkipMisc();
    if (!rest_.starts_with('<')) return ReadText(end);
    YAML::Node map(YAML::NodeType::Map);
    while (!rest_.starts_with(end)) {
      const Tag child = ReadTag();
      map.force_insert(child.name, ReadContent(child, depth + 1));
      SkipMisc();
    }
    Skip(end.size());
    return map;
  }

  YAML::Node ReadText(const std::string& end) {
    std::string_view text = TakeUntil(end);
    if (text.find('<') != std::string_view::npos) Throw("an element is inside of text");
    text = text.substr(0, text.find_last_not_of(kBlanks) + 1);
    const bool is_quoted = text.size() > 1 && text.starts_with('"') && text.ends_with('"');
    return YAML::Node(std::string(is_quoted ? text.substr(1, text.size() - 2) : text));
  }

  std::string_view text_;
  std::string_view rest_;
  std::filesystem::path file_;
  int num_elements_ = 0;
};

}  // namespace

YAML::Node ParseXml(std::string_view text, const std::filesystem::path& file) {
  return XmlReader(text, file).ReadRoot();
}

}  // namespace corvo
