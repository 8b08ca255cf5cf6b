// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <string>
#include <vector>

namespace anneal6d::dc1394 {

/// A device of a FireWire bus: /dev/fwN. The computer's own node is left out.
struct DeviceNode {
  std::string path;
  int open_error = 0;  ///< errno of an attempt to open it; 0: it can be opened
};

/// By name. Opens each for a moment, since libdc1394 passes over those that it can't open as if
/// there were none.
std::vector<DeviceNode> list_device_nodes();

/// Why there may be cameras that can't be seen, and what to do; empty if every node can be opened.
std::string explain_closed_nodes(const std::vector<DeviceNode>& nodes);

}  // namespace anneal6d::dc1394
