// SPDX-License-Identifier: MIT
//
// BehaviorTree.CPP reads its files with tinyxml2, and projects rely on what
// tinyxml2 lets pass: raw `&` and `<` in attributes, several roots. So the same
// library reads them here. It knows lines but no columns: a second pass walks
// the start tags of the text, which are those of the elements in their order.
#include "model/btcpp/xml_text.hpp"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "text/utf8.hpp"

namespace btcheck::btcpp {
namespace {

// Finds start tags and attributes one after another, in a text that tinyxml2
// has accepted.
class TagCursor {
 public:
  using Stretch = TextStretch;

  explicit TagCursor(std::string_view text) : text_(text) {}

  // The name in the next start tag.
  Stretch next_tag(std::size_t name_length) {
    while (at_ < text_.size()) {
      at_ = limited(text_.find('<', at_));
      if (!skip_what_is_no_tag() && !skip("</", ">")) break;
    }
    const std::size_t begin = limited(at_ + 1);
    at_ = limited(begin + name_length);
    return {begin, at_};
  }

  // The next end tag, where none begins before it.
  Stretch next_end_tag() {
    do {
      at_ = limited(text_.find('<', at_));
    } while (at_ < text_.size() && skip_what_is_no_tag());
    const std::size_t begin = at_;
    skip("</", ">");
    return {begin, at_};
  }

  // Goes behind the end of a start tag whose attributes have been passed. True
  // where it has no end tag.
  bool end_start_tag() {
    at_ = limited(limited(text_.find('>', at_)) + 1);
    return at_ > 1 && text_.substr(at_ - 2, 2) == "/>";
  }

  // Goes past the next start tag, quoted values and all. True where more than
  // `most` attributes stand in it.
  bool has_more_attributes(std::size_t most) {
    next_tag(0);
    std::size_t count = 0;
    for (; at_ < text_.size() && text_[at_] != '>'; ++at_) {
      if (text_[at_] == '=') ++count;
      if (text_[at_] != '"' && text_[at_] != '\'') continue;
      at_ = std::min(text_.find(text_[at_], at_ + 1), text_.size() - 1);
    }
    return count > most;
  }
  // Where the last tag ends.
  std::optional<std::size_t> position() const {
    return at_ < text_.size() ? std::optional(at_) : std::nullopt;
  }

  // The name of the next attribute of this tag, then its value.
  std::pair<Stretch, Stretch> next_attribute(std::size_t name_length) {
    skip_blanks();
    const Stretch name = {at_, limited(at_ + name_length)};
    const std::size_t quote = text_.find_first_of("\"'", name.end);
    const std::size_t begin = limited(quote == text_.npos ? quote : quote + 1);
    const std::size_t end =
        quote == text_.npos ? begin : limited(text_.find(text_[quote], begin));
    at_ = limited(end + 1);
    return {name, {begin, end}};
  }

 private:
  std::size_t limited(std::size_t at) const {
    return std::min(at, text_.size());
  }

  void skip_blanks() {
    at_ = limited(text_.find_first_not_of(" \t\r\n\f\v", at_));
  }

  bool skip(std::string_view start, std::string_view end) {
    if (text_.substr(at_, start.size()) != start) return false;
    const std::size_t close = text_.find(end, at_ + start.size());
    at_ = close == text_.npos ? text_.size() : close + end.size();
    return true;
  }

  bool skip_what_is_no_tag() {
    return skip("<!--", "-->") || skip("<![CDATA[", "]]>") ||
           skip("<?", "?>") || skip("<!", ">");
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

std::string_view reason_of(tinyxml2::XMLError error) {
  switch (error) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "nothing stands in the file";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "a tag is not closed, or closed by another name";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute has no value, no quotes, or is given twice";
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "a tag is not complete";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment has no end";
    case tinyxml2::XML_ERROR_PARSING_CDATA:
      return "a CDATA section has no end";
    default:
      return "this is not XML";
  }
}

// tinyxml2 compares each attribute with all before it.
constexpr std::size_t kMostAttributes = 1000;

// Where a tag ends that has more.
std::optional<std::size_t> crowded_tag(std::string_view text) {
  TagCursor cursor(text);
  while (cursor.position()) {
    if (cursor.has_more_attributes(kMostAttributes)) {
      return cursor.position().value_or(text.size() - 1);
    }
  }
  return std::nullopt;
}

// Attributes that name something; the values of others are texts, of a script
// several lines perhaps.
bool is_of_names(std::string_view attribute) {
  return attribute == "name" || attribute == "ID" ||
         attribute == "main_tree_to_execute" || attribute == "_fullpath";
}

class ElementList : private tinyxml2::XMLVisitor {
 public:
  explicit ElementList(const SourceText& source)
      : source_(source), cursor_(source.text()) {}

  std::vector<XmlElement> of(const tinyxml2::XMLElement& root) {
    root.Accept(this);
    return std::move(elements_);
  }

 private:
  bool VisitEnter(const tinyxml2::XMLElement& element,
                  const tinyxml2::XMLAttribute*) override {
    open_.push_back(add(element, open_.back()));
    return true;
  }
  bool VisitExit(const tinyxml2::XMLElement&) override {
    XmlElement& element = elements_[open_.back()];
    if (element.end_tag.begin == 0) element.end_tag = cursor_.next_end_tag();
    open_.pop_back();
    return true;
  }

