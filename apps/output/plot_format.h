// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace corvo {

/// The format of a file that gnuplot draws.
enum class PlotFormat { kPng, kPdf, kSvg };

/// Returns the format that the extension of a file name stands for, in upper or lower case. Throws
/// corvo::Error, whose message starts with `option`, for any other extension.
PlotFormat ParsePlotFormat(std::string_view option, const std::filesystem::path& file);

/// Returns the gnuplot command that selects the format, for a figure of twice its height. Names and
/// titles are drawn as they are, without markup.
std::string TerminalCommand(PlotFormat format);

/// Returns whether a file ends as one of its format does, as told by its extension. A file that was
/// cut off does not.
bool IsWholePlot(const std::filesystem::path& file);

}  // namespace corvo
