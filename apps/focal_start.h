#pragma once

#include <functional>
#include <vector>

#include "apps/image_source.h"
#include "vo/camera_prior.h"
#include "vo/focal_search.h"

namespace corvo {

/// Opens a sequence, from its first picture.
using ImageOpener = std::function<ImageSource()>;

/// Searches the focal length of the one camera that took all these sequences. Each is opened and
/// read once, those of unknown length twice. Throws corvo::Error where pictures differ in size.
FocalSearchResult SearchFocal(const std::vector<ImageOpener>& sequences);

/// The camera from which to start: its focal length is known to within the search's sigma, at least
/// a tenth, as the centre and distortion that the search assumes are not the camera's; its
/// principal point to within a hundredth of the width; k1 and k2 are all but unknown.
CameraPrior MakeFocalPrior(const FocalSearchResult& search);

/// The same of a sequence; says on standard error what was found, and what to film where the focal
/// length is not determined.
CameraPrior FindFocalLength(const std::vector<ImageOpener>& sequences);

}  // namespace corvo
