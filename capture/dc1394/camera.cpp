// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "camera.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "anneal6d/framework/error.h"
#include "device_nodes.h"

namespace anneal6d::dc1394 {
namespace {

std::string which_text(const std::optional<std::uint64_t>& guid) {
  return guid ? "dc1394 camera " + guid_text(*guid) : std::string("dc1394 camera");
}

[[noreturn]] void explain_missing(const std::optional<std::uint64_t>& guid,
                                  const std::vector<std::uint64_t>& found) {
  std::string text = "no " + which_text(guid) + ": ";
  const std::vector<DeviceNode> nodes = list_device_nodes();
  const std::string closed = explain_closed_nodes(nodes);
  if (!found.empty()) {
    text += "there are: ";
    for (const std::uint64_t other : found) {
      text += (other == found.front() ? "" : ", ") + guid_text(other);
    }
    if (!closed.empty()) text += "; " + closed;
  } else if (!closed.empty()) {
    text += closed;
  } else if (nodes.empty()) {
    text +=
        "there is no FireWire bus (/dev/fw*); check that the adapter is in and its driver "
        "firewire-ohci is loaded (lsmod), and that the camera has power";
  } else {
    text +=
        "no device on the FireWire bus is an IIDC camera; check cable and power and see with "
        "'dmesg' what the bus finds";
  }
  throw BackendUnavailable(text);
}

}  // namespace

std::string guid_text(std::uint64_t guid) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(guid));
  return text;
}

std::uint64_t parse_guid(const std::string& text) {
  std::uint64_t guid = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), guid, 16);
  if (text.empty() || text.size() > 16 || error != std::errc() ||
      end != text.data() + text.size()) {
    throw ConfigError("'" + text +
                      "' is not the GUID of a camera: up to 16 hexadecimal digits, as 'anneal6d "
                      "list' shows them");
  }
  return guid;
}

std::vector<std::uint64_t> find_cameras(const Library& library) {
  dc1394camera_list_t* list = nullptr;
  if (dc1394_camera_enumerate(library.get(), &list) != DC1394_SUCCESS) return {};
  std::vector<std::uint64_t> guids;
  for (std::uint32_t i = 0; i < list->num; ++i) guids.push_back(list->ids[i].guid);
  dc1394_camera_free_list(list);
  return guids;
}

Camera::Camera(std::optional<std::uint64_t> guid) {
  const std::vector<std::uint64_t> found = find_cameras(library_);
  if (!guid && !found.empty()) guid = found.front();
  if (!guid || std::find(found.begin(), found.end(), *guid) == found.end()) {
    explain_missing(guid, found);
  }
  camera_.reset(dc1394_camera_new(library_.get(), *guid));
  if (!camera_) {
    throw BackendUnavailable(which_text(guid) +
                             " does not answer; unplug it, plug it in again and see with 'dmesg' "
                             "what the bus says");
  }
  const auto text = [](const char* words) { return std::string(words != nullptr ? words : "?"); };
  name_ = which_text(guid) + " (" + text(camera_->vendor) + " " + text(camera_->model) + ")";
}

std::optional<std::uint32_t> Camera::read(std::uint64_t offset) const {
  std::uint32_t value = 0;
  if (dc1394_get_control_register(get(), offset, &value) != DC1394_SUCCESS) return std::nullopt;
  return value;
}

void Camera::write(std::uint64_t offset, std::uint32_t value, const std::string& what) const {
  check(dc1394_set_control_register(get(), offset, value), name_, "set " + what);
}

std::uint32_t Camera::generation() const {
  std::uint32_t node = 0, generation = 0;
  dc1394_camera_get_node(get(), &node, &generation);
  return generation;
}

void refuse_setting(const Camera& camera, const std::string& setting, const std::string& value,
                    const std::string& allowed) {
  throw ConfigError("--" + setting + ": '" + value + "' can't be set on " + camera.name() + ": " +
                    allowed);
}

}  // namespace anneal6d::dc1394
