// SPDX-License-Identifier: MIT
//
// Keys of a TOML file and their values, read as what they should be. Whatever
// is something else is told with its place and an example.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "settings/toml.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

using Words = std::vector<std::string>;

// The mistakes in a file, or in a part of it: the first hundred.
struct Mistakes {
  const SourceText& source;
  std::vector<Diagnostic>& found;

  // No further one is kept.
  bool is_full() const { return found.size() >= 100; }
  void add(std::string_view code, const SourceSpan& span, std::string message,
           std::string label, std::string help);
  void add_unknown(const TomlMember& member, const Words& known);
  void add_other_kind(const TomlNode& node, std::string message,
                      std::string help);
};

// A key and its value. Asked for another kind of value, a member reports the
// mistake and returns nothing.
class KeyReader {
 public:
  KeyReader(Mistakes& mistakes, std::string_view key, const TomlNode& node)
      : mistakes_(mistakes), key_(key), node_(node) {}
  KeyReader(Mistakes& mistakes, const TomlMember& member)
      : KeyReader(mistakes, member.key, member.value) {}

  std::string_view key() const { return key_; }

  std::optional<std::string> text(std::string_view example);
  // A text, or a list of them.
  std::optional<Words> texts(std::string_view example);

  // What one of several words stands for; without `meanings`, the value of the
  // enumeration that has its place.
  template <class Value>
  std::optional<Value> one_of(const Words& words,
                              std::initializer_list<Value> meanings = {}) {
    const auto place = place_in(words);
    if (!place) return std::nullopt;
    if (*place < meanings.size()) return meanings.begin()[*place];
    return static_cast<Value>(*place);
  }

  std::optional<bool> flag();
  std::optional<std::uint64_t> count(std::uint64_t most = UINT64_MAX);
  std::optional<std::uint64_t> size();
  std::optional<double> seconds();
  // nullptr where it is none.
  const TomlNode* table(std::string_view of, std::string_view example);

 private:
  std::optional<std::string> text_in(const TomlNode& node,
                                     std::string_view example);
  std::optional<std::size_t> place_in(const Words& words);
  std::nullopt_t refuse(const TomlNode& node, std::string_view wanted,
                        std::string_view example);

  Mistakes& mistakes_;
  std::string_view key_;
  const TomlNode& node_;
};

}  // namespace btcheck
