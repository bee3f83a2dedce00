// SPDX-License-Identifier: MIT
//
// How a run is packed.
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
#include "trace/viewer/packed.hpp"

#include <fmt/format.h>

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

using Numbers = std::vector<std::size_t>;

Json list(const Numbers& numbers) {
  return numbers.empty() ? Json(0) : Json::array(numbers);
}

// What the first change starts from.
RecordedState nothing(const RecordedRun& run) {
  RecordedState state;
  state.phases.resize(run.nodes.size(), Phase::Unvisited);
  state.is_stale.resize(run.nodes.size());
  state.statuses.resize(run.nodes.size());
  state.locations.resize(run.nodes.size());
  state.values.resize(run.variables.size());
  state.atoms.resize(run.atoms.size());
  return state;
}

// [key, type, name, line, column, parent, file]; a root has no parent, and a
// node of the tree's own file no file. Most keys are the name and the number:
// 0 stands for such a one.
Json nodes_of(const RecordedRun& run) {
  Json table = Json::array();
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    const RecordedNode& node = run.nodes[n];
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

Numbers changed_phases(const RecordedState& before, const RecordedState& now) {
  Numbers changed;
  for (std::size_t n = 0; n < now.phases.size(); ++n) {
    if (now.phases[n] != before.phases[n] ||
        now.is_stale[n] != before.is_stale[n]) {
      changed.push_back(32 * n + 2 * static_cast<std::size_t>(now.phases[n]) +
                        (now.is_stale[n] ? 1 : 0));
    }
  }
  return changed;
}

Numbers changed_atoms(const RecordedState& before, const RecordedState& now) {
  Numbers changed;
  for (std::size_t a = 0; a < now.atoms.size(); ++a) {
    if (now.atoms[a] != before.atoms[a]) changed.push_back(a);
  }
  return changed;
}

}  // namespace

KeyShortener::KeyShortener(const std::vector<RecordedNode>& nodes) {
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].key.empty()) continue;
    number_of_.emplace(nodes[n].key, n);
    lengths_.insert(nodes[n].key.size());
  }
}

std::string KeyShortener::shortened(std::string_view text,
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

// The longest key that stands there, and whose it is; else length 0. What
// follows must not read as part of the reference.
std::pair<std::size_t, std::uint32_t> KeyShortener::key_at(
    std::string_view text, std::size_t at) const {
  for (auto length = lengths_.rbegin(); length != lengths_.rend(); ++length) {
    const std::size_t end = at + *length;
    if (end > text.size()) continue;
    if (end < text.size() && continues_reference(text[end])) continue;
    const auto found = number_of_.find(text.substr(at, *length));
    if (found != number_of_.end()) return {*length, found->second};
  }
  return {0, 0};
}

RunPacker::RunPacker(const RecordedRun& run)
    : run_(&run), keys_(run.nodes), before_(nothing(run)) {
  number_of("");
}

void RunPacker::begin(const RecordedRun& next) {
  run_ = &next;
  before_ = nothing(next);
}

Json RunPacker::about() const {
  Json document = shared();
  add_own(document);
  return document;
}

Json RunPacker::shared() const {
  Json numbers = Json::array();
  for (const bool is_number : run_->is_number) numbers.push(is_number ? 1 : 0);
  Json document{{"tree", run_->tree},
                {"source", run_->source},
                {"ticks", run_->ticks},
                {"nodes", nodes_of(*run_)},
                {"variables", Json::array(run_->variables)},
                {"numbers", numbers}};
  if (!run_->included.empty()) document.add("included", included_texts(*run_));
  return document;
}

void RunPacker::add_own(Json& document) const {
  document.add("property", run_->property);
  document.add("formula", run_->formula);
  document.add("verdict", run_->verdict);
  document.add("why", run_->why);
  document.add("atoms", Json::array(run_->atoms));
  if (run_->loop != kNoState) {
    document.add("loop", run_->loop);
    document.add("back", step_back(*run_));
  }
  if (run_->lost != kNoState) document.add("lost", run_->lost);
  if (run_->trigger != kNoState) document.add("trigger", run_->trigger);
  document.add("trigger_words", run_->trigger_words);
  document.add("end_words", run_->end_words);
}

void RunPacker::add(std::span<const RecordedState> more, Json& document) {
  Numbers states;
  Json changes = Json::array();
  const RecordedState* before = &before_;
  for (const RecordedState& state : more) {
    const Json change = change_between(*before, state);
    const auto [entry, is_new] = known_.emplace(change.text(), known_.size());
    if (is_new) changes.push(change);
    const std::size_t count = states.size();
    if (count > 0 && states[count - 2] + states[count - 1] == entry->second) {
      ++states.back();
    } else {
      states.insert(states.end(), {entry->second, 1});
    }
    before = &state;
  }
  if (before != &before_) before_ = *before;
  document.add("texts", Json::array(texts_));
  document.add("changes", changes);
  document.add("states", Json::array(states));
  texts_.clear();
}

// Of a text, in the order of first use.
std::size_t RunPacker::number_of(const std::string& text) {
  const auto [entry, is_new] = number_of_.emplace(text, number_of_.size());
  if (is_new) texts_.push_back(text);
  return entry->second;
}

Json RunPacker::change_between(const RecordedState& before,
                               const RecordedState& now) {
  std::vector<Json> parts = {
      number_of(keys_.shortened(now.step, now.mover)),
      now.mover ? *now.mover + 1 : 0,
      list(changed_phases(before, now)),
      list(different(before.locations, now.locations, true)),
      number_of(now.event),
      now.is_chosen ? 1 : 0,
      list(different(before.statuses, now.statuses)),
      now.tick - before.tick,
      now.time - before.time,
      list(different(before.values, now.values)),
      list(changed_atoms(before, now))};
  while (!parts.empty() && parts.back() == Json(0)) parts.pop_back();
  return Json::array(parts);
}

std::vector<std::size_t> RunPacker::different(
    const std::vector<std::string>& before, const std::vector<std::string>& now,
    bool has_keys) {
  Numbers changed;
  for (std::uint32_t i = 0; i < now.size(); ++i) {
    if (now[i] == before[i]) continue;
    changed.push_back(i);
    changed.push_back(
        number_of(has_keys ? keys_.shortened(now[i], i) : now[i]));
  }
  return changed;
}

std::string packed_run(const RecordedRun& run) {
  RunPacker packer(run);
  Json document = packer.about();
  packer.add(run.states, document);
  return safe_json(document);
}

std::string safe_json(const Json& document) {
  const std::string& json = document.text();
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
