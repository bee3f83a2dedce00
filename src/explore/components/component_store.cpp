// SPDX-License-Identifier: MIT
#include "explore/components/component_store.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <utility>

#include "explore/components/component.hpp"

namespace btcheck {

ContentHash hash_of(std::span<const std::int32_t> content) {
  const XXH128_hash_t hash = XXH3_128bits(content.data(), content.size_bytes());
  return {hash.low64, hash.high64};
}

const std::shared_ptr<ComponentStore>& ComponentStore::of_program() {
  static const auto store = std::make_shared<ComponentStore>();
  return store;
}

std::optional<ComponentStore::Known> ComponentStore::find(
    const ContentHash& made_of) {
  const std::lock_guard lock(mutex_);
  if (const auto known = young_.all.find(made_of); known != young_.all.end()) {
    return known->second;
  }
  const auto known = old_.all.find(made_of);
  if (known == old_.all.end()) return std::nullopt;
  Known component = known->second;
  add(made_of, component);
  return component;
}

void ComponentStore::keep(const ContentHash& made_of, Known component) {
  const std::lock_guard lock(mutex_);
  add(made_of, std::move(component));
}

void ComponentStore::forget() {
  const std::lock_guard lock(mutex_);
  young_ = {};
  old_ = {};
}

void ComponentStore::add(const ContentHash& made_of, Known component) {
  // Of the table beside the component.
  constexpr std::size_t kBytesBeside = 64;
  const std::size_t bytes =
      kBytesBeside + (component == nullptr ? 0 : component->bytes());
  if (young_.bytes + bytes > most_bytes_ / 2) {
    old_ = std::exchange(young_, {});
  }
  if (young_.all.emplace(made_of, std::move(component)).second) {
    young_.bytes += bytes;
  }
}

std::size_t ComponentStore::bytes() const {
  const std::lock_guard lock(mutex_);
  return young_.bytes + old_.bytes;
}

std::size_t ComponentStore::size() const {
  const std::lock_guard lock(mutex_);
  return young_.all.size() + old_.all.size();
}

}  // namespace btcheck
