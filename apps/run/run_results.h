// SPDX-License-Identifier: MIT
#pragma once

#include "apps/output/output_folder.h"
#include "apps/run/run_inputs.h"
#include "apps/run/run_record.h"
#include "apps/run/run_summary.h"

namespace corvo {

/// Writes every file of a run into the output folder, all at once. Warns where there is no gnuplot
/// to draw with.
void WriteResults(const RunArguments& arguments, const RunInputs& inputs, const RunRecord& record,
                  const RunSummary& summary, OutputFolder& output);

}  // namespace corvo
