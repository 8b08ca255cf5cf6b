// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace anneal6d {

/// Lines of an OBJ or MTL file that say something: a keyword and what follows it. A '#' that begins
/// a word begins a comment; a '\' at the end of a line joins the next one to it. Keeps references
/// to its arguments.
class Statements {
 public:
  Statements(const std::filesystem::path& path, std::string_view content)
      : path_(path), rest_(content) {}

  /// Goes on to the next statement; false at the end.
  bool next();

  std::string_view keyword() const { return words_.front(); }
  /// Words after the keyword.
  std::size_t argument_count() const { return words_.size() - 1; }
  std::string_view argument(std::size_t i) const { return words_[i + 1]; }
  /// The text from an argument to the end of the line: names may have blanks in them.
  std::string_view text_from(std::size_t i) const;
  /// An argument as a finite number. Throws FileError.
  double number(std::size_t i) const;

  std::string place() const { return "line " + std::to_string(line_); }
  /// Throws FileError at the statement.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool add_line();

  const std::filesystem::path& path_;
  std::string_view rest_;
  std::vector<std::string_view> words_;
  int line_ = 0, lines_taken_ = 0;
};

}  // namespace anneal6d