  std::size_t add(const tinyxml2::XMLElement& from, std::size_t parent) {
    const std::size_t number = elements_.size();
    XmlElement element;
    element.name = from.Name();
    const auto tag = cursor_.next_tag(element.name.size());
    element.span = span(tag);
    element.parent = parent;
    if (from.GetText() != nullptr) element.text = from.GetText();
    for (const auto* a = from.FirstAttribute(); a != nullptr; a = a->Next()) {
      const std::string name = a->Name();
      const auto [before, value] = cursor_.next_attribute(name.size());
      const SourceSpan name_span = span(before);
      element.attributes.push_back(
          {name, is_of_names(name) ? unbroken(a->Value()) : a->Value(),
           name_span, span(value), before, value});
    }
    const bool is_closed = cursor_.end_start_tag();
    const std::size_t end = cursor_.position().value_or(source_.text().size());
    element.start_tag = {tag.begin - 1, end};
    if (is_closed) element.end_tag = {end, end};
    elements_.push_back(std::move(element));
    if (number > 0) elements_[parent].children.push_back(number);
    return number;
  }

  // As `source_` has it, but counted on from the last one: a file may well be
  // a single line.
  SourceSpan span(TagCursor::Stretch part) {
    const std::string_view text = source_.text();
    const auto passed = text.substr(last_begin_, part.begin - last_begin_);
    if (passed.find('\n') != passed.npos) {
      last_ = source_.span(part.begin, part.end);
    } else {
      const auto inside = text.substr(part.begin, part.end - part.begin);
      last_.column += count_code_points(passed);
      last_.length = std::max(
          1, count_code_points(inside.substr(0, inside.find_first_of("\r\n"))));
    }
    last_begin_ = part.begin;
    return last_;
  }

  const SourceText& source_;
  TagCursor cursor_;
  SourceSpan last_ = {1, 1};
  std::size_t last_begin_ = 0;
  std::vector<XmlElement> elements_;
  std::vector<std::size_t> open_ = {0};  // the root is its own parent
};

}  // namespace

const XmlAttribute* XmlElement::attribute(std::string_view wanted) const {
  const auto found = std::ranges::find(attributes, wanted, &XmlAttribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

const std::string* XmlElement::value(std::string_view wanted) const {
  const XmlAttribute* found = attribute(wanted);
  return found == nullptr ? nullptr : &found->value;
}

std::string XmlElement::value_or_empty(std::string_view wanted) const {
  const std::string* found = value(wanted);
  return found == nullptr ? std::string() : *found;
}

namespace {

Result<std::vector<XmlElement>> parse_xml(const SourceText& source) {
  const auto refuse = [&](SourceSpan span, std::string_view code,
                          std::string message, std::string label,
                          std::string help) {
    return Result<std::vector<XmlElement>>{
        std::nullopt,
        {source.diagnostic(Severity::Error, code, span, std::move(message),
                           std::move(label), std::move(help))}};
  };
  if (const auto end = crowded_tag(source.text())) {
    return refuse(source.span(*end, *end + 1), "BT1602",
                  "a tag has too many attributes",
                  fmt::format("more than {} by here", kMostAttributes),
                  "a node of BehaviorTree.CPP has an attribute for each port");
  }
  tinyxml2::XMLDocument document;
  document.Parse(source.text().data(), source.text().size());
  if (document.Error()) {
    const int line = document.ErrorLineNum();
    const SourceSpan span = {line, 1,
                             std::max(1, count_code_points(source.line(line)))};
    if (document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) {
      return refuse(span, "BT1602", "the tags are nested too deeply",
                    fmt::format("more than {} tags in one another",
                                TINYXML2_MAX_ELEMENT_DEPTH),
                    "move a part into a tree of its own");
    }
    return refuse(span, "BT1600", "this file cannot be read as XML",
                  std::string(reason_of(document.ErrorID())),
                  "tags are closed as `<A/>` or `<A></A>`, and every attribute "
                  "is written `name=\"value\"`");
  }
  if (document.RootElement() == nullptr) {
    return refuse({}, "BT1600", "this file cannot be read as XML",
                  "no element stands in it",
                  "a file of BehaviorTree.CPP begins with `<root>`");
  }
  Result<std::vector<XmlElement>> result{
      ElementList(source).of(*document.RootElement()), {}};
  // tinyxml2 goes on behind the end of the file's only element.
  if (const auto* second = document.RootElement()->NextSiblingElement()) {
    const int line = second->GetLineNum();
    result.diagnostics.push_back(source.diagnostic(
        Severity::Warning, "BT1625",
        {line, 1, std::max(1, count_code_points(source.line(line)))},
        fmt::format("`<{}>` is ignored", second->Name()),
        "the engine reads nothing behind the file's first element",
        "put all trees into one `<root>`"));
  }
  return result;
}

}  // namespace

ParsedXml::ParsedXml(const std::string& text)
    : Result(parse_xml(SourceText("", text))) {}

}  // namespace btcheck::btcpp
