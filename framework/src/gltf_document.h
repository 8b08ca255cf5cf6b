// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace anneal6d {

/// A glTF 2 file, text or binary, as a tree of JSON and the numbers in its buffers. Whatever does
/// not fit together throws FileError, which says at which part ("accessors[3]").
class GltfDocument {
 public:
  using Json = nlohmann::json;

  /// Keeps references to its arguments.
  GltfDocument(const std::filesystem::path& path, std::string_view content, bool is_binary);

  /// A part of the file and what to call it.
  struct Part {
    const Json& json;
    std::string name;
  };

  Part root() const { return {root_, "file"}; }
  /// Number `index` of the file's list `list` ("meshes"), an object.
  Part part(const std::string& list, std::size_t index) const;
  std::size_t size_of(const std::string& list) const;

  /// A whole number from 0 that a part gives, if it does.
  std::optional<std::size_t> index(const Part& part, const std::string& key) const;
  /// The same, where it must.
  std::size_t needed_index(const Part& part, const std::string& key) const;
  /// A list of whole numbers from 0; empty if the part gives none.
  std::vector<std::size_t> indices(const Part& part, const std::string& key) const;
  /// A list of numbers that a part gives, of this length; empty if it does not.
  std::vector<double> numbers(const Part& part, const std::string& key, std::size_t length) const;
  /// What a part gives as an object or a list under `key`; null JSON if it does not.
  const Json& child(const Part& part, const std::string& key) const;

  /// Numbers of an accessor, one element after the other, and how many an element has.
  struct Numbers {
    std::size_t width = 0;
    std::vector<float> values;
    std::size_t count() const { return values.size() / width; }
  };
  Numbers read_accessor(std::size_t index);
  /// The bytes of a buffer view.
  std::string_view read_view(std::size_t index);

  /// A URI of a file beside this one.
  std::filesystem::path resolve(const std::string& uri) const;
  const std::filesystem::path& path() const { return path_; }
  [[noreturn]] void fail(const std::string& place, const std::string& what) const;

 private:
  std::string_view split_binary(std::string_view content);
  void parse(std::string_view text, std::size_t text_at);
  const std::string& read_buffer(std::size_t index);

  const std::filesystem::path& path_;
  Json root_;
  std::optional<std::string_view> binary_;  // the second chunk of a binary file
  std::map<std::size_t, std::string> buffers_;
};

}  // namespace anneal6d
