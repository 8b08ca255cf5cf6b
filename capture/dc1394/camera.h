// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <dc1394/dc1394.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "library.h"

namespace anneal6d::dc1394 {

/// The bit by which a register says that what it controls is there (IIDC 1.31).
inline constexpr std::uint32_t kPresent = 0x80000000U;

/// Sixteen hexadecimal digits.
std::string guid_text(std::uint64_t guid);

/// Throws ConfigError: not 1 to 16 hexadecimal digits.
std::uint64_t parse_guid(const std::string& text);

/// The GUIDs of all cameras that can be opened, in the library's order.
std::vector<std::uint64_t> find_cameras(const Library& library);

/// A camera's registers. Nothing is changed by opening one.
class Camera {
 public:
  /// Opens the camera with this GUID, or the first one. Throws BackendUnavailable: no such camera,
  /// no permission (with the cure), not answering; lists those that there are.
  explicit Camera(std::optional<std::uint64_t> guid);

  dc1394camera_t* get() const { return camera_.get(); }
  std::uint64_t guid() const { return camera_->guid; }
  /// For messages: "dc1394 camera 00b09d01009a1b2c (Point Grey Research Dragonfly2 DR2-COL)".
  const std::string& name() const { return name_; }
  bool from_point_grey() const { return camera_->vendor_id == kPointGrey; }

  /// A register of the command page or beyond; empty if the camera has none there.
  std::optional<std::uint32_t> read(std::uint64_t offset) const;
  /// Throws CaptureError naming `what`.
  void write(std::uint64_t offset, std::uint32_t value, const std::string& what) const;

  /// The bus's generation as of the last answer: it changes with every bus reset.
  std::uint32_t generation() const;

 private:
  static constexpr std::uint32_t kPointGrey = 0x00B09D;
  struct Free {
    void operator()(dc1394camera_t* camera) const { dc1394_camera_free(camera); }
  };

  Library library_;
  std::unique_ptr<dc1394camera_t, Free> camera_;
  std::string name_;
};

/// Throws ConfigError "--SETTING: 'VALUE' can't be set on CAMERA: ALLOWED".
[[noreturn]] void refuse_setting(const Camera& camera, const std::string& setting,
                                 const std::string& value, const std::string& allowed);

}  // namespace anneal6d::dc1394
