// SPDX-License-Identifier: MIT
//
// Each tag has a line of its own, and so has a comment, but for one behind a
// tag in its line. Where an element has text or CDATA in it, all that is in it
// stays as it is; and so does what stands behind the root, from the first tag
// on: nobody reads it.
#include "style/xml.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "style/attributes.hpp"
#include "style/lines.hpp"
#include "text/utf8.hpp"

namespace btcheck::style {
namespace {

using btcpp::XmlAttribute;
using btcpp::XmlElement;

constexpr std::string_view kXmlBlanks = " \t\r\n\f\v";

// What stands between two tags.
struct Piece {
  enum class Kind : unsigned char {
    Comment,
    Instruction,  // <?…?>, <!…>
    Text,         // and CDATA
    Rest          // from a tag on
  };
  Kind kind = Kind::Text;
  std::string_view text;
  int breaks = 0;  // before it
};

struct Between {
  std::vector<Piece> pieces;
  int breaks = 0;  // behind the last one

  bool has(Piece::Kind kind) const {
    return std::ranges::count(pieces, kind, &Piece::kind) > 0;
  }
};

Piece piece_at(std::string_view text) {
  using Form = std::pair<std::string_view, std::string_view>;
  using enum Piece::Kind;
  constexpr std::pair<Form, Piece::Kind> kForms[] = {
      {{"<!--", "-->"}, Comment},
      {{"<![CDATA[", "]]>"}, Text},
      {{"<?", "?>"}, Instruction},
      {{"<!", ">"}, Instruction}};
  for (const auto& [form, kind] : kForms) {
    if (!text.starts_with(form.first)) continue;
    const std::size_t end = text.find(form.second, form.first.size());
    return {kind,
            text.substr(0, end == text.npos ? end : end + form.second.size())};
  }
  if (text.starts_with('<')) return {Rest, text};
  return {Text, text.substr(0, text.find('<'))};
}

Between between(std::string_view text) {
  Between found;
  while (!text.empty()) {
    if (kXmlBlanks.find(text.front()) != kXmlBlanks.npos) {
      if (text.front() == '\n') ++found.breaks;
      text.remove_prefix(1);
      continue;
    }
    Piece piece = piece_at(text);
    text.remove_prefix(piece.text.size());
    piece.breaks = std::exchange(found.breaks, 0);
    found.pieces.push_back(piece);
  }
  return found;
}

class XmlWriter {
 public:
  XmlWriter(std::string_view text, const std::vector<XmlElement>& elements,
            const KeepsLines& keeps_lines)
      : text_(text),
        elements_(elements),
        keeps_lines_(keeps_lines),
        order_(elements),
        lines_(text) {}

  std::string write() {
    const TextStretch root = elements_[0].start_tag;
    const std::size_t from = text_.starts_with(kByteOrderMark) ? 3 : 0;
    const int breaks = add_around({from, root.begin});
    add_element(0, 0, breaks);
    add_around({elements_[0].end_tag.end, text_.size()});
    return lines_.take();
  }

 private:
  std::string_view part(std::size_t begin, std::size_t end) const {
    return text_.substr(begin, end - begin);
  }

  // What is outside of the root.
  int add_around(TextStretch stretch) {
    const Between found = between(stretch.in(text_));
    for (const Piece& piece : found.pieces) {
      if (piece.kind != Piece::Kind::Text && piece.kind != Piece::Kind::Rest) {
        add(piece, 0);
        continue;
      }
      std::string_view rest = stretch.in(text_);
      rest.remove_prefix(
          static_cast<std::size_t>(piece.text.data() - rest.data()));
      lines_.begin(0, piece.breaks);
      lines_.add(rest.substr(0, rest.find_last_not_of(kXmlBlanks) + 1));
      return 0;
    }
    return found.breaks;
  }

  void add(const Piece& piece, int indent) {
    const bool is_behind = piece.kind == Piece::Kind::Comment &&
                           piece.breaks == 0 && !lines_.is_empty();
    if (is_behind) {
      lines_.add(" ");
    } else {
      lines_.begin(indent, piece.breaks);
    }
    lines_.add(piece.text);
  }

  void add_element(std::size_t at, int indent, int breaks) {
    const XmlElement& element = elements_[at];
    lines_.begin(indent, breaks);
    add_start_tag(at);
    const TextStretch inside = {element.start_tag.end, element.end_tag.begin};
    if (has_no_end_tag(element)) return;
    if (has_text(element)) {
      lines_.add(inside.in(text_));
    } else if (const auto last = add_inside(element, indent)) {
      lines_.begin(indent, *last);
    }
    lines_.add("</" + element.name + ">");
  }

