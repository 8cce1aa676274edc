// SPDX-License-Identifier: MIT
#include "apps/output/plot_file.h"

#include <spdlog/spdlog.h>

namespace corvo {

namespace fs = std::filesystem;

PlotFile::PlotFile(const fs::path& file, bool replaces_foreign) : file_(file) {
  if (file.empty()) return;
  ParsePlotFormat("--plot", file);
  output_.emplace(fs::absolute(file).parent_path(), PlanOfFile(file, {}, replaces_foreign));
}

void PlotFile::Draw(const TrajectoryPlot& plot, bool is_complete) {
  if (!output_) return;
  if (!is_complete && output_->HoldsCompleteResult()) {
    spdlog::warn("{} was not replaced: it shows a complete result", file_.string());
  } else if (DrawTrajectory(plot, output_->Stage(file_.filename().string()))) {
    output_->Commit(is_complete);
  } else {
    WarnOfMissingPlot(file_);
  }
}

void WarnOfMissingPlot(const fs::path& file) {
  spdlog::warn("{} was not written: gnuplot is missing or failed (Debian: gnuplot-nox)",
               file.string());
}

}  // namespace corvo
