// SPDX-License-Identifier: MIT
//
// The page is a form with four gaps, {{title}}, {{style}}, {{run}} and
// {{script}}. In it the run is packed.
//
// From one state to the next little changes, and the same changes come back in
// every tick. So a run is a list of numbers of changes, and each change is
// written once:
//
//     [step, mover + 1, phases, locations, event, chosen, statuses,
//      ticks, time, values, atoms]        without the zeros at the end
//
// Texts are numbers of a table. `phases` has 32 n + 2 phase + stale for each
// node n that looks different now; `locations`, `statuses` and `values` have
// pairs of a node (a variable) and a text; `atoms` the atoms that turned over.
// The first change starts from nothing: unvisited, text 0 (which is empty),
// false. `states` has pairs: the number of a change, and how many that follow
// one another begin with it. In texts of steps and locations the key of a node
// is "~" and its number in base 36, and "~" alone is the mover, or the node
// whose location it is: then a Sequence does what every Sequence does. "~"
// itself is "~~".
#include "trace/viewer/html.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <set>
#include <unordered_map>

#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"
#include "text/json.hpp"
#include "text/utf8.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// What may stand behind "~" as a part of a reference.
bool continues_reference(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || c == '~';
}

std::string in_base_36(std::uint32_t number) {
  std::string digits;
  do {
    digits += "0123456789abcdefghijklmnopqrstuvwxyz"[number % 36];
    number /= 36;
  } while (number > 0);
  return {digits.rbegin(), digits.rend()};
}

// Writes the keys of nodes shorter.
class KeyShortener {
 public:
  explicit KeyShortener(const std::vector<RecordedNode>& nodes) {
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      if (nodes[n].key.empty()) continue;
      number_of_.emplace(nodes[n].key, n);
      lengths_.insert(nodes[n].key.size());
    }
  }

  std::string shortened(std::string_view text,
                        std::optional<std::uint32_t> own) const {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
      const auto [length, number] = key_at(text, at);
      if (length > 0) {
        result += '~';
        if (number != own) result += in_base_36(number);
        at += length;
      } else {
        if (text[at] == '~') result += '~';
        result += text[at++];
      }
    }
    return result;
  }

 private:
  // The longest key that stands there, and whose it is; else length 0. What
  // follows must not read as part of the reference.
  std::pair<std::size_t, std::uint32_t> key_at(std::string_view text,
                                               std::size_t at) const {
    for (auto length = lengths_.rbegin(); length != lengths_.rend(); ++length) {
      const std::size_t end = at + *length;
      if (end > text.size()) continue;
      if (end < text.size() && continues_reference(text[end])) continue;
      const auto found = number_of_.find(text.substr(at, *length));
      if (found != number_of_.end()) return {*length, found->second};
    }
    return {0, 0};
  }

  std::unordered_map<std::string_view, std::uint32_t> number_of_;
  std::set<std::size_t> lengths_;
};

class Packer {
 public:
  explicit Packer(const RecordedRun& run)
      : run_(run), keys_(run.nodes), before_(nothing()) {
    number_of("");
  }

  std::string packed() {
    std::vector<std::size_t> states;
    std::map<std::string, std::size_t> known;  // changes
    Json changes = Json::array();
    for (const RecordedState& state : run_.states) {
      const Json change = change_to(state);
      const auto [entry, is_new] = known.emplace(change.text(), known.size());
      if (is_new) changes.push(change);
      const std::size_t count = states.size();
      if (count > 0 && states[count - 2] + states[count - 1] == entry->second) {
        ++states.back();
      } else {
        states.insert(states.end(), {entry->second, 1});
      }
      before_ = &state;
    }
    Json document = about();
    document.add("texts", Json::array(texts_));
    document.add("changes", changes);
    document.add("states", Json::array(states));
    return document.text();
  }

 private:
  using Numbers = std::vector<std::size_t>;

  // What the first change starts from.
  const RecordedState* nothing() {
    nothing_.phases.resize(run_.nodes.size(), Phase::Unvisited);
    nothing_.is_stale.resize(run_.nodes.size());
    nothing_.statuses.resize(run_.nodes.size());
    nothing_.locations.resize(run_.nodes.size());
    nothing_.values.resize(run_.variables.size());
    nothing_.atoms.resize(run_.atoms.size());
    return &nothing_;
  }

  // Of a text, in the order of first use.
  std::size_t number_of(const std::string& text) {
    const auto [entry, is_new] = number_of_.emplace(text, texts_.size());
    if (is_new) texts_.push_back(text);
    return entry->second;
  }

  static Json list(const Numbers& numbers) {
    return numbers.empty() ? Json(0) : Json::array(numbers);
  }

  Json change_to(const RecordedState& state) {
    std::vector<Json> parts = {
        number_of(keys_.shortened(state.step, state.mover)),
        state.mover ? *state.mover + 1 : 0,
        list(phases(state)),
        list(different(state.locations, before_->locations, true)),
        number_of(state.event),
        state.is_chosen ? 1 : 0,
        list(different(state.statuses, before_->statuses)),
        state.tick - before_->tick,
        state.time - before_->time,
        list(different(state.values, before_->values)),
        list(atoms(state))};
    while (!parts.empty() && parts.back() == Json(0)) parts.pop_back();
    return Json::array(parts);
  }

