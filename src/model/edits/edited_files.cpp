// SPDX-License-Identifier: MIT
//
// Edits are made one after the other, each on the text that the last one left,
// so that none has to know of another. Places name the text as it was at first:
// each change is remembered, and offsets are carried through all of them. What
// is put in at a byte pushes it on; what replaces it leaves it where it is.
#include "model/edits/edited_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "model/btcpp/document.hpp"
#include "model/edits/node_text.hpp"
#include "model/tree_file.hpp"

namespace btcheck {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

// The blanks that the line of a byte begins with.
std::string indent_at(std::string_view text, std::size_t at) {
  const std::size_t line = text.rfind('\n', at == 0 ? 0 : at - 1);
  const std::size_t begin = line == text.npos || at == 0 ? 0 : line + 1;
  std::size_t end = begin;
  while (end < text.size() && is_blank(text[end])) ++end;
  return std::string(text.substr(begin, end - begin));
}

std::string line_end_of(std::string_view text) {
  const std::size_t end = text.find('\n');
  const bool is_long = end != text.npos && end > 0 && text[end - 1] == '\r';
  return is_long ? "\r\n" : "\n";
}

// Every line but the first begins with `from`: it begins with `to` then. What
// is less far in is left as it is.
std::string indented(std::string_view text, std::string_view from,
                     std::string_view to) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    result += text.substr(0, end);
    text.remove_prefix(end);
    const bool is_empty = text.empty() || text[0] == '\n' || text[0] == '\r';
    if (is_empty || !text.starts_with(from)) continue;
    result += to;
    text.remove_prefix(from.size());
  }
  return result;
}

std::string replaced(std::string text, std::string_view from,
                     std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos;
       at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string escaped(std::string_view value, char quote) {
  std::string text = replaced(std::string(value), "&", "&amp;");
  text = replaced(std::move(text), "<", "&lt;");
  text = replaced(std::move(text), ">", "&gt;");
  return quote == '"' ? replaced(std::move(text), "\"", "&quot;")
                      : replaced(std::move(text), "'", "&apos;");
}

}  // namespace

// Makes single edits.
class EditPen {
 public:
  explicit EditPen(EditedFiles& files) : files_(files) {}

  bool operator()(const SetAttribute& edit) {
    const auto node = find(edit.node);
    if (!node) return false;
    if (const AttributeText* there = node->attribute(edit.name)) {
      const char quote = is_xml() ? text()[there->value.end] : ' ';
      replace(there->value, is_xml() ? escaped(edit.value, quote) : edit.value);
    } else {
      insert(node->next_attribute, attribute(edit.name, edit.value));
    }
    return true;
  }

  bool operator()(const RemoveAttribute& edit) {
    const auto node = find(edit.node);
    const AttributeText* there = node ? node->attribute(edit.name) : nullptr;
    if (there == nullptr) return false;
    remove(*there);
    return true;
  }

  bool operator()(const ReplaceInAttributes& edit) {
    const auto node = find(edit.node);
    bool is_there = false;
    if (!node) return false;
    for (auto each = node->attributes.rbegin(); each != node->attributes.rend();
         ++each) {
      const std::string value(each->value.in(text()));
      const std::string changed = replaced(value, edit.from, edit.to);
      if (changed == value) continue;
      replace(each->value, changed);
      is_there = true;
    }
    return is_there;
  }

  bool operator()(const ReplaceWord& edit) {
    const auto at = begin_of(edit.word);
    if (!at || text().compare(*at, edit.from.size(), edit.from) != 0) {
      return false;
    }
    replace({*at, *at + edit.from.size()}, edit.to);
    return true;
  }

  // <Control ID="Sequence"> becomes <Fallback>: the short form fits any type.
  bool operator()(const ChangeType& edit) {
    const auto node = find(edit.node);
    if (!node) return false;
    const AttributeText* id = node->attribute("ID");
    const bool is_explicit = is_xml() && id != nullptr &&
                             kind_named(node->type.in(text())).has_value();
    if (node->end_type) replace(*node->end_type, edit.type);
    if (is_explicit) remove(*id);
    replace(node->type, edit.type);
    return true;
  }

  bool operator()(const WrapNodes& edit) {
    const auto first = find(edit.first);
    const auto last = find(edit.last);
    if (!first || !last || last->whole.end < first->whole.end) return false;
    const TextStretch part{first->whole.begin, last->whole.end};
    const std::string indent = indent_at(text(), part.begin);
    const std::string next_line = line_end() + indent + kStep;
    std::string begin = opened(edit.in) + next_line;
    for (const NewNode& each : edit.before) {
      begin += written(each, indent + kStep) + next_line;
    }
    std::string end;
    for (const NewNode& each : edit.behind) {
      end += next_line + written(each, indent + kStep);
    }
    insert(part.end, end + closed(edit.in, indent));
    change_lines(part, indent, indent + kStep);
    insert(part.begin, begin);
    return true;
  }

  bool operator()(const UnwrapNode& edit) {
    const auto node = find(edit.node);
    if (!node || !node->inside) return false;
    const std::string from = indent_at(text(), node->inside->begin);
    const std::string to = indent_at(text(), node->whole.begin);
    replace({node->inside->end, node->whole.end}, "");
    change_lines(*node->inside, from, to);
    replace({node->whole.begin, node->inside->begin}, "");
    return true;
  }

  bool operator()(const InsertBefore& edit) {
    const auto node = find(edit.node);
    if (!node) return false;
    const std::string indent = indent_at(text(), node->whole.begin);
    insert(node->whole.begin, written(edit.what, indent) + line_end() + indent);
    return true;
  }

