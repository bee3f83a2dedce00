// SPDX-License-Identifier: MIT
#include "style/attributes.hpp"

#include <algorithm>
#include <utility>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/document.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/libraries/libraries.hpp"

namespace btcheck::style {
namespace {

using btcpp::XmlAttribute;
using btcpp::XmlElement;

void add_words(std::string_view column, std::vector<std::string_view>& to) {
  while (!column.empty()) {
    const std::size_t end = std::min(column.find(' '), column.size());
    if (end > 0) to.push_back(column.substr(0, end));
    column.remove_prefix(std::min(end + 1, column.size()));
  }
}

template <class Range>
std::size_t place_in(const Range& names, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) -
                                  names.begin());
}

}  // namespace

AttributeOrder::AttributeOrder(const std::vector<XmlElement>& elements)
    : elements_(elements), in_tree_(elements.size()) {
  for (std::size_t at = 1; at < elements.size(); ++at) {
    const XmlElement& element = elements[at];
    const XmlElement& parent = elements[element.parent];
    in_tree_[at] = in_tree_[element.parent] || parent.name == "BehaviorTree";
    if (parent.name != "TreeNodesModel") continue;
    const XmlAttribute* id = element.attribute("ID");
    if (id == nullptr || !kind_named(element.name)) continue;
    std::vector<std::string_view> ports;
    for (const std::size_t child : element.children) {
      const XmlAttribute* name = elements[child].attribute("name");
      if (name != nullptr) ports.push_back(name->value);
    }
    models_.try_emplace(id->value, std::move(ports));
  }
}

std::vector<std::string_view> AttributeOrder::ports_of(
    const XmlElement& element) const {
  const bool is_explicit = kind_named(element.name).has_value();
  const XmlAttribute* id = element.attribute("ID");
  if (is_explicit && id == nullptr) return {};
  const std::string_view type = is_explicit ? id->value : element.name;
  const auto model = models_.find(type);
  if (model != models_.end()) return model->second;
  std::vector<std::string_view> ports;
  for (const BtcppRelease release :
       {BtcppRelease::V4, BtcppRelease::V3, BtcppRelease::PyTrees}) {
    const auto* row = btcpp::known_type(release, type);
    if (row == nullptr) continue;
    for (const btcpp::PortRow& port : row->ports) ports.push_back(port.name);
  }
  const auto form =
      is_explicit ? btcpp::TypeForm::Explicit : btcpp::TypeForm::Compact;
  const auto* library = btcpp::library_type(type, form);
  if (!ports.empty() || library == nullptr) return ports;
  for (const std::string_view column :
       {library->inputs, library->outputs, library->both}) {
    add_words(column, ports);
  }
  return ports;
}

std::vector<const XmlAttribute*> AttributeOrder::of(std::size_t at) const {
  const XmlElement& element = elements_[at];
  std::vector<std::string_view> first = {"ID", "name"};
  if (at == 0) first = {"BTCPP_format", "main_tree_to_execute"};
  std::vector<std::string_view> ports;
  if (in_tree_[at] && element.attributes.size() > 1) ports = ports_of(element);
  const auto rank = [&](const XmlAttribute* attribute) {
    const std::string_view name = attribute->name;
    std::size_t place = place_in(first, name);
    if (place < first.size()) return std::pair{0, place};
    place = place_in(ports, name);
    if (place < ports.size()) return std::pair{1, place};
    if (!in_tree_[at] || !name.starts_with('_')) {
      return std::pair{2, std::size_t{0}};
    }
    return std::pair{btcpp::is_condition_name(name) ? 3 : 4,
                     place_in(kBtcppConditionNames, name)};
  };
  std::vector<const XmlAttribute*> order;
  for (const XmlAttribute& each : element.attributes) order.push_back(&each);
  std::ranges::stable_sort(order, {}, rank);
  return order;
}

}  // namespace btcheck::style
