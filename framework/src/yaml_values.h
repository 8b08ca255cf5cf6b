// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace anneal6d {

/// Values of a YAML file of two levels, as calibrations are: `key: value`, and below a key
/// `key: value` again, which is called "outer.inner". Lists may be `[a, b]`, over several lines, or
/// items `- a`; maps may be `{a: b}`; tags such as `!!opencv-matrix` are skipped. What lies deeper
/// is skipped. It stands in for OpenCV's reader, which recurses as deeply as a file asks it to and
/// does not tell the line of an error.
class YamlValues {
 public:
  /// Throws FileError: unbalanced brackets, a key given twice, a line that is no YAML. Keeps a
  /// reference to `path`.
  YamlValues(const std::filesystem::path& path, std::string_view content);

  bool has(const std::string& key) const { return values_.contains(key); }
  /// The text without quotes; empty if there is no such key.
  std::optional<std::string> text(const std::string& key) const;
  /// Throw FileError: no such key, not a finite number, not a whole number.
  double number(const std::string& key) const;
  int integer(const std::string& key) const;
  std::vector<double> numbers(const std::string& key) const;

  /// Throws FileError at the line of `key`.
  [[noreturn]] void fail(const std::string& key, const std::string& what) const;

 private:
  struct Value {
    int line = 0;
    std::string text;
  };

  void add_line(std::string_view line, int number);
  void add_value(const std::string& key, std::string_view text, int line);
  void add_flow_maps();
  const Value& value(const std::string& key) const;

  const std::filesystem::path& path_;
  std::map<std::string, Value> values_;
  // Where the reading of lines is.
  std::string outer_;                       // the top-level key
  Value* last_ = nullptr;                   // what a continued line is appended to
  std::size_t inner_indent_ = 0;            // of the keys below `outer_`, 0: not known yet
  std::optional<std::size_t> item_indent_;  // of the list item that is being read
  int open_brackets_ = 0;
};

}  // namespace anneal6d
