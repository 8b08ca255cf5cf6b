// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "anneal6d/capture/dc1394.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "emulated_bus.h"

namespace anneal6d::test {

using emulated::EmulatedBus;
using emulated::EmulatedCamera;
using emulated::Fault;

constexpr std::uint64_t kGuid = 0x00B09D01009A1B2C;
inline const std::string kGuidText = "00b09d01009a1b2c";

/// An empty bus for each test; afterwards nothing may be left open or reserved on it.
class Dc1394Test : public ::testing::Test {
 protected:
  using Given = std::initializer_list<std::pair<const char*, std::string>>;

  Dc1394Test() : bus_(EmulatedBus::instance()) {
    bus_.clear();
    set_log_sink([this](LogLevel, std::string_view message) {
      if (!message.starts_with("libdc1394:")) log_ += std::string(message) + "\n";
    });
  }

  ~Dc1394Test() override {
    set_log_sink({});
    EXPECT_EQ(bus_.open_files(), 0);
    EXPECT_EQ(bus_.channels_in_use(), reserved_channels_);
    EXPECT_EQ(bus_.bandwidth(), bandwidth_);
    bus_.clear();
  }

  /// Frames one by one, none dropped at the start, quick to give up.
  static Settings settings(Given given = {}) {
    Settings settings;
    for (const auto& [name, value] : {std::pair<const char*, const char*>{"capture", "every"},
                                      {"settle-frames", "0"},
                                      {"stall-timeout", "3"},
                                      {"recovery-timeout", "5"}}) {
      settings.set(name, value);
    }
    for (const auto& [name, value] : given) settings.set(name, value);
    return settings;
  }

  static std::unique_ptr<FrameSource> open(Given given = {}) {
    return open_dc1394_camera("", Dc1394Options::from(settings(given)));
  }

  /// The message of the error that opening the first camera ends in.
  template <class Expected>
  static std::string refusal(Given given) {
    return message_of<Expected>([&] { open(given); });
  }

  template <class Expected>
  static std::string message_of(const std::function<void()>& action) {
    try {
      action();
    } catch (const Expected& error) {
      return error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << "another error: " << error.what();
      return {};
    }
    ADD_FAILURE() << "no error";
    return {};
  }

  static ::testing::AssertionResult has(const std::string& text,
                                        const std::vector<std::string>& words) {
    for (const std::string& word : words) {
      if (text.find(word) == std::string::npos) {
        return ::testing::AssertionFailure() << "'" << word << "' is not in: " << text;
      }
    }
    return ::testing::AssertionSuccess();
  }

  std::uint32_t reg(EmulatedCamera& camera, std::uint32_t offset) {
    const std::lock_guard lock(bus_.mutex());
    return camera.registers().read(0xF00000 + offset).value_or(0xDEADBEEF);
  }

  EmulatedBus& bus_;
  std::string log_;
  std::uint64_t reserved_channels_ = 0;  // that somebody else holds
  int bandwidth_ = 4915;
};

}  // namespace anneal6d::test
