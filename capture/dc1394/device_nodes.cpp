// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "device_nodes.h"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <memory>
#include <string_view>
#include <system_error>

namespace anneal6d::dc1394 {
namespace {

bool is_node(std::string_view name) {
  return name.size() > 2 && name.starts_with("fw") &&
         std::all_of(name.begin() + 2, name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// The computer's own node on the bus, which nobody needs for a camera.
bool is_local(const std::string& name) {
  std::ifstream file("/sys/bus/firewire/devices/" + name + "/is_local");
  int local = 0;
  return file >> local && local == 1;
}

int try_to_open(const std::string& path) {
  const int fd = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (fd < 0) return errno;
  close(fd);
  return 0;
}

}  // namespace

std::vector<DeviceNode> list_device_nodes() {
  std::vector<DeviceNode> nodes;
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir("/dev"), closedir);
  if (!folder) return nodes;
  while (const dirent* entry = readdir(folder.get())) {
    if (is_node(entry->d_name) && !is_local(entry->d_name))
      nodes.push_back({std::string("/dev/") + entry->d_name, 0});
  }
  for (DeviceNode& node : nodes) node.open_error = try_to_open(node.path);
  std::sort(nodes.begin(), nodes.end(),
            [](const DeviceNode& a, const DeviceNode& b) { return a.path < b.path; });
  return nodes;
}

std::string explain_closed_nodes(const std::vector<DeviceNode>& nodes) {
  std::string denied, others;
  for (const DeviceNode& node : nodes) {
    if (node.open_error == 0) continue;
    if (node.open_error == EACCES || node.open_error == EPERM) {
      denied += (denied.empty() ? "" : ", ") + node.path;
    } else {
      others += (others.empty() ? "" : "; ") + node.path + ": " +
                std::generic_category().message(node.open_error) +
                (node.open_error == EBUSY ? " (another program uses it; close that program)" : "");
    }
  }
  std::string text;
  if (!denied.empty()) {
    text = "this user may not open " + denied +
           "; copy 60-anneal6d-firewire.rules (in capture/dc1394 of the sources, share/anneal6d "
           "of an installation) to /etc/udev/rules.d, run sudo udevadm control --reload, add the "
           "user to the group video (sudo usermod -aG video USER), log in again and replug the "
           "camera";
  }
  if (!others.empty()) text += (text.empty() ? "" : "; ") + others;
  return text;
}

}  // namespace anneal6d::dc1394
