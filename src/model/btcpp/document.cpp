// SPDX-License-Identifier: MIT
#include "model/btcpp/document.hpp"

#include <algorithm>

namespace btcheck {
namespace {

template <class Range, class Matches>
const typename Range::value_type* first_of(const Range& range,
                                           Matches&& matches) {
  const auto found = std::find_if(range.begin(), range.end(), matches);
  return found == range.end() ? nullptr : &*found;
}

}  // namespace

std::optional<BtcppKind> kind_named(std::string_view tag) {
  const auto* name = first_of(
      kBtcppKindNames, [&](std::string_view each) { return each == tag; });
  if (name == nullptr) return std::nullopt;
  return static_cast<BtcppKind>(name - kBtcppKindNames.data());
}

const BtcppAttribute* find_attribute(
    const std::vector<BtcppAttribute>& attributes, std::string_view name) {
  return first_of(attributes, [&](const auto& a) { return a.name == name; });
}

const BtcppPort* BtcppModel::port(std::string_view wanted) const {
  return first_of(ports, [&](const auto& p) { return p.name == wanted; });
}

const BtcppTree* BtcppDocument::tree(std::string_view id) const {
  return first_of(trees, [&](const BtcppTree& t) { return t.id == id; });
}

const BtcppModel* BtcppDocument::model(std::string_view id) const {
  return first_of(models, [&](const BtcppModel& m) {
    return m.kind != BtcppKind::SubTree && m.id == id;
  });
}

const BtcppModel* BtcppDocument::subtree_model(std::string_view id) const {
  return first_of(models, [&](const BtcppModel& m) {
    return m.kind == BtcppKind::SubTree && m.id == id;
  });
}

}  // namespace btcheck
