// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/output/plot.h"
#include "apps/run/run_inputs.h"
#include "apps/run/run_record.h"
#include "apps/run/run_summary.h"

namespace corvo {

/// Returns the plot of a run's estimate, together with the ground truth during the images' time
/// span and the errors. The estimate is aligned with the ground truth if it was evaluated.
TrajectoryPlot MakeRunPlot(const RunArguments& arguments, const RunInputs& inputs,
                           const RunRecord& record, const RunSummary& summary);

/// Returns a name for titles: that of the last folder or file of a path, without names that all
/// sequences or results have, such as mav0 and trajectory.tum, and without patterns.
std::string SequenceName(const std::filesystem::path& input);

}  // namespace corvo
