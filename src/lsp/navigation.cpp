// SPDX-License-Identifier: MIT
//
// From a name to where it is said, and to all who use it; the same name,
// changed everywhere.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "lsp/features.hpp"
#include "lsp/names.hpp"
#include "model/btf/forms.hpp"
#include "model/tree_file.hpp"
#include "text/utf8.hpp"

namespace btcheck::lsp {
namespace {

Json location(const View& view, const std::string& path, TextStretch part) {
  return {{"uri", view.uri(path)},
          {"range", json_of(view.range_in(path, part))}};
}

void add_node_places(const View& view, const Look& look,
                     const std::vector<std::size_t>& nodes, Json& to,
                     std::set<std::pair<std::string, std::size_t>>& seen) {
  for (const std::size_t each : nodes) {
    const v1::Position& where = look.description->nodes[each].where;
    const auto at = view.now(where, look.described);
    if (at && seen.emplace(where.file, at->begin).second) {
      to.push(location(view, where.file, *at));
    }
  }
}

// Who writes an entry: as it is written here, or in another tree by another
// name.
Json writers(const View& view, const Named& named) {
  Json all = Json::array();
  for (const Place& each : places_of(view, named)) {
    if (each.is_written) all.push(location(view, each.path, each.part));
  }
  if (!all.is_empty()) return all;
  std::set<std::pair<std::string, std::size_t>> seen;
  std::vector<NodeHere> users;
  if (view.document.kind == FileKind::Xml) {
    const auto scan = view.document.text.parsed<XmlScan>();
    const std::size_t element = scan->tag_at(named.at.begin);
    if (element != kNone) {
      users = nodes_at(view, view.document.path, (*scan)[element].name.begin);
    }
  }
  for (const NodeHere& here : users) {
    const std::size_t found = entry_of(here, named.name);
    if (found == kNone) continue;
    add_node_places(view, *here.look,
                    here.look->description->entries[found].writers, all, seen);
  }
  if (!users.empty()) return all;
  for (const Look& look : view.looks) {
    if (!look.description) continue;
    for (const v1::Entry& entry : look.description->entries) {
      if (equal_ignoring_case(entry.name, named.name)) {
        add_node_places(view, look, entry.writers, all, seen);
      }
    }
  }
  return all;
}

std::size_t offset_of(const View& view, Position place) {
  return view.lines->offset(place, view.encoding);
}

}  // namespace

Json definitions(const View& view, Position place) {
  const auto named = named_at(view, offset_of(view, place));
  if (!named) return Json::null();
  if (named->kind == NameKind::Entry) return writers(view, *named);
  Json all = Json::array();
  if (named->kind == NameKind::File) {
    const std::string path = included_name(view.document.path, named->name);
    if (view.text(path) != nullptr) all.push(location(view, path, {0, 0}));
    return all;
  }
  if (named->kind == NameKind::Node && view.document.kind == FileKind::Rules) {
    std::set<std::pair<std::string, std::size_t>> seen;
    for (const NodeHere& here : nodes_named(view, named->name)) {
      add_node_places(view, *here.look, {here.number}, all, seen);
    }
    return all;
  }
  for (const Place& each : places_of(view, *named)) {
    if (each.is_declared) all.push(location(view, each.path, each.part));
  }
  return all;
}

Json references(const View& view, Position place, bool with_declaration) {
  const auto named = named_at(view, offset_of(view, place));
  Json all = Json::array();
  if (!named) return all;
  for (const Place& each : places_of(view, *named)) {
    if (each.is_declared && !with_declaration) continue;
    all.push(location(view, each.path, each.part));
  }
  return all;
}

Json highlights(const View& view, Position place) {
  constexpr int kRead = 2;
  constexpr int kWrite = 3;
  const auto named = named_at(view, offset_of(view, place));
  Json all = Json::array();
  if (!named) return all;
  for (const Place& each : places_of(view, *named)) {
    if (each.path != view.document.path) continue;
    all.push(
        Json{{"range", json_of(view.range(each.part))},
             {"kind", each.is_written || each.is_declared ? kWrite : kRead}});
  }
  return all;
}

Json rename_place(const View& view, Position place) {
  const auto named = named_at(view, offset_of(view, place));
  if (!named || named->kind == NameKind::Type ||
      named->kind == NameKind::File || named->name.empty()) {
    return Json::null();
  }
  return {{"range", json_of(view.range(named->at))},
          {"placeholder", named->name}};
}

namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw RpcError(rpc::kInvalidParams, why);
}

bool is_identifier(std::string_view name) {
  return !name.empty() && !is_digit(name[0]) &&
         std::ranges::all_of(name, [](char c) { return is_word_letter(c); });
}

// As it stands in a file of rules: in quotes where it needs them.
std::string in_rules(const std::string& name, bool is_quoted) {
  return is_quoted || is_identifier(name) ? name : fmt::format("\"{}\"", name);
}

void refuse_name(const Named& named, const std::string& name) {
  if (name.empty()) refuse("a name is needed");
  if (unbroken(name) != name || name.find_first_of("\"'<>&") != name.npos) {
    refuse("a name has no quotes, no `<`, `>` and `&`, and one line");
  }
  const bool is_word =
      named.kind == NameKind::Entry || named.kind == NameKind::Let;
  if (is_word && !is_identifier(name)) {
    refuse(fmt::format("`{}` has letters, digits and `_` only, no digit first",
                       named.name));
  }
  if (named.kind == NameKind::Word && !btf::is_name(name)) {
    refuse(fmt::format("`{}` is no name in a .btf file", name));
  }
}

// Two things that have one name from then on are one thing.
void refuse_taken(const View& view, const Named& named,
                  const std::string& name) {
  Named other = named;
  other.name = name;
  if (named.kind == NameKind::Node) {
    if (!nodes_named(view, name).empty()) {
      refuse(fmt::format("there is a node `{}` already", name));
    }
    return;
  }
  if (!places_of(view, other).empty()) {
    refuse(fmt::format("`{}` has a meaning already", name));
  }
}

}  // namespace

Json renamed(const View& view, Position place, const std::string& name) {
  const auto named = named_at(view, offset_of(view, place));
  if (!named || named->kind == NameKind::Type ||
      named->kind == NameKind::File) {
    refuse("nothing here has a name that can be changed");
  }
  if (name == named->name) return Json{{"changes", Json::object()}};
  refuse_name(*named, name);
  refuse_taken(view, *named, name);
  std::map<std::string, Json> edits;
  for (const Place& each : places_of(view, *named)) {
    const FileText* text = view.text(each.path);
    if (text == nullptr) continue;
    const bool is_quoted =
        each.part.begin > 0 && text->text()[each.part.begin - 1] == '"';
    const std::string written =
        kind_of(each.path, {}) == FileKind::Rules ||
                kind_of(each.path, {}) == FileKind::Leaves
            ? in_rules(name, is_quoted)
            : name;
    edits.try_emplace(view.uri(each.path), Json::array())
        .first->second.push(
            text_edit(view.range_in(each.path, each.part), written));
  }
  Json changes = Json::object();
  for (const auto& [uri, list] : edits) changes.add(uri, list);
  return {{"changes", changes}};
}

}  // namespace btcheck::lsp
