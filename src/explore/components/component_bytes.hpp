// SPDX-License-Identifier: MIT
//
// What is known of a content as bytes, and back.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "explore/components/component_store.hpp"

namespace btcheck {

// Null: that nothing can be made of the content. Nothing where the component
// has something that these bytes have no place for.
std::optional<std::string> bytes_of(const Component* known,
                                    const ContentHash& made_of);

// Any bytes with the seal of what belongs to a content, and without it: nothing
// where they are not so, or belong to another one.
std::string sealed(std::string bytes, const ContentHash& content);
std::optional<std::string_view> unsealed(std::string_view bytes,
                                         const ContentHash& content);

// Nothing for other bytes than those, or for those of another content. Whatever
// the bytes are, nothing in a component has a number of what is not in it; what
// lies outside is for who asks for it to look at (ComponentStore::Fits).
std::optional<ComponentStore::Known> component_in(std::string_view bytes,
                                                  const ContentHash& made_of);

}  // namespace btcheck
