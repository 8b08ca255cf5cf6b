// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Sets the bus up for a program that this library was loaded into. ANNEAL6D_EMULATED_DC1394 holds
// the cameras, separated by ';', each with words "key=value" separated by ',':
//   model=DR2-BW,guid=00b09d01009a1b2c,frames=FOLDER,drop=5,unplug=9,replug=2;pace=real
// Faults are named as in Fault::Kind with '-' and give the frame; replug counts enumerations.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulated_bus.h"

namespace anneal6d::emulated {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

Fault::Kind fault_of(const std::string& name) {
  if (name == "drop") return Fault::Kind::drop;
  if (name == "late") return Fault::Kind::late;
  if (name == "short") return Fault::Kind::short_frame;
  if (name == "bus-reset") return Fault::Kind::bus_reset;
  if (name == "reset-stops") return Fault::Kind::reset_stops;
  if (name == "stall") return Fault::Kind::stall;
  if (name == "dies") return Fault::Kind::dies;
  if (name == "unplug") return Fault::Kind::unplug;
  throw std::invalid_argument("unknown word '" + name + "'");
}

void set_up(const std::string& description) {
  EmulatedBus& bus = EmulatedBus::instance();
  for (const std::string& part : split(description, ';')) {
    std::string model, guid, frames;
    int replug = -1;
    std::vector<Fault> faults;
    for (const std::string& word : split(part, ',')) {
      const std::size_t at = word.find('=');
      const std::string key = word.substr(0, at), value = word.substr(at + 1);
      if (key == "model") {
        model = value;
      } else if (key == "guid") {
        guid = value;
      } else if (key == "frames") {
        frames = value;
      } else if (key == "replug") {
        replug = std::stoi(value);
      } else if (key == "pace") {
        bus.set_pace(value == "real" ? Pace::real_time : Pace::on_demand);
      } else if (key == "open-error") {
        bus.set_open_error(std::stoi(value));
      } else if (key == "bandwidth") {
        bus.set_bandwidth(std::stoi(value));
      } else {
        faults.push_back({fault_of(key), std::stoll(value)});
      }
    }
    if (model.empty()) continue;
    EmulatedCamera& camera = bus.add_camera(model, std::stoull(guid, nullptr, 16),
                                            frames.empty() ? Pictures() : Pictures(frames));
    camera.replug_after = replug;
    for (const Fault& fault : faults) camera.add_fault(fault);
  }
}

__attribute__((constructor)) void set_up_from_environment() {
  const char* description = std::getenv("ANNEAL6D_EMULATED_DC1394");
  if (description == nullptr) return;
  try {
    set_up(description);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ANNEAL6D_EMULATED_DC1394: %s\n", error.what());
    std::abort();
  }
}

}  // namespace
}  // namespace anneal6d::emulated
