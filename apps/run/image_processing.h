// SPDX-License-Identifier: MIT
#pragma once

#include "apps/output/track_drawings.h"
#include "apps/run/checkpoint.h"
#include "apps/run/run_inputs.h"
#include "apps/run/run_record.h"
#include "apps/system/interruption.h"

namespace corvo {

/// Processes all images, with refinement if requested. A signal or an error after the first frame
/// ends the run early; the record then holds what was found until then, and why it ended.
RunRecord ProcessSequence(const RunArguments& arguments, const Interruption& interruption,
                          RunInputs& inputs, TrackDrawings& drawings, Checkpoint& checkpoint);

}  // namespace corvo
