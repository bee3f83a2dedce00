// SPDX-License-Identifier: MIT
#include "lsp/names.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "lsp/texts/rule_words.hpp"
#include "model/btf/forms.hpp"
#include "text/utf8.hpp"

namespace btcheck::lsp {
namespace {

bool is_script(std::string_view attribute) {
  return attribute == "code" || attribute == "if" || attribute == "script" ||
         std::ranges::count(kBtcppConditionNames, attribute) > 0;
}

bool is_node_word(const XmlScan& scan, std::size_t element) {
  const std::size_t tree = scan.tree_of(element);
  return tree != kNone && tree != element;
}

// The ID of the tree that an element stands in.
std::string tree_id(const XmlScan& scan, std::size_t element) {
  const std::size_t tree = scan.tree_of(element);
  return tree == kNone ? std::string() : std::string(scan.value(tree, "ID"));
}

// Whether a SubTree shares the names of entries that it does not remap.
bool is_shared(const XmlScan& scan, std::size_t element) {
  const auto is_on = [&](std::string_view name) {
    const std::string_view value = scan.value(element, name);
    return value == "1" || equal_ignoring_case(value, "true");
  };
  return is_on("_autoremap") || is_on("__autoremap") ||
         is_on("__shared_blackboard");
}

bool is_remap(std::string_view attribute) {
  return attribute != "ID" && attribute != "name" &&
         !attribute.starts_with('_');
}

// Words of a script that are no part of a text in quotes.
void add_script_words(const XmlScan& scan, TextStretch value,
                      std::string_view name, std::vector<TextStretch>& to) {
  const std::string_view text = scan.text(value);
  bool is_quoted = false;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '\'') is_quoted = !is_quoted;
    if (is_quoted || !is_word_letter(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && is_word_letter(text[end])) ++end;
    const bool is_entity = at > 0 && text[at - 1] == '&';
    if (text.substr(at, end - at) == name && !is_entity) {
      to.push_back({value.begin + at, value.begin + end});
    }
    at = end;
  }
}

// --- What stands at a place ------------------------------------------------

std::optional<Named> entry_of(const XmlScan& scan, std::size_t element,
                              std::string name, TextStretch at) {
  if (name.empty()) return std::nullopt;
  if (name.starts_with('@')) {
    return Named{NameKind::Entry, name.substr(1), {at.begin + 1, at.end}, "@"};
  }
  return Named{NameKind::Entry, std::move(name), at, tree_id(scan, element)};
}

std::optional<Named> named_in_value(const XmlScan& scan, std::size_t element,
                                    const ScannedAttribute& attribute,
                                    std::size_t at) {
  const std::string_view name = scan.text(attribute.name);
  const std::string_view tag = scan.name(element);
  const TextStretch value = attribute.value;
  const std::string text(scan.text(value));
  if (name == "main_tree_to_execute" ||
      (name == "ID" && (tag == "BehaviorTree" || is_subtree(scan, element)))) {
    return Named{NameKind::Tree, text, value, {}};
  }
  if (name == "ID" && kind_named(tag)) {
    return Named{NameKind::Type, text, value, {}};
  }
  if (tag == "include" && name == "path") {
    return Named{NameKind::File, text, value, {}};
  }
  if (!is_node_word(scan, element)) return std::nullopt;
  if (name == "name") return Named{NameKind::Node, text, value, {}};
  if (const auto entry = entry_at(text, value.begin, at)) {
    return entry_of(scan, element, entry->name, entry->part);
  }
  if (is_script(name)) {
    const TextStretch word = word_at(text, at - value.begin);
    return entry_of(scan, element, text.substr(word.begin, word.size()),
                    {value.begin + word.begin, value.begin + word.end});
  }
  return std::nullopt;
}

std::optional<Named> named_in_xml(const View& view, std::size_t at) {
  const auto scan = view.document.text.parsed<XmlScan>();
  const std::size_t element = scan->tag_at(at);
  if (element == kNone || scan->is_in_comment(at)) return std::nullopt;
  const ScannedElement& found = (*scan)[element];
  for (const ScannedAttribute& each : found.attributes) {
    if (each.has_value && each.value.begin <= at && at <= each.value.end) {
      return named_in_value(*scan, element, each, at);
    }
    const std::string_view name = scan->text(each.name);
    if (each.name.begin <= at && at <= each.name.end &&
        is_subtree(*scan, element) && is_remap(name)) {
      return Named{NameKind::Entry, std::string(name), each.name,
                   std::string(scan->value(element, "ID"))};
    }
  }
  const std::string_view tag = scan->name(element);
  if (tag == "BehaviorTree" || is_subtree(*scan, element)) {
    const ScannedAttribute* id = scan->attribute(element, "ID");
    if (id == nullptr) return std::nullopt;
    return Named{
        NameKind::Tree, std::string(scan->text(id->value)), id->value, {}};
  }
  const bool is_in_name =
      (found.name.begin <= at && at <= found.name.end) ||
      (found.end_name.size() > 0 && found.end_name.begin <= at &&
       at <= found.end_name.end);
  if (!is_node_word(*scan, element) || !is_in_name) return std::nullopt;
  const std::string id(type_of(*scan, element));
  if (id.empty()) return std::nullopt;
  return Named{NameKind::Type, id, found.name, {}};
}

std::optional<Named> named_in_rules(const View& view, std::size_t at) {
  const FileText& text = view.document.text;
  const RuleWordHere here = rule_word_at(text, at);
  if (here.word.size() == 0 || here.is_behind_dot) return std::nullopt;
  const std::string word(here.word.in(text.text()));
  if (here.is_quoted && equal_ignoring_case(here.item, "tree")) {
    return Named{NameKind::File, word, here.word, {}};
  }
  for (const NamedLet& each : lets_of(text)) {
    if (equal_ignoring_case(each.name, word)) {
      return Named{NameKind::Let, word, here.word, {}};
    }
  }
  if (here.is_item_name) return std::nullopt;
  if (!nodes_named(view, here.node.in(text.text())).empty()) {
    return Named{NameKind::Node, word, here.word, {}};
  }
  if (const Look* look = described_look(view)) {
    for (const v1::Entry& entry : look->description->entries) {
      if (equal_ignoring_case(entry.name, word)) {
        return Named{NameKind::Entry, word, here.word, {}};
      }
    }
  }
  return std::nullopt;
}

std::optional<Named> named_in_forms(const View& view, std::size_t at) {
  const std::string& text = view.document.text.text();
  const TextStretch word = word_at(text, at);
  const std::string name(word.in(text));
  const bool is_keyword = word.begin > 0 && text[word.begin - 1] == ':';
  if (word.size() == 0 || is_keyword || !btf::is_name(name)) {
    return std::nullopt;
  }
  if (view.document.kind == FileKind::Leaves) {
    return Named{NameKind::Type, name, word, {}};
  }
  return Named{NameKind::Word, name, word, {}};
}

// --- All places ------------------------------------------------------------

class PlaceSearch {
 public:
  explicit PlaceSearch(const View& view)
      : view_(view), files_(tree_files(view)) {}

