// SPDX-License-Identifier: MIT
//
// In which order the attributes of a tag stand.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/xml_text.hpp"

namespace btcheck::style {

// The ID and the name first; of a node then its ports in the order of its
// model in the file, else of what is known of its type; other attributes as
// they were written; pre- and postconditions in the engine's order; and what
// else begins with `_`.
class AttributeOrder {
 public:
  explicit AttributeOrder(const std::vector<btcpp::XmlElement>& elements);

  std::vector<const btcpp::XmlAttribute*> of(std::size_t element) const;

 private:
  std::vector<std::string_view> ports_of(
      const btcpp::XmlElement& element) const;

  const std::vector<btcpp::XmlElement>& elements_;
  std::vector<bool> in_tree_;
  std::map<std::string_view, std::vector<std::string_view>> models_;
};

}  // namespace btcheck::style
