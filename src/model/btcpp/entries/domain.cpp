// SPDX-License-Identifier: MIT
//
// The values of an entry are the smallest set that holds what the tree gives
// it: every script is run on the values found so far, until none is new. So
// that counting ends, numbers are kept apart only as far as the numbers in the
// scripts that mention the entry; what lies beyond is `at least` one more or
// `at most` one less. An entry that still takes too many values is given up:
// like one that only the program around the tree knows, it may then have any
// value at any time.
//
// So does one that scripts only change by `=`, which throws where there is
// none: the program creates it, and may write it again.
//
// Taken for granted of that program: what it puts into an entry before the
// first tick is of the kind that the tree puts there, and nothing but ports and
// contracts lets a leaf write.
//
// Where an entry may get one of several values and no condition on the entries
// tells which, it becomes Any.
#include "model/btcpp/entries/domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <set>
#include <utility>

#include "model/btcpp/entries/bounds.hpp"
#include "model/btcpp/entries/run.hpp"
#include "model/btcpp/entries/variables.hpp"
#include "model/btcpp/expand/writers.hpp"

namespace btcheck::btcpp {
namespace {

// Of guards, while the values of all entries are found.
constexpr std::uint64_t kMostWork = 300'000;
constexpr double kMostKept = 0x1p31;

class WorldMaker {
 public:
  WorldMaker(const BtcppExpansion& expansion, const ContractScripts& contracts,
             const ScriptDetail& detail)
      : expansion_(expansion),
        detail_(detail),
        writers_(script_writers(expansion, contracts)) {
    for (const auto& [entry, value] : contracts.initial) read_.insert(entry);
    find_names();
    choose_entries();
  }

  ScriptWorld make() {
    do prepare();
    while (!is_closed() || !are_known());
    for (ScriptDomain& domain : world_.domains) {
      std::sort(domain.values.begin(), domain.values.end());
    }
    declare_variables(expansion_, names_, writers_.literals, world_);
    report_abstracted();
    find_groups();
    find_places();
    world_.writers = std::move(writers_);
    world_.lost = std::move(lost_);
    return std::move(world_);
  }

 private:
  void find_names() {
    for (const PlacedScript& script : writers_.scripts) {
      std::set<EntryName> mentioned;
      for (const ScriptName& name : script.syntax.names) {
        const EntryName entry = entry_of(expansion_, script.subtree, name.name);
        mentioned.insert(entry);
        // `=` throws where there is none.
        if (name.use != ScriptUse::Create || script.is_of_contract) {
          read_.insert(entry);
        }
        if (name.use != ScriptUse::Read) written_.insert(entry);
        if (name.use == ScriptUse::Create) created_.insert(entry);
      }
      mentioned_.emplace_back(mentioned.begin(), mentioned.end());
    }
    for (const Setting& setting : writers_.settings) {
      written_.insert(setting.entry);
      created_.insert(setting.entry);
      mentioned_.push_back({setting.entry});
      if (setting.source) mentioned_.back().push_back(*setting.source);
    }
    for (const auto& [entry, value] : writers_.literals) {
      written_.insert(entry);
      created_.insert(entry);
    }
  }

  void choose_entries() {
    for (const EntryName& entry : written_) {
      if (!writers_.all_foreign.empty()) {
        writers_.foreign[entry] = writers_.all_foreign;
      } else if (!created_.contains(entry)) {
        writers_.foreign.emplace(entry, "nothing in the tree creates it");
      }
    }
  }

  // The world before any script has run.
  void prepare() {
    world_ = {};
    names_.clear();
    for (const EntryName& entry : written_) {
      if (writers_.foreign.contains(entry)) continue;
      world_.of[entry] = static_cast<StateVariableId>(names_.size());
      names_.push_back(entry);
      ScriptDomain domain;
      const auto declared = writers_.declared.find(entry);
      domain.exists = declared != writers_.declared.end();
      if (domain.exists) domain.declared = declared->second;
      world_.domains.push_back(std::move(domain));
    }
    for (const EntryName& entry : writers_.unset) {
      if (ScriptDomain* domain = domain_of(entry)) {
        domain->values.push_back(ScriptValue::unset());
      }
    }
    add_literals();
    find_bounds(expansion_, writers_, mentioned_, world_);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const double reach = detail_.reach(names_[i]);
      world_.domains[i].lowest -= reach;
      world_.domains[i].highest += reach;
    }
  }

