// SPDX-License-Identifier: MIT
#include "apps/output/plot_format.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "apps/output/file_extension.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns the last bytes of a file, up to 64, or an empty text if it cannot be read.
std::string EndOf(const fs::path& file) {
  constexpr std::streamoff kMaxBytes = 64;
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.tellg();
  if (size <= 0) return "";
  std::string end(static_cast<std::size_t>(std::min(size, kMaxBytes)), '\0');
  stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  return stream ? end : "";
}

std::string_view WithoutNewlines(std::string_view text) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  return text;
}

}  // namespace

PlotFormat ParsePlotFormat(std::string_view option, const fs::path& file) {
  const std::string extension = LowerExtension(file);
  if (extension == ".png") return PlotFormat::kPng;
  if (extension == ".pdf") return PlotFormat::kPdf;
  if (extension == ".svg") return PlotFormat::kSvg;
  throw Error(fmt::format("{}: {}: the extension is \"{}\"; allowed is .png, .pdf or .svg", option,
                          file.string(), file.extension().string()));
}

std::string TerminalCommand(PlotFormat format) {
  switch (format) {
    case PlotFormat::kPng:
      return "set terminal pngcairo noenhanced size 1600,800 font 'Sans,13' linewidth 1.5\n"
             "set pointsize 1.2\n";
    case PlotFormat::kPdf:
      return "set terminal pdfcairo noenhanced size 7.2in,3.6in font 'Sans,7' linewidth 0.8\n"
             "set pointsize 0.45\n";
    case PlotFormat::kSvg:
      return "set terminal svg noenhanced size 1200,600 font 'Helvetica,13' linewidth 1.2\n"
             "set pointsize 0.8\n";
  }
  return "";
}

bool IsWholePlot(const fs::path& file) {
  const std::string end = EndOf(file);
  switch (ParsePlotFormat("plot", file)) {
    case PlotFormat::kPng:
      return end.ends_with("IEND\xAE\x42\x60\x82");
    case PlotFormat::kPdf:
      return WithoutNewlines(end).ends_with("%%EOF");
    case PlotFormat::kSvg:
      return WithoutNewlines(end).ends_with("</svg>");
  }
  return false;
}

}  // namespace corvo
