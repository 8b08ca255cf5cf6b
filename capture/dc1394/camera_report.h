// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <vector>

#include "anneal6d/capture/dc1394.h"

namespace anneal6d::dc1394 {

std::vector<Dc1394CameraReport> report_cameras();

}  // namespace anneal6d::dc1394
