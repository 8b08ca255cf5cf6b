// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <vector>

#include "camera.h"

namespace anneal6d::dc1394 {

/// The features of a camera as they are set, those that the options leave alone, too: a camera that
/// lost its power has forgotten them.
class FeatureSnapshot {
 public:
  /// What can't be read is left out.
  explicit FeatureSnapshot(const Camera& camera);

  /// What the camera does not take is left as it is.
  void restore(const Camera& camera) const;

 private:
  struct Feature {
    dc1394feature_t id;
    std::uint64_t control_register;
    std::uint32_t control;
    bool absolute;
    float value;
  };
  std::vector<Feature> features_;
};

}  // namespace anneal6d::dc1394
