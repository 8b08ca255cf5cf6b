// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "statements.h"

#include <algorithm>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"
#include "text_tokens.h"

namespace anneal6d {

bool Statements::next() {
  words_.clear();
  while (words_.empty() && !rest_.empty()) {
    line_ = lines_taken_ + 1;
    while (add_line()) {
    }
  }
  return !words_.empty();
}

/// Takes a line's words; true if it goes on in the next one.
bool Statements::add_line() {
  constexpr std::string_view kBlanks = " \t\v\f\r";
  const std::size_t length = std::min(rest_.find('\n'), rest_.size());
  std::string_view text = rest_.substr(0, length);
  rest_.remove_prefix(std::min(length + 1, rest_.size()));
  ++lines_taken_;
  while (true) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos || text[begin] == '#') return false;
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(word.size());
    const bool is_last = text.find_first_not_of(kBlanks) == std::string_view::npos;
    if (is_last && word.ends_with('\\')) {
      if (word.size() > 1) words_.push_back(word.substr(0, word.size() - 1));
      return !rest_.empty();
    }
    words_.push_back(word);
  }
}

std::string_view Statements::text_from(std::size_t i) const {
  if (i >= argument_count()) return {};
  const char* const begin = argument(i).data();
  return {begin, static_cast<std::size_t>(words_.back().data() + words_.back().size() - begin)};
}

double Statements::number(std::size_t i) const {
  if (i >= argument_count()) {
    fail(excerpt(keyword()) + " needs " + std::to_string(i + 1) + " or more numbers");
  }
  const auto value = parse_number(argument(i));
  if (!value) fail(excerpt(argument(i)) + " should be a finite number");
  return *value;
}

void Statements::fail(const std::string& what) const { throw FileError(path_, place(), what); }

}  // namespace anneal6d
