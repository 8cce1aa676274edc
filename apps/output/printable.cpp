// SPDX-License-Identifier: MIT
#include "apps/output/printable.h"

#include <cstdint>

#include <fmt/format.h>

namespace corvo {
namespace {

std::uint8_t ByteAt(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<std::uint8_t>(text[i]) : 0;
}

/// Returns the number of bytes of the UTF-8 character at the start of a text, or 0 if it is
/// malformed or a control character of more than one byte (U+0080 to U+009F).
std::size_t CharacterSize(std::string_view text) {
  const std::uint8_t first = ByteAt(text, 0);
  if (first < 0x80) return 1;
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((ByteAt(text, i) & 0xc0) != 0x80) return 0;
  }
  const std::uint8_t second = ByteAt(text, 1);
  const bool is_overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool is_beyond = (first == 0xed && second > 0x9f) || (first == 0xf4 && second > 0x8f);
  const bool is_control = first == 0xc2 && second < 0xa0;
  return is_overlong || is_beyond || is_control ? 0 : size;
}

}  // namespace

std::string Printable(std::string_view text, bool one_line) {
  std::string printable;
  while (!text.empty()) {
    const std::uint8_t first = ByteAt(text, 0);
    const std::size_t size = CharacterSize(text);
    const bool is_layout = !one_line && (first == '\n' || first == '\t');
    if (size == 0 || (!is_layout && (first < 0x20 || first == 0x7f))) {
      printable += fmt::format("\\x{:02x}", first);
      text.remove_prefix(1);
    } else {
      printable += text.substr(0, size);
      text.remove_prefix(size);
    }
  }
  return printable;
}

}  // namespace corvo