  void add_literals() {
    for (const auto& [entry, value] : writers_.literals) {
      ScriptDomain* domain = domain_of(entry);
      if (domain == nullptr) continue;
      if (domain->index_of(value) == 0) domain->values.push_back(value);
    }
  }

  ScriptDomain* domain_of(const EntryName& entry) {
    const auto found = world_.of.find(entry);
    return found == world_.of.end() ? nullptr
                                    : &world_.domains[index(found->second)];
  }

  // Runs every script until no value is new; false when an entry had to be
  // given up.
  bool is_closed() {
    const std::size_t count = mentioned_.size();
    users_.assign(names_.size(), {});
    taken_.assign(count, {});
    is_waiting_.assign(count, true);
    waiting_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      waiting_.push_back(i);
      for (const EntryName& entry : mentioned_[i]) {
        const auto found = world_.of.find(entry);
        if (found != world_.of.end()) users_[index(found->second)].push_back(i);
      }
    }
    const std::uint64_t begin = ScriptGuard::work();
    while (!waiting_.empty()) {
      while (!waiting_.empty()) {
        const std::size_t next = waiting_.front();
        waiting_.pop_front();
        is_waiting_[next] = false;
        kept_.clear();
        run_on_new_values(next);
        if (!are_taken_up() || has_enough(begin, next)) return false;
      }
      kept_.clear();
      keep_lost_of_all();
      if (!are_taken_up()) return false;
    }
    return true;
  }

  // Gives up the entry with the most values that a writer mentions, where it
  // has become too much work.
  bool has_enough(std::uint64_t begin, std::size_t writer) {
    if (ScriptGuard::work() - begin < kMostWork) return false;
    const EntryName* largest = nullptr;
    for (const EntryName& entry : mentioned_[writer]) {
      const bool is_larger =
          world_.of.contains(entry) &&
          (largest == nullptr || values_of(entry) > values_of(*largest));
      if (is_larger) largest = &entry;
    }
    if (largest == nullptr) return false;
    writers_.foreign[*largest] = "too many combinations of values";
    lost_.insert(*largest);
    return true;
  }
  std::size_t values_of(const EntryName& entry) {
    return domain_of(entry)->values.size();
  }