  static bool has_no_end_tag(const XmlElement& element) {
    return element.end_tag.size() == 0;
  }

  // The line breaks at its end; nothing where there is nothing in it.
  std::optional<int> add_inside(const XmlElement& element, int indent) {
    std::size_t at = element.start_tag.end;
    int breaks = 0;
    bool is_filled = false;
    const auto add_until = [&](std::size_t end) {
      const Between found = between(part(at, end));
      for (const Piece& piece : found.pieces) add(piece, indent + kIndent);
      is_filled = is_filled || !found.pieces.empty();
      breaks = found.breaks;
    };
    for (const std::size_t child : element.children) {
      add_until(elements_[child].start_tag.begin);
      add_element(child, indent + kIndent, breaks);
      at = elements_[child].end_tag.end;
      is_filled = true;
    }
    add_until(element.end_tag.begin);
    return is_filled ? std::optional(breaks) : std::nullopt;
  }

  bool has_text(const XmlElement& element) const {
    std::size_t at = element.start_tag.end;
    for (const std::size_t child : element.children) {
      const auto before = part(at, elements_[child].start_tag.begin);
      if (between(before).has(Piece::Kind::Text)) return true;
      at = elements_[child].end_tag.end;
    }
    return between(part(at, element.end_tag.begin)).has(Piece::Kind::Text);
  }

  void add_start_tag(std::size_t at) {
    const XmlElement& element = elements_[at];
    const auto attributes = order_.of(at);
    std::vector<std::string> written;
    bool is_long = false;
    int width = lines_.column() + 1 + count_code_points(element.name) +
                (has_no_end_tag(element) ? 2 : 1);
    for (const XmlAttribute* each : attributes) {
      const std::string_view value = each->value_part.in(text_);
      const char quote = value.find('"') == value.npos ? '"' : '\'';
      written.push_back(each->name + "=" + quote + std::string(value) + quote);
      width += 1 + count_code_points(written.back());
      is_long = is_long || value.find('\n') != value.npos;
    }
    is_long = is_long || width > kWidth;
    if (keeps_lines_(element)) {
      const std::string_view as_written = element.start_tag.in(text_);
      if (as_written.find('\n') != as_written.npos) {
        return lines_.add(as_written);
      }
      is_long = false;
    }
    lines_.add("<" + element.name);
    const int column = lines_.column() + 1;
    for (std::size_t i = 0; i < written.size(); ++i) {
      if (i == 0 || !is_long) {
        lines_.add(" ");
      } else {
        lines_.begin(column, 1);
      }
      lines_.add(written[i]);
    }
    lines_.add(has_no_end_tag(element) ? "/>" : ">");
  }

  std::string_view text_;
  const std::vector<XmlElement>& elements_;
  const KeepsLines& keeps_lines_;
  AttributeOrder order_;
  Lines lines_;
};

void say_between(std::string_view text, std::vector<std::string>& to) {
  for (const Piece& piece : between(text).pieces) {
    const std::size_t end = piece.text.find_last_not_of(kXmlBlanks) + 1;
    to.emplace_back(piece.text.substr(0, end));
  }
}

}  // namespace

std::string styled_xml(std::string_view text,
                       const std::vector<XmlElement>& elements,
                       const KeepsLines& keeps_lines) {
  return XmlWriter(text, elements, keeps_lines).write();
}

std::vector<std::string> said_in_xml(std::string_view text,
                                     const std::vector<XmlElement>& elements) {
  std::vector<std::string> said;
  std::size_t at = 0;
  std::vector<std::size_t> open;
  const auto close = [&](std::size_t number) {
    const XmlElement& element = elements[number];
    say_between(text.substr(at, element.end_tag.begin - at), said);
    said.push_back("</" + element.name);
    at = element.end_tag.end;
  };
  for (std::size_t number = 0; number < elements.size(); ++number) {
    const XmlElement& element = elements[number];
    while (!open.empty() && open.back() != element.parent) {
      close(open.back());
      open.pop_back();
    }
    say_between(text.substr(at, element.start_tag.begin - at), said);
    said.push_back("<" + element.name);
    std::vector<std::string> attributes;
    for (const XmlAttribute& each : element.attributes) {
      attributes.push_back(each.name + '=' +
                           std::string(each.value_part.in(text)));
    }
    std::ranges::sort(attributes);
    std::ranges::move(attributes, std::back_inserter(said));
    at = element.start_tag.end;
    open.push_back(number);
  }
  for (; !open.empty(); open.pop_back()) close(open.back());
  say_between(text.substr(at), said);
  return said;
}

}  // namespace btcheck::style