  std::vector<Place> search(const Named& named) {
    switch (named.kind) {
      case NameKind::Tree:
        add_tree(named.name);
        break;
      case NameKind::Type:
        add_type(named.name);
        break;
      case NameKind::Node:
        add_node(named);
        break;
      case NameKind::Entry:
        add_entry(named);
        break;
      case NameKind::Let:
        add_let(named.name);
        break;
      case NameKind::Word:
        add_word(named.name);
        break;
      case NameKind::File:
        break;
    }
    std::ranges::sort(found_, {}, &Place::key);
    const auto is_same = [](const Place& one, const Place& other) {
      return one.key() == other.key();
    };
    found_.erase(std::unique(found_.begin(), found_.end(), is_same),
                 found_.end());
    return std::move(found_);
  }

 private:
  template <class Visit>
  void each_element(Visit visit) {
    for (const ScannedFile& file : files_) {
      for (std::size_t i = 0; i < file.scan->elements().size(); ++i) {
        visit(file, *file.scan, i);
      }
    }
  }
  void add(const std::string& path, TextStretch part, bool is_declared = false,
           bool is_written = false) {
    found_.push_back({path, part, is_declared, is_written});
  }

  // In the files of rules about the trees of the document.
  template <class Visit>
  void each_rules(Visit visit) {
    std::set<std::string> all;
    for (const Look& look : view_.looks) {
      if (!look.subject.rules.empty()) all.insert(look.subject.rules);
    }
    for (const std::string& path : all) {
      if (const FileText* text = view_.text(path)) visit(path, *text);
    }
  }
  void add_rule_names(std::string_view name) {
    each_rules([&](const std::string& path, const FileText& text) {
      for (const TextStretch& part : rule_names(text, name)) add(path, part);
    });
  }

  void add_tree(std::string_view id) {
    each_element(
        [&](const ScannedFile& file, const XmlScan& scan, std::size_t i) {
          const std::string_view tag = scan.name(i);
          const bool is_tree = tag == "BehaviorTree";
          const bool names_it = is_tree || is_subtree(scan, i);
          const ScannedAttribute* attribute =
              scan.attribute(i, names_it ? "ID" : "main_tree_to_execute");
          if (attribute != nullptr && scan.text(attribute->value) == id) {
            add(file.path, attribute->value, is_tree);
          }
        });
    add_rule_names(id);
  }