  // Gives up the entries of which no value is known.
  bool are_known() {
    bool all_known = true;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto& values = world_.domains[i].values;
      const bool is_known =
          std::any_of(values.begin(), values.end(), [](const auto& value) {
            return !is_open(value) && !value.is_any_number();
          });
      if (is_known) continue;
      writers_.foreign[names_[i]] = "none of its values is known";
      lost_.insert(names_[i]);
      all_known = false;
    }
    return all_known;
  }

  // Adds what is kept; false when there are too many values.
  bool are_taken_up() {
    for (const auto& [variable, value] : kept_) {
      ScriptDomain& domain = world_.domains[index(variable)];
      if (value.kind == ScriptKind::Unknown || domain.index_of(value) != 0) {
        continue;
      }
      domain.values.push_back(value);
      const EntryName& name = names_[index(variable)];
      const std::size_t most = detail_.most_values(name);
      if (domain.values.size() > most) {
        writers_.foreign[name] =
            fmt::format("it takes more than {} values", most);
        lost_.insert(name);
        return false;
      }
      for (const std::size_t user : users_[index(variable)]) {
        if (is_waiting_[user]) continue;
        is_waiting_[user] = true;
        waiting_.push_back(user);
      }
    }
    return true;
  }

  // What it makes of values that it has not seen yet; of all at first.
  void run_on_new_values(std::size_t writer) {
    const bool is_first = taken_[writer].empty();
    std::vector<std::pair<StateVariableId, std::size_t>> before;
    for (const EntryName& entry : mentioned_[writer]) {
      const auto found = world_.of.find(entry);
      if (found == world_.of.end()) continue;
      std::size_t& taken = taken_[writer][found->second];
      before.emplace_back(found->second, taken);
      taken = world_.domains[index(found->second)].values.size();
    }
    if (is_first) return run(writer, {});
    for (const auto& [variable, taken] : before) {
      if (taken == taken_[writer][variable]) continue;
      run(writer, {{variable, taken}});
    }
  }

  using NewValues = std::optional<std::pair<StateVariableId, std::size_t>>;

  ScriptRun begun(std::uint32_t subtree, bool is_of_contract,
                  const NewValues& only) const {
    ScriptRun run(expansion_, world_, subtree, is_of_contract);
    if (only) run.only_from(only->first, only->second);
    run.on_keep([](StateVariableId, const ScriptValue&) {});
    return run;
  }

  ScriptRun keeping(std::uint32_t subtree, bool is_of_contract,
                    const NewValues& only) {
    ScriptRun run = begun(subtree, is_of_contract, only);
    run.on_keep([&](StateVariableId variable, const ScriptValue& value) {
      kept_.emplace(variable, value);
    });
    return run;
  }

  void run(std::size_t writer, const NewValues& only) {
    const std::size_t scripts = writers_.scripts.size();
    if (writer >= scripts) {
      return run_setting(writers_.settings[writer - scripts], only);
    }
    const PlacedScript& script = writers_.scripts[writer];
    ScriptRun run = keeping(script.subtree, script.is_of_contract, only);
    const ScriptTree& tree = script.syntax.tree;
    for (const std::uint32_t statement : tree.statements) {
      if (tree.terms[statement].depth > kMostScriptDepth) {
        return refuse(script);
      }
      run.execute(tree, statement);
    }
  }

  // As the meaning of a script is made: statement by statement, of all values.
  void keep_lost_of_all() {
    for (const PlacedScript& script : writers_.scripts) {
      const ScriptTree& tree = script.syntax.tree;
      for (const std::uint32_t statement : tree.statements) {
        if (tree.terms[statement].depth > kMostScriptDepth) continue;
        ScriptRun alone = begun(script.subtree, script.is_of_contract, {});
        alone.execute(tree, statement);
        keep_lost(alone);
      }
    }
    for (const Setting& setting : writers_.settings) {
      const auto found = world_.of.find(setting.entry);
      if (found == world_.of.end()) continue;
      ScriptRun alone = begun(0, false, {});
      alone.set(found->second, setting);
      keep_lost(alone);
    }
  }

  // What may be one of several values, where no condition tells which; and what
  // is lost only where all values are looked at together.
  void keep_lost(const ScriptRun& run) {
    const bool may_go_round = run.entries().size() > 1;
    for (const auto& [variable, options] : run.entries()) {
      for (const auto& [value, where] : options) {
        if (value.is_lost()) kept_.emplace(variable, value);
      }
      if (may_go_round || is_ambiguous(options)) {
        kept_.emplace(variable, merged(options));
      }
    }
  }

  // What is too deep to be run may assign anything.
  void refuse(const PlacedScript& script) {
    for (const ScriptName& name : script.syntax.names) {
      if (name.use == ScriptUse::Read) continue;
      const auto found =
          world_.of.find(entry_of(expansion_, script.subtree, name.name));
      if (found != world_.of.end()) {
        kept_.emplace(found->second, ScriptValue::lost().as(EntryType::Other));
      }
    }
  }

  void run_setting(const Setting& setting, const NewValues& only) {
    const auto found = world_.of.find(setting.entry);
    if (found == world_.of.end()) return;
    ScriptRun run = keeping(0, false, only);
    run.set(found->second, setting);
  }

  void report_abstracted() {
    for (const EntryName& entry : read_) {
      if (world_.of.contains(entry)) continue;
      const auto reason = writers_.foreign.find(entry);
      world_.abstracted.push_back({entry, reason != writers_.foreign.end()
                                              ? reason->second
                                              : std::string(kNothingWrites)});
    }
  }

  void find_groups() {
    std::map<EntryName, EntryName> next;
    const auto first_of = [&](EntryName entry) {
      while (true) {
        const EntryName& up = next.emplace(entry, entry).first->second;
        if (up == entry) return entry;
        entry = up;
      }
    };
    for (const auto& mentioned : mentioned_) {
      for (const EntryName& entry : mentioned) {
        next[first_of(entry)] = first_of(mentioned.front());
      }
    }
    std::map<EntryName, std::size_t> numbers;
    for (const auto& [entry, up] : next) {
      const EntryName first = first_of(entry);
      world_.groups[entry] =
          numbers.emplace(first, numbers.size()).first->second;
    }
  }

  void find_places() {
    const auto note = [&](const EntryName& entry, std::uint32_t node) {
      const auto [found, is_new] = world_.first_node.emplace(entry, node);
      if (!is_new) found->second = std::min(found->second, node);
    };
    for (std::size_t i = 0; i < mentioned_.size(); ++i) {
      const bool is_script = i < writers_.scripts.size();
      const std::uint32_t node =
          is_script ? writers_.scripts[i].node
                    : writers_.settings[i - writers_.scripts.size()].node;
      for (const EntryName& entry : mentioned_[i]) note(entry, node);
    }
  }

  const BtcppExpansion& expansion_;
  const ScriptDetail& detail_;
  ScriptWriters writers_;
  std::set<EntryName> lost_;     // given up, though scripts alone write them
  std::set<EntryName> read_;     // or changed, or named by contracts
  std::set<EntryName> written_;  // by what can be modelled
  std::set<EntryName> created_;  // and made where there was none
  // By each script, then by each setting.
  std::vector<std::vector<EntryName>> mentioned_;

  ScriptWorld world_;
  std::vector<EntryName> names_;                 // of the variables
  std::vector<std::vector<std::size_t>> users_;  // of the variables
  std::deque<std::size_t> waiting_;              // scripts, then settings
  // By each of these, how many values of the entries it has seen.
  std::vector<std::map<StateVariableId, std::size_t>> taken_;
  std::vector<bool> is_waiting_;
  std::set<std::pair<StateVariableId, ScriptValue>> kept_;
};

}  // namespace

