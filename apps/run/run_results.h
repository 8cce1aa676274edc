// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "apps/output/output_folder.h"
#include "apps/run/run_inputs.h"
#include "apps/run/run_record.h"
#include "apps/run/run_summary.h"

namespace corvo {

/// Name of the subfolder with what an unfinished run has found.
inline constexpr const char* kCheckpointFolder = "corvo_checkpoint";

/// Returns the files that `corvo run` may write.
OutputPlan PlanOfRun(bool replaces_foreign);

/// Stages all result files of a run. Logs a warning if gnuplot is not available for the plot.
/// Throws corvo::Error if a file cannot be written in full.
void StageResults(const RunArguments& arguments, const RunInputs& inputs, const RunRecord& record,
                  const RunSummary& summary, const OutputFolder& output);

/// Puts the staged results in place and returns their folder: `folder`, or that of the checkpoint
/// if the result is partial and the folder holds a complete one. Results that cannot be put in
/// place are left in the folder of the checkpoint; throws a corvo::Error that says so.
std::filesystem::path CommitResults(const RunEnd& end, const std::filesystem::path& folder,
                                    OutputFolder& output);

}  // namespace corvo