  void add_type(std::string_view id) {
    each_element(
        [&](const ScannedFile& file, const XmlScan& scan, std::size_t i) {
          const ScannedAttribute* attribute = scan.attribute(i, "ID");
          if (kind_named(scan.name(i)) && !is_subtree(scan, i)) {
            if (attribute != nullptr && scan.text(attribute->value) == id) {
              add(file.path, attribute->value, !is_node_word(scan, i));
            }
          } else if (is_node_word(scan, i) && scan.name(i) == id) {
            add(file.path, scan[i].name);
            if (scan[i].end_name.size() > 0) add(file.path, scan[i].end_name);
          }
        });
    for (const auto& [path, text] : *view_.texts) {
      if (kind_of(path, {}) != FileKind::Leaves) continue;
      for (const TextStretch& part : form_words(text, id)) {
        add(path, part, true);
      }
    }
  }

  // Names may be used twice: then a rule says the line, and each is its own.
  void add_node(const Named& named) {
    const auto nodes = nodes_named(view_, named.name);
    std::set<std::pair<std::string, std::size_t>> places;
    for (const NodeHere& here : nodes) {
      const auto at = view_.now(here.node().where, here.look->described);
      if (at) places.emplace(here.node().where.file, at->begin);
    }
    const bool is_here = view_.document.kind == FileKind::Xml;
    for (const auto& [path, begin] : places) {
      const FileText* text = view_.text(path);
      if (text == nullptr) continue;
      const auto scan = text->parsed<XmlScan>();
      const std::size_t element = scan->tag_at(begin);
      if (element == kNone) continue;
      const ScannedAttribute* name = scan->attribute(element, "name");
      if (name == nullptr || scan->text(name->value) != named.name) continue;
      const bool is_this =
          path == view_.document.path && name->value.begin == named.at.begin;
      if (!is_here || is_this || places.size() == 1) {
        add(path, name->value, true);
      }
    }
    if (is_here) add(view_.document.path, named.at, true);
    if (places.size() <= 1) {
      add_rule_names(named.name);
      for (const auto& [path, text] : *view_.texts) {
        if (kind_of(path, {}) != FileKind::Leaves) continue;
        for (const TextStretch& part : form_words(text, named.name)) {
          add(path, part);
        }
      }
    } else if (!is_here) {
      add(view_.document.path, named.at);
    }
  }

  void add_let(std::string_view name) {
    const auto lets = lets_of(view_.document.text);
    for (const TextStretch& part : rule_names(view_.document.text, name)) {
      const bool is_let = std::ranges::any_of(lets, [&](const NamedLet& each) {
        return each.at.begin == part.begin;
      });
      add(view_.document.path, part, is_let);
    }
  }

  // Words of a .btf file or of contracts, whatever their case.
  static std::vector<TextStretch> form_words(const FileText& text,
                                             std::string_view name) {
    const auto parsed = text.parsed<btf::ParsedForms>();
    const auto lines = text.parsed<Lines>();
    const std::string key = btf::name_key(name);
    std::vector<TextStretch> all;
    for (const btf::Token& token : parsed->forms.tokens) {
      if (token.kind != btf::FormKind::Word &&
          token.kind != btf::FormKind::Quoted) {
        continue;
      }
      const TextStretch part = lines->stretch(token.span);
      std::string_view word = token.text;
      std::size_t skipped = 0;
      if (token.kind == btf::FormKind::Quoted && word.size() >= 2) {
        word = word.substr(1, word.size() - 2);
        skipped = 1;
      } else if (word.starts_with('$')) {
        word.remove_prefix(1);
        skipped = 1;
      }
      // `NODE.rstatus`, `NODE.x`
      const std::string_view first = word.substr(0, word.find('.'));
      for (const std::string_view each : {word, first}) {
        if (btf::name_key(each) != key) continue;
        all.push_back(
            {part.begin + skipped, part.begin + skipped + each.size()});
        break;
      }
    }
    return all;
  }

  void add_word(std::string_view name) {
    const auto words = form_words(view_.document.text, name);
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::string_view before =
          std::string_view(view_.document.text.text())
              .substr(0, words[i].begin);
      const std::size_t mark = before.find_last_not_of(" \t\n\r");
      const bool is_declared =
          mark != before.npos &&
          (before.substr(0, mark + 1).ends_with(":name") ||
           before.substr(0, mark + 1).ends_with("defsv") ||
           before.substr(0, mark + 1).ends_with("defaction") ||
           before.substr(0, mark + 1).ends_with("defcondition"));
      add(view_.document.path, words[i], is_declared);
    }
    add_rule_names(name);
  }

  // --- Entries ---