  bool operator()(const MoveBefore& edit) {
    const auto node = find(edit.node);
    const auto before = find(edit.before);
    if (!node || !before) return false;
    const std::string moved(node->whole.in(text()));
    const std::string gap = line_end() + indent_at(text(), before->whole.begin);
    replace(with_line(node->whole), "");
    const auto there = find(edit.before);
    insert(there->whole.begin, moved + gap);
    return true;
  }

 private:
  inline static const std::string kStep = "  ";

  const std::string& text() const { return files_.files_[file_].text; }
  bool is_xml() const {
    return btcheck::is_xml(files_.files_[file_].name, text());
  }
  std::string line_end() const { return line_end_of(text()); }

  // Turns to the file of the place.
  std::optional<std::size_t> begin_of(const SourcePlace& place) {
    const auto file = files_.file_named(place.file);
    if (!file) return std::nullopt;
    file_ = *file;
    return files_.offset(file_, place);
  }

  std::optional<NodeText> find(const SourcePlace& place) {
    const auto at = begin_of(place);
    if (!at) return std::nullopt;
    const FileText& file = files_.files_[file_].text;
    return is_xml() ? xml_node_at(file, *at) : btf_node_at(file, *at);
  }

  void replace(TextStretch part, const std::string& with) {
    files_.replace(file_, part, with);
  }
  // With the blanks before it.
  void remove(const AttributeText& attribute) {
    std::size_t begin = attribute.whole.begin;
    while (is_blank(text()[begin - 1])) --begin;
    replace({begin, attribute.whole.end}, "");
  }
  void insert(std::size_t at, const std::string& what) {
    replace({at, at}, what);
  }

  // A whole line where nothing else stands in it.
  TextStretch with_line(TextStretch part) const {
    TextStretch line = part;
    while (line.begin > 0 && is_blank(text()[line.begin - 1])) --line.begin;
    while (line.end < text().size() && is_blank(text()[line.end])) ++line.end;
    const bool begins = line.begin > 0 && text()[line.begin - 1] == '\n';
    if (!begins || line.end >= text().size()) return part;
    if (text()[line.end] == '\r') ++line.end;
    if (text()[line.end] != '\n') return part;
    ++line.end;
    return line;
  }

  // From the last to the first, so that the places before stay.
  void change_lines(TextStretch part, std::string_view from,
                    std::string_view to) {
    for (std::size_t at = part.end; at > part.begin;) {
      at = text().rfind('\n', at - 1);
      if (at == std::string::npos || at < part.begin) return;
      const std::string_view line = std::string_view(text()).substr(at + 1);
      const bool is_empty = line[0] == '\n' || line[0] == '\r';
      if (is_empty || !line.starts_with(from)) continue;
      replace({at + 1, at + 1 + from.size()}, std::string(to));
    }
  }

  std::string attribute(std::string_view name, std::string_view value) const {
    return is_xml() ? fmt::format(" {}=\"{}\"", name, escaped(value, '"'))
                    : fmt::format(" :{} {}", name, value);
  }
  std::string head(const NewNode& node) const {
    std::string written = (is_xml() ? "<" : "(") + node.type;
    for (const auto& [name, value] : node.attributes) {
      written += attribute(name, value);
    }
    return written;
  }
  std::string opened(const NewNode& node) const {
    return head(node) + (is_xml() ? ">" : "");
  }
  // Below what is inside.
  std::string closed(const NewNode& node, const std::string& indent) const {
    return is_xml() ? line_end() + indent + "</" + node.type + ">" : ")";
  }

  std::string written(const NewNode& node, const std::string& indent) {
    if (!node.child) return head(node) + (is_xml() ? "/>" : ")");
    const std::size_t here = file_;
    std::string child = copied(*node.child, indent + kStep);
    file_ = here;
    return opened(node) + line_end() + indent + kStep + child +
           closed(node, indent);
  }

  std::string copied(const SourcePlace& place, const std::string& indent) {
    const auto node = find(place);
    if (!node) return {};
    const std::string from = indent_at(text(), node->whole.begin);
    return indented(node->whole.in(text()), from, indent);
  }

  EditedFiles& files_;
  std::size_t file_ = 0;
};

EditedFiles::EditedFiles(std::vector<InputFile> files)
    : originals_(files), files_(std::move(files)) {}

bool EditedFiles::apply(const Repair& repair) {
  EditPen pen(*this);
  return std::ranges::all_of(
      repair, [&](const TreeEdit& edit) { return std::visit(pen, edit); });
}

std::optional<SourcePlace> EditedFiles::moved(const SourcePlace& before) const {
  const auto file = file_named(before.file);
  const auto at = file ? offset(*file, before) : std::nullopt;
  if (!at) return std::nullopt;
  const SourceText now(files_[*file].name, files_[*file].text);
  const SourceSpan span = now.span(*at, *at + 1);
  return SourcePlace{before.file, span.line, span.column};
}

std::optional<std::size_t> EditedFiles::file_named(
    std::string_view name) const {
  const auto found = std::ranges::find(files_, name, &InputFile::name);
  if (found == files_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - files_.begin());
}

std::optional<std::size_t> EditedFiles::offset(std::size_t file,
                                               const SourcePlace& place) const {
  const SourceText original(originals_[file].name, originals_[file].text);
  auto at = original.offset(place.line, place.column);
  if (!at) return std::nullopt;
  for (const Change& change : changes_) {
    const auto& [begin, end] = change.part;
    if (change.file != file || *at < begin) continue;
    const bool is_behind = *at >= end;
    at = is_behind ? *at - (end - begin) + change.new_size : begin;
  }
  return at;
}

void EditedFiles::replace(std::size_t file, TextStretch part,
                          const std::string& text) {
  std::string edited = files_[file].text;
  edited.replace(part.begin, part.size(), text);
  files_[file].text = std::move(edited);
  changes_.push_back({file, part, text.size()});
}

}  // namespace btcheck
