// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace anneal6d {

/// Words of a text file, separated by blanks and line ends (LF, CRLF or CR), with the line for
/// messages. Keeps references to `path` and `content`: both outlive it.
class TextTokens {
 public:
  /// `comment`: from this character on a line is skipped; 0: there are no comments.
  TextTokens(const std::filesystem::path& path, std::string_view content, char comment = 0);

  bool at_end() const { return begin_ == end_; }
  /// The next word without taking it; empty at the end.
  std::string_view peek() const { return content_.substr(begin_, end_ - begin_); }
  /// Line of the next word, from 1; at the end the last line.
  int line() const { return line_; }
  /// Line of the word taken last.
  int taken_line() const { return taken_line_; }

  /// Takes the next word. `expected` ("the number of points") is for the message of the FileError
  /// that a file which ends here gets; the next two throw it for a word of another kind, too.
  std::string_view take(std::string_view expected);
  double number(std::string_view expected);
  std::size_t count(std::string_view expected);

  /// Takes all that is left of the line of the next word, without a comment.
  std::string_view rest_of_line();

  /// Throw FileError at the line of the next word, or of the word taken last.
  [[noreturn]] void fail_at_next(const std::string& what) const;
  [[noreturn]] void fail_at_taken(const std::string& what) const;

 private:
  void find_next(std::size_t from);
  std::size_t end_of_line(std::size_t from) const;

  const std::filesystem::path& path_;
  std::string_view content_;
  char comment_;
  std::size_t begin_ = 0, end_ = 0;  // of the next word
  int line_ = 1, taken_line_ = 1;
};

/// A word of a file for a message: in quotes, at most 40 characters, nothing unprintable.
std::string excerpt(std::string_view text);

}  // namespace anneal6d