  // In which trees the entry has the same name: those that share it.
  void find_scope(const Named& named) {
    scope_.insert(named.tree);
    for (bool grows = true; grows;) {
      grows = false;
      each_element([&](const ScannedFile&, const XmlScan& scan, std::size_t i) {
        if (!is_subtree(scan, i) || !is_node_word(scan, i) ||
            !is_shared(scan, i) || scan.attribute(i, named.name) != nullptr) {
          return;
        }
        const std::string caller = tree_id(scan, i);
        const std::string called(scan.value(i, "ID"));
        if (scope_.contains(caller) == scope_.contains(called)) return;
        scope_.insert(caller);
        scope_.insert(called);
        grows = true;
      });
    }
  }

  void add_entry(const Named& named) {
    const bool is_global = named.tree == "@";
    // Of a rule: wherever an entry has the name.
    const bool is_anywhere =
        named.tree.empty() && view_.document.kind == FileKind::Rules;
    if (!is_global && !is_anywhere) find_scope(named);
    each_element([&](const ScannedFile& file, const XmlScan& scan,
                     std::size_t i) {
      if (!is_node_word(scan, i)) return add_model(file, scan, i, named);
      const bool is_in =
          is_anywhere || is_global || scope_.contains(tree_id(scan, i));
      const bool calls =
          is_subtree(scan, i) &&
          (is_anywhere || scope_.contains(std::string(scan.value(i, "ID"))));
      for (const ScannedAttribute& each : scan[i].attributes) {
        const std::string_view attribute = scan.text(each.name);
        if (calls && is_remap(attribute) && attribute == named.name) {
          add(file.path, each.name);
        }
        if (is_in) add_uses(file, scan, i, each, named, is_global);
      }
    });
    add_rule_names(named.name);
    for (const auto& [path, text] : *view_.texts) {
      if (kind_of(path, {}) != FileKind::Leaves) continue;
      for (const TextStretch& part : form_words(text, named.name)) {
        add(path, part);
      }
    }
  }

  // The port of a SubTree in <TreeNodesModel>.
  void add_model(const ScannedFile& file, const XmlScan& scan, std::size_t i,
                 const Named& named) {
    const std::size_t parent = scan[i].parent;
    if (parent == kNone || scan.name(parent) != "SubTree" ||
        !scope_.contains(std::string(scan.value(parent, "ID")))) {
      return;
    }
    const ScannedAttribute* name = scan.attribute(i, "name");
    if (name != nullptr && scan.text(name->value) == named.name) {
      add(file.path, name->value);
    }
  }

  void add_uses(const ScannedFile& file, const XmlScan& scan, std::size_t i,
                const ScannedAttribute& attribute, const Named& named,
                bool is_global) {
    const std::string_view value = scan.text(attribute.value);
    const std::string wanted =
        is_global ? "{@" + named.name + "}" : "{" + named.name + "}";
    const std::size_t mark = is_global ? 2 : 1;
    for (std::size_t at = value.find(wanted); at != value.npos;
         at = value.find(wanted, at + 1)) {
      const std::size_t begin = attribute.value.begin + at + mark;
      add(file.path, {begin, begin + named.name.size()}, false,
          is_output(scan, i, scan.text(attribute.name)));
    }
    // `{=}`: the entry of the port's own name.
    if (is_script(scan.text(attribute.name))) {
      std::vector<TextStretch> words;
      add_script_words(scan, attribute.value, named.name, words);
      for (const TextStretch& each : words) {
        const std::string_view text =
            scan.text({each.end, std::min(attribute.value.end, each.end + 4)});
        const std::size_t sign = text.find_first_not_of(' ');
        const bool is_assigned =
            sign != text.npos &&
            (text.substr(sign).starts_with(":=") ||
             (text[sign] == '=' && !text.substr(sign).starts_with("==")));
        add(file.path, each, false, is_assigned);
      }
    }
  }

  bool is_output(const XmlScan& scan, std::size_t element,
                 std::string_view port) {
    const std::string id(type_of(scan, element));
    const auto [known, is_new] = types_.try_emplace(id);
    if (is_new) known->second = type_named(view_, id);
    const PortWord* word = known->second ? known->second->port(port) : nullptr;
    return word != nullptr &&
           (word->direction == "output" || word->direction == "inout");
  }

  const View& view_;
  const std::vector<ScannedFile> files_;
  std::map<std::string, std::optional<TypeWord>> types_;
  std::set<std::string> scope_;
  std::vector<Place> found_;
};

}  // namespace

std::optional<Named> named_at(const View& view, std::size_t at) {
  switch (view.document.kind) {
    case FileKind::Xml:
      return named_in_xml(view, at);
    case FileKind::Rules:
      return named_in_rules(view, at);
    case FileKind::Btf:
    case FileKind::Leaves:
      return named_in_forms(view, at);
    case FileKind::Other:
      break;
  }
  return std::nullopt;
}

std::vector<Place> places_of(const View& view, const Named& named) {
  return PlaceSearch(view).search(named);
}

}  // namespace btcheck::lsp
