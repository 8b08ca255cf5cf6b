// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "config_rom.h"

namespace anneal6d::emulated {
namespace {

constexpr std::uint32_t kVendorId = 0x00B09D;     // Point Grey Research
constexpr std::uint32_t kSpecifierId = 0x00A02D;  // 1394 Trade Association
constexpr std::uint32_t kSoftwareVersion = 0x000102;
constexpr std::uint32_t kSubVersion131 = 0x000010;

std::uint32_t entry(std::uint32_t key, std::uint32_t value) { return key << 24 | value; }

// A text of a leaf: two quadlets that say "ASCII", then the characters.
std::vector<std::uint32_t> text_leaf(std::string_view text) {
  std::vector<std::uint32_t> leaf = {0, 0, 0};
  for (std::size_t at = 0; at < text.size(); at += 4) {
    std::uint32_t quadlet = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const char c = at + i < text.size() ? text[at + i] : '\0';
      quadlet = quadlet << 8 | static_cast<unsigned char>(c);
    }
    leaf.push_back(quadlet);
  }
  leaf[0] = static_cast<std::uint32_t>(leaf.size() - 1) << 16;
  return leaf;
}

}  // namespace

std::vector<std::uint32_t> make_config_rom(std::uint64_t guid, std::string_view vendor,
                                           std::string_view model) {
  // Bus information block, then directories one after the other: an offset counts quadlets from
  // the entry that holds it.
  std::vector<std::uint32_t> rom = {0x04040000, 0x31333934, 0xE000A002,
                                    static_cast<std::uint32_t>(guid >> 32),
                                    static_cast<std::uint32_t>(guid)};
  constexpr std::uint32_t root_entries = 3;
  constexpr std::uint32_t unit_entries = 3;
  constexpr std::uint32_t dependent_entries = 4;
  rom.push_back(root_entries << 16);
  rom.push_back(entry(0x03, kVendorId));
  rom.push_back(entry(0x0C, 0x0083C0));  // node capabilities
  rom.push_back(entry(0xD1, 1));         // the unit directory follows
  rom.push_back(unit_entries << 16);
  rom.push_back(entry(0x12, kSpecifierId));
  rom.push_back(entry(0x13, kSoftwareVersion));
  rom.push_back(entry(0xD4, 1));  // the unit dependent directory follows
  rom.push_back(dependent_entries << 16);
  rom.push_back(entry(0x40, kCommandBase / 4));
  const std::vector<std::uint32_t> vendor_leaf = text_leaf(vendor);
  const std::vector<std::uint32_t> model_leaf = text_leaf(model);
  rom.push_back(entry(0x81, 3));
  rom.push_back(entry(0x82, 2 + static_cast<std::uint32_t>(vendor_leaf.size())));
  rom.push_back(entry(0x38, kSubVersion131));
  rom.insert(rom.end(), vendor_leaf.begin(), vendor_leaf.end());
  rom.insert(rom.end(), model_leaf.begin(), model_leaf.end());
  return rom;
}

}  // namespace anneal6d::emulated
