// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anneal6d/capture/frame_set_source.h"
#include "dc1394_source.h"

namespace anneal6d::dc1394 {

/// Several cameras that the bus keeps in step: frames of the same exposure, side by side.
class CameraGroup : public FrameSetSource {
 public:
  CameraGroup(const std::vector<std::string>& guids, const Dc1394Options& options);

  std::optional<FrameSet> next() override;
  std::string description() const override;
  std::size_t size() const override { return sources_.size(); }

 private:
  Dc1394Options::Frames which_;
  std::vector<std::unique_ptr<Dc1394Source>> sources_;
  std::vector<TimedFrame> frames_;
};

}  // namespace anneal6d::dc1394
