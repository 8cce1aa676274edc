#include "apps/run/odometry_pass.h"

#include <algorithm>
#include <optional>

#include "apps/run/progress_line.h"

namespace corvo {

void PassThrough(ImageSource source, const std::string& text, const Interruption& interruption,
                 Odometry& odometry, int max_images) {
  ProgressLine line;
  for (int num_read = 0; num_read < max_images; ++num_read) {
    const std::optional<TimedImage> next = source.Next();
    if (!next) break;
    odometry.Process(next->image, next->time_ns, next->mask);
    std::optional<double> share;
    if (source.size()) share = (num_read + 1.0) / std::min(max_images, *source.size());
    line.Show(share, text);
    interruption.ThrowIfRequested();
  }
  odometry.Finish();
}

}  // namespace corvo
