// SPDX-License-Identifier: MIT
//
// Components that are known, by what they are made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>

namespace btcheck {

class Component;
class KeptContents;

// What stands for a content: 128 bits of XXH3. Two contents of one hash would
// be taken for the same; of 10^12 that is one chance in 10^14.
struct ContentHash {
  std::uint64_t low = 0;
  std::uint64_t high = 0;

  friend bool operator==(const ContentHash&, const ContentHash&) = default;
};
ContentHash hash_of(std::span<const std::int32_t> content);

// Any number of threads may use it. It holds what was used last: once there is
// more than half of its most, what has not been asked for since that was so
// last is forgotten.
class ComponentStore {
 public:
  static constexpr std::size_t kMostBytes = std::size_t{256} << 20;

  explicit ComponentStore(std::size_t most_bytes = kMostBytes)
      : most_bytes_(most_bytes) {}
  // The one for all checks of this program that share what they know.
  static const std::shared_ptr<ComponentStore>& of_program();

  // Nothing where it is not known; null where none can be made of that. With
  // `fits`, others are asked as well (keep_in): of what they have a component
  // is believed where it fits who asks.
  using Known = std::shared_ptr<const Component>;
  using Fits = std::function<bool(const Component&)>;
  std::optional<Known> find(const ContentHash& made_of, const Fits& fits = {});
  void keep(const ContentHash& made_of, Known component);
  // And has others keep it.
  void share(const ContentHash& made_of, Known component);
  // All that is in memory.
  void forget();

  // From now on these others are asked and told; null: nobody.
  void keep_in(std::shared_ptr<KeptContents> others);
  // What only others keep: bytes of any kind, as they were.
  std::optional<std::string> find_bytes(const ContentHash& content) const;
  void share_bytes(const ContentHash& content, std::string bytes) const;
  // Has them write what they have gathered.
  void write() const;

  std::size_t bytes() const;
  std::size_t size() const;

 private:
  struct Hash {
    std::size_t operator()(const ContentHash& hash) const { return hash.low; }
  };
  struct Generation {
    std::unordered_map<ContentHash, Known, Hash> all;
    std::size_t bytes = 0;
  };

  void add(const ContentHash& made_of, Known component);
  std::shared_ptr<KeptContents> others() const;

  const std::size_t most_bytes_;
  mutable std::mutex mutex_;
  Generation young_;
  Generation old_;
  std::shared_ptr<KeptContents> others_;  // null: nowhere
};

}  // namespace btcheck
