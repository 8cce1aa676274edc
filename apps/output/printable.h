// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace corvo {

/// Returns a text that is safe to print on a terminal: control characters (also the C1 ones and
/// DEL) and bytes that are not UTF-8 are replaced by escapes such as "\x1b". Newlines and tabs are
/// kept unless `one_line` is set.
std::string Printable(std::string_view text, bool one_line = false);

}  // namespace corvo
