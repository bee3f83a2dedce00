// SPDX-License-Identifier: MIT
#include "explore/components/component_store.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <utility>

#include "explore/components/component.hpp"
#include "explore/components/component_bytes.hpp"
#include "explore/components/kept_contents.hpp"

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
    const ContentHash& made_of, const Fits& fits) {
  std::shared_ptr<KeptContents> others;
  {
    const std::lock_guard lock(mutex_);
    const auto young = young_.all.find(made_of);
    if (young != young_.all.end()) return young->second;
    if (const auto old = old_.all.find(made_of); old != old_.all.end()) {
      Known component = old->second;
      add(made_of, component);
      return component;
    }
    others = others_;
  }
  if (others == nullptr || !fits) return std::nullopt;
  const auto bytes = others->find(made_of);
  if (!bytes) return std::nullopt;
  auto known = component_in(*bytes, made_of);
  if (!known || (*known != nullptr && !fits(**known))) {
    others->refuse(made_of);
    return std::nullopt;
  }
  keep(made_of, *known);
  return known;
}

void ComponentStore::keep(const ContentHash& made_of, Known component) {
  const std::lock_guard lock(mutex_);
  add(made_of, std::move(component));
}

void ComponentStore::share(const ContentHash& made_of, Known component) {
  if (const auto others = this->others()) {
    if (auto bytes = bytes_of(component.get(), made_of)) {
      others->keep(made_of, std::move(*bytes));
    }
  }
  keep(made_of, std::move(component));
}

std::optional<std::string> ComponentStore::find_bytes(
    const ContentHash& content) const {
  const auto others = this->others();
  if (others == nullptr) return std::nullopt;
  const auto bytes = others->find(content);
  if (!bytes) return std::nullopt;
  const auto inside = unsealed(*bytes, content);
  if (inside) return std::string(*inside);
  others->refuse(content);
  return std::nullopt;
}

void ComponentStore::share_bytes(const ContentHash& content,
                                 std::string bytes) const {
  if (const auto others = this->others()) {
    others->keep(content, sealed(std::move(bytes), content));
  }
}

std::shared_ptr<KeptContents> ComponentStore::others() const {
  const std::lock_guard lock(mutex_);
  return others_;
}

void ComponentStore::keep_in(std::shared_ptr<KeptContents> others) {
  const std::lock_guard lock(mutex_);
  others_ = std::move(others);
}

void ComponentStore::write() const {
  if (const auto others = this->others()) others->write();
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
