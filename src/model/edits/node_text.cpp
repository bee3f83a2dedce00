// SPDX-License-Identifier: MIT
//
// Both readers know where their words stand. Of XML, what is inside a node is
// all between its tags but for blanks, so that comments stay with the children.
#include "model/edits/node_text.hpp"

#include <algorithm>

#include "model/btcpp/xml_text.hpp"
#include "model/btf/forms.hpp"

namespace btcheck {
namespace {

using btcpp::XmlAttribute;
using btcpp::XmlElement;

AttributeText text_of(const XmlAttribute& attribute) {
  return {attribute.name,
          {attribute.name_part.begin, attribute.value_part.end + 1},
          attribute.value_part};
}

std::optional<TextStretch> without_blanks(std::string_view text,
                                          TextStretch part) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kBlanks, part.begin);
  if (begin >= part.end) return std::nullopt;
  return TextStretch{begin, text.find_last_not_of(kBlanks, part.end - 1) + 1};
}

NodeText text_of(const XmlElement& element, std::string_view text) {
  NodeText node;
  const std::size_t name = element.start_tag.begin + 1;
  node.whole = {element.start_tag.begin, element.end_tag.end};
  node.type = {name, name + element.name.size()};
  for (const XmlAttribute& each : element.attributes) {
    node.attributes.push_back(text_of(each));
  }
  node.next_attribute = node.attributes.empty()
                            ? node.type.end
                            : node.attributes.back().whole.end;
  if (element.end_tag.size() == 0) return node;
  const std::size_t end_name = element.end_tag.begin + 2;
  node.end_type = {end_name, end_name + element.name.size()};
  node.inside =
      without_blanks(text, {element.start_tag.end, element.end_tag.begin});
  return node;
}

class BtfNode {
 public:
  BtfNode(const btf::Forms& forms, const btf::Form& list, std::string_view text)
      : forms_(forms), list_(list), text_(text) {}

  NodeText text() const {
    NodeText node;
    node.whole = part(list_);
    node.type = part(forms_[list_.items.front()]);
    node.next_attribute = node.type.end;
    for (std::size_t i = 1; i < list_.items.size(); ++i) {
      const btf::Form& item = forms_[list_.items[i]];
      if (item.kind != btf::FormKind::Keyword) {
        if (item.is_list()) node.inside = around(node.inside, part(item));
        continue;
      }
      const bool has_value = i + 1 < list_.items.size();
      const TextStretch key = part(item);
      const TextStretch value = has_value ? part(forms_[list_.items[++i]])
                                          : TextStretch{key.end, key.end};
      node.attributes.push_back(
          {std::string(item.text.substr(1)), {key.begin, value.end}, value});
    }
    return node;
  }

 private:
  TextStretch part(const btf::Form& form) const {
    const std::string_view first = forms_.tokens[form.first_token].text;
    const std::string_view last = forms_.tokens[form.end_token - 1].text;
    return {static_cast<std::size_t>(first.data() - text_.data()),
            static_cast<std::size_t>(last.data() + last.size() - text_.data())};
  }

  static TextStretch around(std::optional<TextStretch> before,
                            TextStretch last) {
    return before ? TextStretch{before->begin, last.end} : last;
  }

  const btf::Forms& forms_;
  const btf::Form& list_;
  std::string_view text_;
};

}  // namespace

const AttributeText* NodeText::attribute(std::string_view name) const {
  const auto found = std::ranges::find(attributes, name, &AttributeText::name);
  return found == attributes.end() ? nullptr : &*found;
}

std::optional<NodeText> xml_node_at(const FileText& file, std::size_t at) {
  const auto parsed = file.parsed<btcpp::ParsedXml>();
  if (!parsed->value) return std::nullopt;
  const auto found = std::ranges::find_if(
      *parsed->value,
      [&](const auto& each) { return each.start_tag.begin + 1 == at; });
  if (found == parsed->value->end()) return std::nullopt;
  return text_of(*found, file.text());
}

std::optional<NodeText> btf_node_at(const FileText& file, std::size_t at) {
  const auto parsed = file.parsed<btf::ParsedForms>();
  const btf::Forms& forms = parsed->forms;
  if (parsed->findings.has_error()) return std::nullopt;
  for (const btf::Form& form : forms.all) {
    if (!form.is_list() || form.items.empty()) continue;
    const btf::Form& head = forms[form.items.front()];
    const bool is_it =
        head.is_word() && head.text.data() == file.text().data() + at;
    if (is_it) return BtfNode(forms, form, file.text()).text();
  }
  return std::nullopt;
}

}  // namespace btcheck
