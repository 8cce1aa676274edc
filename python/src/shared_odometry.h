// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <optional>

#include <nanobind/nanobind.h>

#include "apps/output/landmark_spool.h"
#include "orb/error.h"
#include "vo/io/config.h"
#include "vo/odometry.h"
#include "vo/offline/observation_log.h"

namespace corvo::python {

/// An odometry that several Python threads may use: one call at a time works, without the GIL, and
/// others wait for it.
class SharedOdometry {
 public:
  /// Records all observations, in a temporary file, if `records` is set.
  SharedOdometry(const CameraFile& camera, const OdometryOptions& options, int threads,
                 bool records)
      : SharedOdometry(camera.Prior(options.calibration), options, threads, records) {}
  SharedOdometry(const CameraPrior& camera, const OdometryOptions& options, int threads,
                 bool records)
      : odometry_(camera, options, threads) {
    odometry_.SetLandmarkCallback(
        [this](const MarginalizedLandmark& landmark) { marginalized_.Add(landmark); });
    if (!records) return;
    log_.emplace();
    odometry_.SetObservationCallback(log_->Callback());
  }
  SharedOdometry(const SharedOdometry&) = delete;
  SharedOdometry& operator=(const SharedOdometry&) = delete;

  /// Returns what `work` returns for the odometry.
  template <typename Work>
  auto Run(Work&& work) {
    const nanobind::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    return work(odometry_);
  }

  /// Returns the landmarks that were marginalized. May be called only by the work of Run().
  const LandmarkSpool& marginalized() const { return marginalized_; }

  /// Returns the record of the observations. Throws corvo::Error if there is none.
  const ObservationLog& log() const {
    if (log_) return *log_;
    throw Error("the odometry has no record of its observations; make it with record=True");
  }

 private:
  std::mutex mutex_;
  LandmarkSpool marginalized_;
  std::optional<ObservationLog> log_;
  Odometry odometry_;
};

}  // namespace corvo::python
