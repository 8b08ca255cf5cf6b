// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "yaml_values.h"

#include <algorithm>
#include <limits>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"
#include "text_tokens.h"

namespace anneal6d {
namespace {

constexpr std::string_view kYamlBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kYamlBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kYamlBlanks) - first + 1);
}

/// The line up to a comment: '#' at its start or after a blank, outside quotes.
std::string_view without_comment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#' && (i == 0 || kYamlBlanks.find(line[i - 1]) != std::string_view::npos)) {
      return line.substr(0, i);
    }
  }
  return line;
}

/// Position of the colon that ends a key, npos if the line does not begin with one.
std::size_t find_colon(std::string_view text) {
  for (auto at = text.find(':'); at != std::string_view::npos; at = text.find(':', at + 1)) {
    if (at + 1 == text.size() || kYamlBlanks.find(text[at + 1]) != std::string_view::npos)
      return at;
  }
  return std::string_view::npos;
}

std::string_view without_tag(std::string_view text) {
  if (!text.starts_with('!')) return text;
  return trimmed(text.substr(std::min(text.find_first_of(kYamlBlanks), text.size())));
}

std::string_view unquoted(std::string_view text) {
  const bool is_quoted =
      text.size() >= 2 && text.front() == text.back() && (text[0] == '"' || text[0] == '\'');
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

int brackets_opened(std::string_view text) {
  int open = 0;
  for (const char c : text) open += (c == '[' || c == '{') - (c == ']' || c == '}');
  return open;
}

}  // namespace

YamlValues::YamlValues(const std::filesystem::path& path, std::string_view content) : path_(path) {
  for (int number = 1; !content.empty(); ++number) {
    const std::size_t length = std::min(content.find('\n'), content.size());
    add_line(content.substr(0, length), number);
    content.remove_prefix(std::min(length + 1, content.size()));
  }
  if (open_brackets_ > 0) {
    throw FileError(path_, "line " + std::to_string(last_->line),
                    "the bracket opened here is not closed");
  }
  add_flow_maps();
}

void YamlValues::add_line(std::string_view line, int number) {
  const auto fail_here = [&](const std::string& what) {
    throw FileError(path_, "line " + std::to_string(number), what);
  };
  line = without_comment(line);
  const std::string_view text = trimmed(line);
  if (text.empty() || line.starts_with('%') || text == "---" || text == "...") return;
  if (line.find('\0') != std::string_view::npos) fail_here("is no text");

  if (open_brackets_ > 0) {
    last_->text.append(1, ' ').append(text);
    open_brackets_ += brackets_opened(text);
    if (open_brackets_ < 0) fail_here("closes more brackets than were opened");
    return;
  }

  const std::size_t indent = line.find_first_not_of(kYamlBlanks);
  if (text.starts_with("- ") || text == "-") {
    // An item of a list that is written line by line; it belongs to the key above.
    if (last_ == nullptr) fail_here("a list item without a key above it");
    last_->text.append(last_->text.empty() ? "" : ",").append(trimmed(text.substr(1)));
    item_indent_ = indent;
    return;
  }
  if (item_indent_ && indent > *item_indent_) return;  // a map inside a list
  item_indent_.reset();
  const std::size_t colon = find_colon(text);
  if (colon == std::string_view::npos) {
    if (indent == 0 || last_ == nullptr) fail_here(excerpt(text) + " should be 'key: value'");
    return;  // continues a text that nobody asks for
  }
  const std::string key(unquoted(trimmed(text.substr(0, colon))));
  const std::string_view rest = without_tag(trimmed(text.substr(colon + 1)));
  if (indent == 0) {
    outer_ = key;
    inner_indent_ = 0;
    add_value(key, rest, number);
  } else {
    if (outer_.empty()) fail_here("an indented key without a key above it");
    if (inner_indent_ == 0) inner_indent_ = indent;
    if (indent > inner_indent_) return;
    add_value(outer_ + "." + key, rest, number);
  }
}

void YamlValues::add_value(const std::string& key, std::string_view text, int line) {
  const auto [entry, is_new] = values_.try_emplace(key, Value{line, std::string(text)});
  if (!is_new) {
    throw FileError(path_, "line " + std::to_string(line),
                    "the key " + excerpt(key) + " is given twice, first in line " +
                        std::to_string(entry->second.line));
  }
  last_ = &entry->second;
  open_brackets_ = text.starts_with('[') || text.starts_with('{') ? brackets_opened(text) : 0;
  if (open_brackets_ < 0) fail(key, "closes more brackets than were opened");
}

/// Turns `outer: {a: 1, b: [2, 3]}` into the values "outer.a" and "outer.b".
void YamlValues::add_flow_maps() {
  std::map<std::string, Value> maps;
  for (const auto& [key, value] : values_) {
    if (value.text.starts_with('{') && value.text.ends_with('}')) maps.emplace(key, value);
  }
  for (const auto& [outer, value] : maps) {
    std::string_view rest = std::string_view(value.text).substr(1, value.text.size() - 2);
    while (!trimmed(rest).empty()) {
      std::size_t comma = 0;
      for (int depth = 0; comma < rest.size(); ++comma) {
        if (rest[comma] == ',' && depth == 0) break;
        depth += (rest[comma] == '[') - (rest[comma] == ']');
      }
      const std::string_view item = trimmed(rest.substr(0, comma));
      rest.remove_prefix(std::min(comma + 1, rest.size()));
      const std::size_t colon = find_colon(item);
      if (colon == std::string_view::npos) fail(outer, excerpt(item) + " should be 'key: value'");
      const std::string inner(unquoted(trimmed(item.substr(0, colon))));
      add_value(outer + "." + inner, trimmed(item.substr(colon + 1)), value.line);
    }
  }
}

const YamlValues::Value& YamlValues::value(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) throw FileError(path_, "", "the key '" + key + "' is missing");
  return found->second;
}

void YamlValues::fail(const std::string& key, const std::string& what) const {
  throw FileError(path_, "line " + std::to_string(value(key).line) + " (" + key + ")", what);
}

std::optional<std::string> YamlValues::text(const std::string& key) const {
  if (!has(key)) return std::nullopt;
  return std::string(unquoted(value(key).text));
}

double YamlValues::number(const std::string& key) const {
  const auto result = parse_number(value(key).text);
  if (!result) fail(key, excerpt(value(key).text) + " should be a finite number");
  return *result;
}

int YamlValues::integer(const std::string& key) const {
  const auto result = parse_integer(value(key).text);
  if (!result || *result < std::numeric_limits<int>::min() ||
      *result > std::numeric_limits<int>::max()) {
    fail(key, excerpt(value(key).text) + " should be a whole number");
  }
  return static_cast<int>(*result);
}

std::vector<double> YamlValues::numbers(const std::string& key) const {
  std::string_view rest = value(key).text;
  if (rest.starts_with('[')) {
    if (!rest.ends_with(']')) fail(key, "should be one list in brackets");
    rest = rest.substr(1, rest.size() - 2);
  }
  std::vector<double> result;
  while (!trimmed(rest).empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view item = trimmed(rest.substr(0, comma));
    const auto number = parse_number(item);
    if (!number) {
      fail(key, "number " + std::to_string(result.size() + 1) + " of the list, " + excerpt(item) +
                    ", should be a finite number");
    }
    result.push_back(*number);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return result;
}

}  // namespace anneal6d