  Numbers phases(const RecordedState& state) const {
    Numbers changed;
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      if (state.phases[n] != before_->phases[n] ||
          state.is_stale[n] != before_->is_stale[n]) {
        changed.push_back(32 * n +
                          2 * static_cast<std::size_t>(state.phases[n]) +
                          (state.is_stale[n] ? 1 : 0));
      }
    }
    return changed;
  }

  Numbers different(const std::vector<std::string>& now,
                    const std::vector<std::string>& before,
                    bool has_keys = false) {
    Numbers changed;
    for (std::uint32_t i = 0; i < now.size(); ++i) {
      if (now[i] == before[i]) continue;
      changed.push_back(i);
      changed.push_back(
          number_of(has_keys ? keys_.shortened(now[i], i) : now[i]));
    }
    return changed;
  }

  Numbers atoms(const RecordedState& state) const {
    Numbers changed;
    for (std::size_t a = 0; a < run_.atoms.size(); ++a) {
      if (state.atoms[a] != before_->atoms[a]) changed.push_back(a);
    }
    return changed;
  }

  Json about() const {
    Json numbers = Json::array();
    for (const bool is_number : run_.is_number) numbers.push(is_number ? 1 : 0);
    Json document{{"tree", run_.tree},
                  {"source", run_.source},
                  {"ticks", run_.ticks},
                  {"property", run_.property},
                  {"formula", run_.formula},
                  {"verdict", run_.verdict},
                  {"why", run_.why},
                  {"nodes", nodes()},
                  {"variables", Json::array(run_.variables)},
                  {"numbers", numbers},
                  {"atoms", Json::array(run_.atoms)}};
    if (!run_.included.empty()) {
      document.add("included", included_texts(run_));
    }
    if (run_.loop != kNoState) {
      document.add("loop", run_.loop);
      document.add("back", step_back(run_));
    }
    if (run_.lost != kNoState) document.add("lost", run_.lost);
    if (run_.trigger != kNoState) document.add("trigger", run_.trigger);
    document.add("trigger_words", run_.trigger_words);
    document.add("end_words", run_.end_words);
    return document;
  }

  // [key, type, name, line, column, parent, file]; a root has no parent, and a
  // node of the tree's own file no file. Most keys are the name and the number:
  // 0 stands for such a one.
  Json nodes() const {
    Json table = Json::array();
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      const RecordedNode& node = run_.nodes[n];
      const bool is_plain = node.key == fmt::format("{}_btn{}", node.name, n);
      std::vector<Json> entry = {is_plain ? Json(0) : Json(node.key), node.type,
                                 node.name, node.line, node.column};
      if (node.parent) entry.push_back(*node.parent);
      if (!node.file.empty()) {
        if (!node.parent) entry.push_back(Json::null());
        entry.push_back(node.file);
      }
      table.push(Json::array(entry));
    }
    return table;
  }

  const RecordedRun& run_;
  KeyShortener keys_;
  std::unordered_map<std::string, std::size_t> number_of_;  // of texts
  std::vector<std::string> texts_;
  RecordedState nothing_;
  const RecordedState* before_;
};

// Text as HTML; what cannot be shown is replaced.
std::string escaped(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint point = decode(text, at);
    result += !point.is_valid      ? "\ufffd"
              : point.value < 0x20 ? " "
                                   : text.substr(at, point.length);
    at += point.length;
  }
  return with_entities(result);
}

template <std::size_t N>
std::string joined(const std::array<std::string_view, N>& parts) {
  std::string text;
  for (const std::string_view part : parts) text += part;
  return text;
}

// The signs of the node types, as the viewer's scripts know them.
std::string control_signs() {
  std::string text;
  for (const NodeTypeInfo& type : node_types()) {
    if (type.sign.empty()) continue;
    text += fmt::format("{}{}: \"{}\"", text.empty() ? "" : ", ", type.name,
                        type.sign);
  }
  return fmt::format("const CONTROL_SIGNS = {{ {} }};\n", text);
}

}  // namespace

std::string filled(std::string_view form, const Gaps& gaps) {
  std::string page;
  for (const auto& [gap, text] : gaps) {
    const std::size_t at = form.find(gap);
    page += form.substr(0, at);
    page += text;
    form.remove_prefix(at + gap.size());
  }
  page += form;
  return page;
}

std::string packed_run(const RecordedRun& run) {
  const std::string json = Packer(run).packed();
  std::string safe;
  safe.reserve(json.size());
  for (std::size_t at = 0; at < json.size(); ++at) {
    const std::string_view three = std::string_view(json).substr(at, 3);
    if (json[at] == '<') {
      safe += "\\u003c";
    } else if (three == "\u2028" || three == "\u2029") {
      safe += three == "\u2028" ? "\\u2028" : "\\u2029";
      at += 2;
    } else {
      safe += json[at];
    }
  }
  return safe;
}

std::string html_text(const RecordedRun& run) {
  const std::string title =
      fmt::format("{} {} · {}", run.verdict, run.property, run.tree);
  return filled(kViewerPage,
                {{"{{title}}", escaped(title)},
                 {"{{style}}", joined(kViewerStyles)},
                 {"{{run}}", packed_run(run)},
                 {"{{script}}", control_signs() + joined(kViewerScripts)}});
}

}  // namespace btcheck
