// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// The emulated camera as libdc1394 sees it: what the other tests stand on.
#include <dc1394/dc1394.h>

#include "camera.h"
#include "dc1394_test.h"

namespace anneal6d {
namespace {

class EmulatedCameras : public test::Dc1394Test {};

TEST_F(EmulatedCameras, AreFoundByTheLibraryWithNamesAndVersion) {
  bus_.add_camera("DR2-COL", test::kGuid);
  const dc1394::Camera camera(std::nullopt);
  EXPECT_EQ(camera.get()->guid, test::kGuid);
  EXPECT_STREQ(camera.get()->vendor, "Point Grey Research");
  EXPECT_STREQ(camera.get()->model, "Dragonfly2 DR2-COL");
  EXPECT_EQ(camera.get()->iidc_version, DC1394_IIDC_VERSION_1_31);
  EXPECT_EQ(camera.get()->max_mem_channel, 2);
  EXPECT_TRUE(camera.from_point_grey());
}

TEST_F(EmulatedCameras, HaveTheSensorsAndTriggersOfTheDataSheet) {
  struct Row {
    const char* model;
    std::uint32_t width, height;
    int triggers;
  };
  for (const Row& row : {Row{"DR2-BW", 648, 488, 6}, Row{"DR2-HICOL", 1032, 776, 6},
                         Row{"DR2-13S2M", 1296, 964, 4}}) {
    bus_.clear();
    bus_.add_camera(row.model, test::kGuid);
    const dc1394::Camera camera(std::nullopt);
    std::uint32_t width = 0, height = 0;
    EXPECT_EQ(dc1394_format7_get_max_image_size(camera.get(), DC1394_VIDEO_MODE_FORMAT7_0, &width,
                                                &height),
              DC1394_SUCCESS);
    EXPECT_EQ(width, row.width) << row.model;
    EXPECT_EQ(height, row.height) << row.model;
    dc1394feature_info_t trigger{};
    trigger.id = DC1394_FEATURE_TRIGGER;
    EXPECT_EQ(dc1394_feature_get(camera.get(), &trigger), DC1394_SUCCESS);
    EXPECT_EQ(static_cast<int>(trigger.trigger_modes.num), row.triggers) << row.model;
  }
}

TEST_F(EmulatedCameras, AnswerEveryQuestionOfTheLibrarysOwnReport) {
  for (const auto& model : emulated::camera_models()) {
    bus_.clear();
    bus_.add_camera(model.key, test::kGuid);
    const dc1394::Camera camera(std::nullopt);
    dc1394featureset_t features{};
    EXPECT_EQ(dc1394_feature_get_all(camera.get(), &features), DC1394_SUCCESS) << model.key;
    dc1394format7modeset_t modes{};
    EXPECT_EQ(dc1394_format7_get_modeset(camera.get(), &modes), DC1394_SUCCESS) << model.key;
  }
}

}  // namespace
}  // namespace anneal6d
