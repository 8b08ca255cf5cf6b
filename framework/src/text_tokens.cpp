// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "text_tokens.h"

#include <algorithm>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"

namespace anneal6d {
namespace {

constexpr std::string_view kLineEnds = "\r\n";
constexpr std::string_view kTokenBlanks = " \t\v\f\r\n";

}  // namespace

TextTokens::TextTokens(const std::filesystem::path& path, std::string_view content, char comment)
    : path_(path), content_(content), comment_(comment) {
  find_next(0);
}

std::size_t TextTokens::end_of_line(std::size_t from) const {
  return std::min(content_.find_first_of(kLineEnds, from), content_.size());
}

void TextTokens::find_next(std::size_t from) {
  for (begin_ = from; begin_ < content_.size(); ++begin_) {
    const char c = content_[begin_];
    const bool ends_line = c == '\n' || (c == '\r' && content_.substr(begin_, 2) != "\r\n");
    if (ends_line) {
      ++line_;
    } else if (comment_ != 0 && c == comment_) {
      begin_ = end_of_line(begin_) - 1;
    } else if (kTokenBlanks.find(c) == std::string_view::npos) {
      break;
    }
  }
  begin_ = std::min(begin_, content_.size());
  end_ = begin_;
  while (end_ < content_.size() && kTokenBlanks.find(content_[end_]) == std::string_view::npos &&
         (comment_ == 0 || content_[end_] != comment_)) {
    ++end_;
  }
}

std::string_view TextTokens::take(std::string_view expected) {
  if (at_end()) fail_at_next("the file ends where " + std::string(expected) + " should be");
  const std::string_view word = peek();
  taken_line_ = line_;
  find_next(end_);
  return word;
}

double TextTokens::number(std::string_view expected) {
  const auto value = parse_number(peek());
  if (!value && !at_end()) {
    fail_at_next(excerpt(peek()) + " should be " + std::string(expected) + ", a finite number");
  }
  take(expected);
  return *value;
}

std::size_t TextTokens::count(std::string_view expected) {
  const auto value = parse_integer(peek());
  if (!at_end() && !(value && *value >= 0)) {
    fail_at_next(excerpt(peek()) + " should be " + std::string(expected) +
                 ", a whole number from 0");
  }
  take(expected);
  return static_cast<std::size_t>(*value);
}

std::string_view TextTokens::rest_of_line() {
  std::size_t stop = end_of_line(begin_);
  if (comment_ != 0) stop = std::min(stop, content_.find(comment_, begin_));
  const std::string_view rest = content_.substr(begin_, stop - begin_);
  taken_line_ = line_;
  find_next(stop);
  return rest;
}

void TextTokens::fail_at_next(const std::string& what) const {
  throw FileError(path_, "line " + std::to_string(line_), what);
}

void TextTokens::fail_at_taken(const std::string& what) const {
  throw FileError(path_, "line " + std::to_string(taken_line_), what);
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t kMaxLength = 40;
  std::string result = "'" + std::string(text.substr(0, kMaxLength));
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return c < 0x20 || c >= 0x7F; }, '?');
  return result + (text.size() > kMaxLength ? "...'" : "'");
}

}  // namespace anneal6d
