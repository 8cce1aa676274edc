// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "apps/output/output_folder.h"
#include "apps/output/plot.h"

namespace corvo {

/// The plot that a command writes to the file of its option --plot.
class PlotFile {
 public:
  /// Prepares the file; an empty path stands for none. Throws corvo::Error if the extension is not
  /// that of a format, or if the file cannot be written or is not corvo's.
  PlotFile(const std::filesystem::path& file, bool replaces_foreign);

  /// Draws the plot and puts the file in place. A plot of an incomplete result does not replace one
  /// of a complete result. Logs a warning if there is no new file, as without gnuplot. Throws
  /// corvo::Error if the file cannot be written in full.
  void Draw(const TrajectoryPlot& plot, bool is_complete = true);

 private:
  std::filesystem::path file_;
  std::optional<OutputFolder> output_;
};

/// Logs the warning that gnuplot has not drawn a file.
void WarnOfMissingPlot(const std::filesystem::path& file);

}  // namespace corvo
