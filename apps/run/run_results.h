// SPDX-License-Identifier: MIT
#pragma once

#include "apps/output/output_folder.h"
#include "apps/run/run_inputs.h"
#include "apps/run/run_record.h"
#include "apps/run/run_summary.h"

namespace corvo {

/// Writes all result files of a run into the output folder, all at once. Logs a warning if gnuplot
/// is not available for the plot.
void WriteResults(const RunArguments& arguments, const RunInputs& inputs, const RunRecord& record,
                  const RunSummary& summary, OutputFolder& output);

}  // namespace corvo