ScriptValue ScriptDomain::kept(const ScriptValue& value) const {
  if (!value.is_number() || value.is_any_number() ||
      value.kind == ScriptKind::NotANumber) {
    return value;
  }
  const double above = highest + 1;
  const double below = lowest - 1;
  const bool has_above = above <= kMostKept && value.kind != ScriptKind::AtMost;
  const bool has_below =
      below >= -kMostKept && value.kind != ScriptKind::AtLeast;
  ScriptValue range = value;
  if (value.kind == ScriptKind::Number && value.type == NumberType::Real) {
    range.type = value.is_whole() ? NumberType::Whole : NumberType::Real;
  }
  if (value.number >= above && has_above) {
    range.kind = ScriptKind::AtLeast;
    range.number = above;
    return range;
  }
  if (value.number <= below && has_below) {
    range.kind = ScriptKind::AtMost;
    range.number = below;
    return range;
  }
  return value.kind == ScriptKind::Number
             ? value
             : ScriptValue::any_number(value.type).as(value.noted);
}

std::size_t ScriptDomain::index_of(const ScriptValue& value) const {
  const auto found = std::find(values.begin(), values.end(), value);
  if (found == values.end()) return 0;
  return static_cast<std::size_t>(found - values.begin());
}

ScriptWorld script_world(const BtcppExpansion& expansion,
                         const ContractScripts& contracts,
                         const ScriptDetail& detail) {
  return WorldMaker(expansion, contracts, detail).make();
}

}  // namespace btcheck::btcpp
