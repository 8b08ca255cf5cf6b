// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "feature_snapshot.h"

namespace anneal6d::dc1394 {
namespace {

// Control registers of the features from brightness to frame rate (IIDC 1.31, 4.6).
constexpr std::uint64_t kFirstControl = 0x800;

bool is_absolute(const Camera& camera, dc1394feature_t id) {
  dc1394bool_t capable = DC1394_FALSE;
  dc1394switch_t on = DC1394_OFF;
  return dc1394_feature_has_absolute_control(camera.get(), id, &capable) == DC1394_SUCCESS &&
         capable == DC1394_TRUE &&
         dc1394_feature_get_absolute_control(camera.get(), id, &on) == DC1394_SUCCESS &&
         on == DC1394_ON;
}

}  // namespace

FeatureSnapshot::FeatureSnapshot(const Camera& camera) {
  for (int place = 0; place <= DC1394_FEATURE_FRAME_RATE - DC1394_FEATURE_MIN; ++place) {
    const auto id = static_cast<dc1394feature_t>(DC1394_FEATURE_MIN + place);
    dc1394bool_t present = DC1394_FALSE;
    dc1394_feature_is_present(camera.get(), id, &present);
    if (present == DC1394_FALSE) continue;
    const std::uint64_t offset = kFirstControl + static_cast<std::uint64_t>(place) * 4;
    const auto control = camera.read(offset);
    if (!control) continue;
    Feature feature{id, offset, *control, is_absolute(camera, id), 0};
    if (feature.absolute) dc1394_feature_get_absolute_value(camera.get(), id, &feature.value);
    features_.push_back(feature);
  }
}

void FeatureSnapshot::restore(const Camera& camera) const {
  // From the last to the first: whether the frame rate is controlled decides how long the shutter
  // may be.
  for (auto feature = features_.rbegin(); feature != features_.rend(); ++feature) {
    dc1394_set_control_register(camera.get(), feature->control_register, feature->control);
    if (feature->absolute) {
      dc1394_feature_set_absolute_value(camera.get(), feature->id, feature->value);
    }
  }
}

}  // namespace anneal6d::dc1394
