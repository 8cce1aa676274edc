// SPDX-License-Identifier: MIT
#include "apps/output/track_drawings.h"

#include "apps/output/drawing_folder.h"
#include "apps/output/film.h"
#include "apps/output/frame_drawing.h"

namespace corvo {

TrackDrawings::TrackDrawings(const std::filesystem::path& path, bool replaces_foreign) {
  if (path.empty()) return;
  if (IsFilmName(path)) {
    sink_ = std::make_unique<Film>(path, replaces_foreign);
  } else {
    sink_ = std::make_unique<DrawingFolder>(path, replaces_foreign);
  }
}

void TrackDrawings::Add(const cv::Mat& image, const cv::Mat& mask, const Frame& frame,
                        const FrameResult& result) {
  if (!sink_) return;
  tracks_.Add(frame);
  AddDrawing(DrawTracks(image, mask, frame, tracks_), result);
}

void TrackDrawings::AddMissing(const cv::Size& size, const FrameResult& result) {
  if (!sink_) return;
  AddDrawing(cv::Mat(size, CV_8UC3, cv::Scalar::all(0)), result);
}

void TrackDrawings::AddDrawing(cv::Mat drawing, const FrameResult& result) {
  path_.Add(result);
  path_.Draw(drawing);
  sink_->Add(WithCaption(drawing, result), result);
}

void TrackDrawings::Finish(bool is_complete) {
  if (sink_) sink_->Finish(is_complete);
}

}  // namespace corvo
