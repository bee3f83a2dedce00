// SPDX-License-Identifier: MIT
//
// What is known of contents as bytes in memory: the folder of --cache, but for
// the folder.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "explore/components/kept_contents.hpp"

namespace btcheck::reference {

class KeptBytes : public KeptContents {
 public:
  using Key = std::pair<std::uint64_t, std::uint64_t>;

  std::optional<std::string> find(const ContentHash& content) override {
    const auto known = all.find({content.low, content.high});
    if (known == all.end()) return std::nullopt;
    ++found;
    return known->second;
  }
  void keep(const ContentHash& content, std::string bytes) override {
    bytes_ += bytes.size();
    if (bytes_ > kMostBytes) {
      all.clear();
      bytes_ = bytes.size();
    }
    all[{content.low, content.high}] = std::move(bytes);
  }
  void refuse(const ContentHash&) override { ++refused; }
  void write() override {}

  std::map<Key, std::string> all;
  std::size_t found = 0;
  std::size_t refused = 0;

 private:
  static constexpr std::size_t kMostBytes = std::size_t{16} << 20;

  std::size_t bytes_ = 0;
};

}  // namespace btcheck::reference
