// SPDX-License-Identifier: MIT
//
// From one state to the next little changes, and the same changes come back in
// every tick. So a run is a list of numbers of changes, and each change is
// written once:
//
//     [step, mover + 1, phases, locations, event, chosen, statuses,
//      ticks, time, values, atoms]        without the zeros at the end
//
// Texts are numbers of a table. `phases` has 16 n + 2 phase + stale for each
// node n that looks different now; `locations`, `statuses` and `values` have
// pairs of a node (a variable) and a text; `atoms` the atoms that turned over.
// The first change starts from nothing: unvisited, text 0 (which is empty),
// false. `states` has pairs: the number of a change, and how many that follow
// one another begin with it. In texts of steps and locations the key of a node
// is "~" and its number in base 36, and "~" alone is the mover, or the node
// whose location it is: then a Sequence does what every Sequence does. "~"
// itself is "~~".
#include "trace/run/packed.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace btcheck {
namespace {

// Keys keep the order in which they are written.
using Json = nlohmann::ordered_json;

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

// Numbers in the order of first use.
class TextTable {
 public:
  TextTable() { number(""); }

  std::size_t number(const std::string& text) {
    const auto [entry, is_new] = number_of_.emplace(text, texts_.size());
    if (is_new) texts_.push_back(text);
    return entry->second;
  }
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::unordered_map<std::string, std::size_t> number_of_;
  std::vector<std::string> texts_;
};

class Packer {
 public:
  explicit Packer(const RecordedRun& run)
      : run_(run), keys_(run.nodes), before_(nothing()) {}

  Json packed() {
    Json states = Json::array();
    for (const RecordedState& state : run_.states) {
      const auto [entry, is_new] =
          number_of_.emplace(change_to(state).dump(), number_of_.size());
      if (is_new) changes_.push_back(Json::parse(entry->first));
      add(states, entry->second);
      before_ = &state;
    }
    Json document = about();
    document["texts"] = texts_.texts();
    document["changes"] = std::move(changes_);
    document["states"] = std::move(states);
    return document;
  }

 private:
  static void add(Json& states, std::size_t number) {
    if (!states.empty()) {
      const std::size_t first = states[states.size() - 2];
      const std::size_t many = states.back();
      if (first + many == number) {
        states.back() = many + 1;
        return;
      }
    }
    states.push_back(number);
    states.push_back(1);
  }

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

  Json change_to(const RecordedState& state) {
    const std::uint32_t mover = state.mover ? *state.mover + 1 : 0;
    Json change = {texts_.number(keys_.shortened(state.step, state.mover)),
                   mover,
                   phases(state),
                   locations(state),
                   texts_.number(state.event),
                   state.is_chosen ? 1 : 0,
                   different(state.statuses, before_->statuses),
                   state.tick - before_->tick,
                   state.time - before_->time,
                   different(state.values, before_->values),
                   atoms(state)};
    while (!change.empty() && (change.back() == 0 || change.back().empty())) {
      change.erase(change.end() - 1);
    }
    for (Json& part : change) {
      if (part.is_array() && part.empty()) part = 0;
    }
    return change;
  }

  Json phases(const RecordedState& state) const {
    Json changed = Json::array();
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      if (state.phases[n] == before_->phases[n] &&
          state.is_stale[n] == before_->is_stale[n]) {
        continue;
      }
      changed.push_back(16 * n + 2 * static_cast<std::size_t>(state.phases[n]) +
                        (state.is_stale[n] ? 1 : 0));
    }
    return changed;
  }

  Json locations(const RecordedState& state) {
    Json changed = Json::array();
    for (std::uint32_t n = 0; n < run_.nodes.size(); ++n) {
      if (state.locations[n] == before_->locations[n]) continue;
      changed.push_back(n);
      changed.push_back(texts_.number(keys_.shortened(state.locations[n], n)));
    }
    return changed;
  }

  Json different(const std::vector<std::string>& now,
                 const std::vector<std::string>& before) {
    Json changed = Json::array();
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i] == before[i]) continue;
      changed.push_back(i);
      changed.push_back(texts_.number(now[i]));
    }
    return changed;
  }

  Json atoms(const RecordedState& state) const {
    Json changed = Json::array();
    for (std::size_t a = 0; a < run_.atoms.size(); ++a) {
      if (state.atoms[a] != before_->atoms[a]) changed.push_back(a);
    }
    return changed;
  }

  Json about() const {
    Json document = {{"tree", run_.tree},
                     {"source", run_.source},
                     {"ticks", run_.ticks},
                     {"property", run_.property},
                     {"formula", run_.formula},
                     {"verdict", run_.verdict},
                     {"why", run_.why},
                     {"nodes", nodes()},
                     {"variables", run_.variables},
                     {"numbers", Json::array()},
                     {"atoms", run_.atoms}};
    for (const bool is_number : run_.is_number) {
      document["numbers"].push_back(is_number ? 1 : 0);
    }
    if (run_.loop != kNoState) {
      document["loop"] = run_.loop;
      document["back"] = {{"step", run_.back},
                          {"event", run_.back_event},
                          {"chosen", run_.back_is_chosen},
                          {"elapsed", run_.back_elapsed}};
    }
    if (run_.lost != kNoState) document["lost"] = run_.lost;
    if (run_.trigger != kNoState) document["trigger"] = run_.trigger;
    document["trigger_words"] = run_.trigger_words;
    document["end_words"] = run_.end_words;
    return document;
  }

  // [key, type, name, line, column, parent, file]; a root has no parent, and a
  // node of the tree's own file no file. Most keys are the name and the number:
  // 0 stands for such a one.
  Json nodes() const {
    Json table = Json::array();
    for (const RecordedNode& node : run_.nodes) {
      const bool is_plain =
          node.key == fmt::format("{}_btn{}", node.name, table.size());
      Json entry = {is_plain ? Json(0) : Json(node.key), node.type, node.name,
                    node.line, node.column};
      if (node.parent) entry.push_back(*node.parent);
      if (!node.file.empty()) {
        if (!node.parent) entry.push_back(nullptr);
        entry.push_back(node.file);
      }
      table.push_back(std::move(entry));
    }
    return table;
  }

  const RecordedRun& run_;
  KeyShortener keys_;
  TextTable texts_;
  RecordedState nothing_;
  const RecordedState* before_;
  std::map<std::string, std::size_t> number_of_;  // of changes, as JSON
  Json changes_ = Json::array();
};

}  // namespace

std::string packed_run(const RecordedRun& run) {
  const std::string json =
      Packer(run).packed().dump(-1, ' ', false, Json::error_handler_t::replace);
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

}  // namespace btcheck
