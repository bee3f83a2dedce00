// SPDX-License-Identifier: MIT
//
// A TOML file as a tree of values, each with its place. The library that reads
// it is known to one file only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"

namespace btcheck {

struct TomlMember;

struct TomlNode {
  enum class Kind : std::uint8_t {
    Text,
    Flag,
    Integer,
    Decimal,
    Time,
    List,
    Table
  };
  Kind kind = Kind::Table;
  SourceSpan span;
  std::string text;
  bool flag = false;
  std::int64_t integer = 0;
  double decimal = 0;  // of an Integer as well
  std::vector<TomlNode> items;
  std::vector<TomlMember> members;  // in the order of the file

  bool is_list_of_tables() const;
};

struct TomlMember {
  std::string key;
  SourceSpan span;  // of the key
  TomlNode value;
};

// The table that the file is. BT1502 where it is not TOML 1.0; what is nested
// deeper than any key of ours is left out.
Result<TomlNode> read_toml(const SourceText& source);

// nullptr where there is no such key.
const TomlNode* member_of(const TomlNode& table, std::string_view key);

// "a text", "a list": for messages.
std::string_view kind_of(const TomlNode& node);

}  // namespace btcheck
