// SPDX-License-Identifier: MIT
#include "lsp/texts/xml_scan.hpp"

#include <algorithm>

namespace btcheck::lsp {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool ends_name(char c) {
  return is_blank(c) ||
         std::string_view("<>/=\"'").find(c) != std::string_view::npos;
}

}  // namespace

XmlScan::XmlScan(const std::string& text) : text_(text) {
  const auto skip = [&](std::string_view opening, std::string_view closing) {
    const bool is_here = text_.substr(at_).starts_with(opening);
    if (!is_here) return TextStretch{at_, at_};
    const std::size_t found = text_.find(closing, at_ + opening.size());
    const std::size_t end =
        found == text_.npos ? text_.size() : found + closing.size();
    const TextStretch part{at_, end};
    at_ = end;
    return part;
  };
  for (;;) {
    at_ = text_.find('<', at_);
    if (at_ == text_.npos) break;
    const TextStretch comment = skip("<!--", "-->");
    if (comment.size() > 0) {
      comments_.push_back(comment);
    } else if (skip("<![CDATA[", "]]>").size() == 0 &&
               skip("<?", "?>").size() == 0 && skip("<!", ">").size() == 0) {
      if (text_.substr(at_).starts_with("</")) {
        scan_end(at_);
      } else {
        scan_start(at_);
      }
    }
  }
  close_until(0, text_.size());
}

std::size_t XmlScan::skip_blanks(std::size_t at) const {
  while (at < text_.size() && is_blank(text_[at])) ++at;
  return at;
}

std::size_t XmlScan::name_end(std::size_t at) const {
  while (at < text_.size() && !ends_name(text_[at])) ++at;
  return at;
}

void XmlScan::close_until(std::size_t depth, std::size_t at) {
  while (open_.size() > depth) {
    elements_[open_.back()].end = at;
    open_.pop_back();
  }
}

void XmlScan::scan_start(std::size_t at) {
  ScannedElement element;
  element.start_tag.begin = at;
  element.name = {at + 1, name_end(at + 1)};
  at = element.name.end;
  for (;;) {
    at = skip_blanks(at);
    if (at == text_.size() || text_[at] == '<') break;
    if (text_[at] == '>') {
      element.is_closed = true;
      ++at;
      break;
    }
    if (text_.substr(at).starts_with("/>")) {
      element.is_closed = element.is_empty = true;
      at += 2;
      break;
    }
    if (ends_name(text_[at])) {  // a mark that belongs to nothing
      ++at;
      continue;
    }
    ScannedAttribute attribute;
    attribute.name = {at, name_end(at)};
    at = attribute.name.end;
    attribute.value = {at, at};
    const std::size_t equals = skip_blanks(at);
    if (equals < text_.size() && text_[equals] == '=') {
      const std::size_t quote = skip_blanks(equals + 1);
      if (quote < text_.size() &&
          (text_[quote] == '"' || text_[quote] == '\'')) {
        attribute.has_value = true;
        const char mark[] = {text_[quote], '<'};
        std::size_t end =
            text_.find_first_of(std::string_view(mark, 2), quote + 1);
        const bool is_whole = end != text_.npos && text_[end] != '<';
        if (!is_whole) {  // it goes on to the end of its line
          end = std::min(end, text_.find_first_of("\r\n", quote + 1));
          end = std::min(end, text_.size());
        }
        attribute.value = {quote + 1, end};
        at = is_whole ? end + 1 : end;
      } else {
        at = equals + 1;
      }
    }
    element.attributes.push_back(attribute);
  }
  element.start_tag.end = element.end = at;
  element.parent = open_.empty() ? kNone : open_.back();
  const std::size_t number = elements_.size();
  if (!open_.empty()) elements_[open_.back()].children.push_back(number);
  elements_.push_back(std::move(element));
  // What has no `>` yet has no children either: what follows are siblings.
  if (elements_.back().is_closed && !elements_.back().is_empty) {
    open_.push_back(number);
  }
  at_ = at;
}

void XmlScan::scan_end(std::size_t at) {
  const TextStretch name{at + 2, name_end(at + 2)};
  std::size_t end = skip_blanks(name.end);
  if (end < text_.size() && text_[end] == '>') ++end;
  at_ = end;
  for (std::size_t depth = open_.size(); depth-- > 0;) {
    ScannedElement& element = elements_[open_[depth]];
    if (text(element.name) != text(name)) continue;
    close_until(depth + 1, at);
    element.end_tag = {at, end};
    element.end_name = name;
    element.end = end;
    open_.pop_back();
    return;
  }
}

std::size_t XmlScan::around(std::size_t at) const {
  std::size_t found = kNone;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (elements_[i].start_tag.begin >= at) break;
    if (at < elements_[i].end) found = i;
  }
  return found;
}

std::size_t XmlScan::tag_at(std::size_t at) const {
  std::size_t found = kNone;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const ScannedElement& element = elements_[i];
    if (element.start_tag.begin > at) break;
    const bool is_before_end = element.is_closed ? at < element.start_tag.end
                                                 : at <= element.start_tag.end;
    const bool is_at_end = element.end_tag.size() > 0 &&
                           element.end_tag.begin <= at &&
                           at < element.end_tag.end;
    if (is_before_end || is_at_end) found = i;
  }
  return found;
}

const ScannedAttribute* XmlScan::attribute(std::size_t element,
                                           std::string_view wanted) const {
  for (const ScannedAttribute& each : elements_[element].attributes) {
    if (text(each.name) == wanted) return &each;
  }
  return nullptr;
}

std::string_view XmlScan::value(std::size_t element,
                                std::string_view wanted) const {
  const ScannedAttribute* found = attribute(element, wanted);
  return found == nullptr ? std::string_view() : text(found->value);
}

std::size_t XmlScan::tree_of(std::size_t element) const {
  while (element != kNone && name(element) != "BehaviorTree") {
    element = elements_[element].parent;
  }
  return element;
}

bool XmlScan::is_in_comment(std::size_t at) const {
  return std::ranges::any_of(comments_, [&](const TextStretch& part) {
    return part.begin < at && at < part.end;
  });
}

}  // namespace btcheck::lsp
