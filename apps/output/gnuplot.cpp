// SPDX-License-Identifier: MIT
#include "apps/output/gnuplot.h"

#include <cstdio>
#include <string_view>

#include <fmt/format.h>

#include "apps/output/plot_format.h"
#include "apps/output/temporary_file.h"
#include "apps/system/durable_file.h"
#include "apps/system/program.h"
#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

/// Returns an unnamed temporary file with the content `text`, positioned at its start, or null if
/// it cannot be created.
TemporaryFile HoldText(const std::string& text) {
  TemporaryFile file(std::tmpfile());
  if (!file) return nullptr;
  std::fwrite(text.data(), 1, text.size(), file.get());
  if (std::fflush(file.get()) != 0) return nullptr;
  std::rewind(file.get());
  return file;
}

/// Replaces the times of creation in a PDF by a fixed one.
void RemoveDates(const std::filesystem::path& pdf) {
  constexpr std::string_view kKey = "/CreationDate (D:", kDate = "19700101000000";
  std::string bytes = ReadFileBytes(pdf, kMaxResultBytes);
  std::size_t key = 0;
  while ((key = bytes.find(kKey, key)) != std::string::npos) {
    key += kKey.size();
    if (key + kDate.size() < bytes.size()) bytes.replace(key, kDate.size(), kDate);
  }
  WriteFile(pdf, bytes);
}

}  // namespace

bool RunGnuplot(const std::string& script, const std::filesystem::path& output) {
  const TemporaryFile input = HoldText(script);
  if (input && RunProgram("gnuplot", input.get(), output)) {
    // gnuplot reports no error if the disk is full.
    if (!IsWholePlot(output)) {
      throw Error(fmt::format("{}: cannot be written in full", output.string()));
    }
    if (ParsePlotFormat("plot", output) == PlotFormat::kPdf) RemoveDates(output);
    return true;
  }
  std::error_code ignored;
  std::filesystem::remove(output, ignored);
  return false;
}

}  // namespace corvo
