#pragma once

#include <functional>
#include <vector>

#include "apps/dataset/image_source.h"
#include "apps/run/interruption.h"
#include "vo/camera/camera_prior.h"
#include "vo/core/options.h"
#include "vo/offline/focal_search.h"

namespace corvo {

/// Opens a sequence, from its first image.
using ImageOpener = std::function<ImageSource()>;

/// Searches the focal length of the one camera that took all these sequences. Each is opened and
/// read once, those of unknown length twice. Throws corvo::Error where images differ in size, and
/// Interrupted.
FocalSearchResult SearchFocal(const std::vector<ImageOpener>& sequences,
                              const Interruption& interruption);

/// The camera from which to start: its focal length is known to within the search's sigma, at least
/// a tenth, as the center and distortion that the search assumes are not the camera's; its
/// principal point to within a hundredth of the width; k1 and k2 are all but unknown.
CameraPrior MakeFocalPrior(const FocalSearchResult& search);

/// The same of sequences; says on standard error what was found, and what to film where the focal
/// length is not determined. Throws corvo::Error and Interrupted.
CameraPrior FindFocalLength(const std::vector<ImageOpener>& sequences,
                            const Interruption& interruption);

/// The same of a sequence that is opened prepared, but the camera is the one that the odometry has
/// found when it has passed through the first 500 images: what was tracked before a camera is
/// known stays worse. It is known no better than the search knows it, so that a run over the same
/// images counts them once. Throws Interrupted.
CameraPrior FindCamera(const ImageOpener& open, const OdometryOptions& options, int threads,
                       const Interruption& interruption);

}  // namespace corvo
