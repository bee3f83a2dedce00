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
// The same holds for an entry that scripts only change by `=`, which throws
// where there is none: the program creates it, and may write it again.
//
// The program is assumed to put only values of the kind that the tree puts
// there into an entry before the first tick; and leaves, to write only by their
// ports and contracts, while they are ticked or halted.
//
// Where an entry may get one of several values and no condition on the entries
// tells which, it becomes Any.
#include "model/btcpp/entries/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <set>
#include <utility>

#include "model/btcpp/entries/declarations.hpp"
#include "model/btcpp/entries/run.hpp"
#include "text/budget.hpp"

namespace btcheck::btcpp {
namespace {

// In ScriptGuard::work(), while the values of all entries are found.
constexpr std::uint64_t kMostWork = 300'000;

std::set<double> numbers_in(const ScriptTree& tree) {
  std::set<double> numbers;
  for (const ScriptTerm& term : tree.terms) {
    if (term.operation == ScriptOperation::Number && term.number) {
      numbers.insert(*term.number);
    }
    if (term.operation != ScriptOperation::Negate) continue;
    const ScriptTerm& of = tree.terms[term.operands[0]];
    if (of.number) numbers.insert(-*of.number);
  }
  return numbers;
}

class WorldMaker {
 public:
  WorldMaker(const BtcppExpansion& expansion, const ContractScripts& contracts,
             const ScriptDetail& detail)
      : expansion_(expansion),
        detail_(detail),
        declared_(contracts.declared),
        writers_(script_writers(expansion, contracts)) {
    for (const auto& [entry, value] : contracts.initial) read_.insert(entry);
    for (const auto& [entry, domain] : contracts.declared) read_.insert(entry);
    find_names();
    choose_entries();
    declare_entries();
  }

  ScriptWorld make() {
    do prepare();
    while (!is_closed() || !are_known());
    for (ScriptDomain& domain : world_.domains) {
      std::ranges::sort(domain.values);
    }
    world_.variables =
        entry_variables(expansion_, names_, world_.domains, writers_.literals);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      declared_.set_moves(names_[i], world_.domains[i], world_.variables[i]);
    }
    report_abstracted();
    world_.groups = groups_of([](const EntryName&) { return true; }).numbers();
    find_places();
    world_.writers = std::move(writers_);
    world_.lost = std::move(lost_);
    world_.too_large = declared_.too_large();
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
      in_scripts_.insert(mentioned.begin(), mentioned.end());
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
    for (const auto& [leaf, writes] : writers_.port_writes) {
      for (const PortWrite& write : writes) add_port(write);
    }
    for (const EntryName& entry : written_) {
      if (!writers_.all_foreign.empty()) {
        writers_.foreign[entry] = writers_.all_foreign;
      } else if (!created_.contains(entry)) {
        writers_.foreign.emplace(entry, kNothingCreates);
      }
    }
  }

  // Of an entry that no script mentions, no value need be known.
  void add_port(const PortWrite& write) {
    const bool is_known = in_scripts_.contains(write.entry) ||
                          declared_.all().contains(write.entry);
    if (is_known) {
      written_.insert(write.entry);
      created_.insert(write.entry);
    } else {
      writers_.foreign.emplace(write.entry, write.reason);
    }
  }

  // All of them have a state variable, where nothing else may write them.
  void declare_entries() {
    if (declared_.all().empty()) return;
    declared_.settle(expansion_, written_, detail_, writers_);
    for (const auto& [entry, declaration] : declared_.all()) {
      written_.insert(entry);
      created_.insert(entry);
      const auto foreign = writers_.foreign.find(entry);
      if (!writers_.all_foreign.empty()) {
        writers_.foreign[entry] = writers_.all_foreign;
      } else if (foreign != writers_.foreign.end() &&
                 foreign->second == kNothingCreates) {
        writers_.foreign.erase(foreign);
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
      domain.is_typed_by_leaves = writers_.typed_by_leaves.contains(entry);
      domain.exists |= declared_.limit(entry, writers_, domain);
      world_.domains.push_back(std::move(domain));
    }
    for (const EntryName& entry : writers_.unset) {
      if (ScriptDomain* domain = domain_of(entry)) {
        domain->values.push_back(ScriptValue::unset());
      }
    }
    add_literals();
    add_port_values();
    find_bounds();
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

  void add_port_values() {
    for (const auto& [leaf, writes] : writers_.port_writes) {
      for (const PortWrite& write : writes) {
        ScriptDomain* domain = domain_of(write.entry);
        if (domain == nullptr || domain->limits) continue;
        const EntryType noted = write.value.noted;
        const bool is_first = std::ranges::none_of(
            domain->values,
            [](const auto& value) { return value.is_outside(); });
        if (domain->index_of(write.value) == 0) {
          domain->values.push_back(write.value);
        }
        const bool is_sure =
            noted == write.type && (is_first || domain->outside == noted);
        domain->outside = is_sure ? noted : EntryType::Free;
      }
    }
  }

  // How far numbers are kept apart: by those in the scripts that mention the
  // entry, the literals it begins with, and the bounds of what it is mentioned
  // together with, since that may be copied or compared.
  void find_bounds() {
    for (const PlacedScript& script : writers_.scripts) {
      const std::set<double> numbers = numbers_in(script.syntax.tree);
      if (numbers.empty()) continue;
      for (const ScriptName& name : script.syntax.names) {
        const auto entry = entry_of(expansion_, script.subtree, name.name);
        widen(entry, *numbers.begin());
        widen(entry, *numbers.rbegin());
      }
    }
    for (const auto& [entry, value] : writers_.literals) {
      if (value.is_number()) widen(entry, value.number);
    }
    if (!is_narrow_) widen_beyond_scripts();
    EntryGroups groups = groups_of(
        [&](const EntryName& entry) { return world_.of.contains(entry); });
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const EntryName first = groups.first_of(names_[i]);
      widen(first, world_.domains[i].lowest);
      widen(first, world_.domains[i].highest);
    }
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const ScriptDomain& first = *domain_of(groups.first_of(names_[i]));
      world_.domains[i].lowest = first.lowest;
      world_.domains[i].highest = first.highest;
    }
  }

  void widen_beyond_scripts() {
    for (const PortPair& pair : writers_.compared) {
      for (const EntryName& entry : pair.entries) {
        for (const double number : pair.numbers) widen_if_near(entry, number);
      }
    }
    for (const EntryName& entry : names_) {
      const auto asked = asked_of(detail_, entry);
      for (const double number : asked.value_or(std::set<double>())) {
        widen_if_near(entry, number);
      }
    }
  }

  // As far as the values up to there could all be kept.
  void widen_if_near(const EntryName& entry, double number) {
    ScriptDomain* domain = domain_of(entry);
    if (domain == nullptr) return;
    const double span =
        std::max(domain->highest, number) - std::min(domain->lowest, number);
    const std::size_t most = most_values(detail_, entry);
    if (span <= static_cast<double>(most)) domain->widen(number);
  }

  void widen(const EntryName& entry, double number) {
    if (ScriptDomain* domain = domain_of(entry)) domain->widen(number);
  }

  // Entries of this kind that are mentioned together are in one group.
  template <class Belongs>
  EntryGroups groups_of(Belongs belongs) const {
    EntryGroups groups;
    for (const auto& mentioned : mentioned_) {
      const EntryName* first = nullptr;
      for (const EntryName& entry : mentioned) {
        if (!belongs(entry)) continue;
        if (first == nullptr) first = &entry;
        groups.join(entry, *first);
      }
    }
    for (const PortPair& pair : writers_.compared) {
      const auto& both = pair.entries;
      if (both.size() == 2 && belongs(both[0]) && belongs(both[1])) {
        groups.join(both[0], both[1]);
      }
    }
    return groups;
  }

  ScriptDomain* domain_of(const EntryName& entry) {
    const auto found = world_.variable_of(entry);
    return found ? &world_.domains[index(*found)] : nullptr;
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
        const auto found = world_.variable_of(entry);
        if (found) users_[index(*found)].push_back(i);
      }
    }
    const std::uint64_t begin = ScriptGuard::work();
    while (!waiting_.empty()) {
      while (!waiting_.empty()) {
        ask_budget();
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

  // Where this has become too much work: gives up the entry with the most
  // values among those that the writer mentions.
  bool has_enough(std::uint64_t begin, std::size_t writer) {
    if (ScriptGuard::work() - begin < kMostWork) return false;
    if (!std::exchange(is_narrow_, true)) return true;
    const EntryName* largest = nullptr;
    for (const EntryName& entry : mentioned_[writer]) {
      const bool is_larger =
          world_.of.contains(entry) &&
          (largest == nullptr || values_of(entry) > values_of(*largest));
      if (is_larger) largest = &entry;
    }
    if (largest == nullptr) return false;
    give_up(*largest, "too many combinations of values");
    return true;
  }
  void give_up(const EntryName& entry, std::string reason) {
    const bool is_of_tree = std::ranges::none_of(domain_of(entry)->values,
                                                 &ScriptValue::is_outside);
    if (is_of_tree) lost_.insert(entry);
    writers_.foreign[entry] = std::move(reason);
  }
  std::size_t values_of(const EntryName& entry) {
    return domain_of(entry)->values.size();
  }

  // Gives up the entries of which no value is known; where whoever writes one
  // throws, it is known that it gets none.
  bool are_known() {
    bool all_known = true;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto& values = world_.domains[i].values;
      const bool is_given_none = values.size() == 1;
      const bool is_known =
          is_given_none || std::ranges::any_of(values, [](const auto& value) {
            return value.is_outside() ||
                   (!is_open(value) && !value.is_any_number());
          });
      if (is_known) continue;
      give_up(names_[i], "none of its values is known");
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
      const std::size_t most =
          std::max(most_values(detail_, name),
                   domain.limits ? 2 * kMostDeclared : std::size_t{0});
      if (domain.values.size() > most) {
        if (std::exchange(is_narrow_, true)) {
          give_up(name, fmt::format("it takes more than {} values", most));
        }
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

  // The first time it runs on all values, later on those it has not seen yet.
  void run_on_new_values(std::size_t writer) {
    const bool is_first = taken_[writer].empty();
    std::vector<std::pair<StateVariableId, std::size_t>> before;
    for (const EntryName& entry : mentioned_[writer]) {
      const auto found = world_.variable_of(entry);
      if (!found) continue;
      std::size_t& taken = taken_[writer][*found];
      before.emplace_back(*found, taken);
      taken = world_.domain(*found).values.size();
    }
    if (is_first) return run(writer, {});
    for (const auto& [variable, taken] : before) {
      if (taken == taken_[writer][variable]) continue;
      run(writer, {{variable, taken}});
    }
  }

  using NewValues = std::optional<std::pair<StateVariableId, std::size_t>>;

  // A run that begins with only these values; what entries come to hold is
  // kept where it is asked for.
  ScriptRun begun(std::uint32_t subtree, bool is_of_contract,
                  const NewValues& only, bool keeps) {
    ScriptRun run(expansion_, world_, subtree, is_of_contract);
    if (only) run.only_from(only->first, only->second);
    run.on_keep([this, keeps](StateVariableId id, const ScriptValue& value) {
      if (keeps) kept_.emplace(id, value);
    });
    return run;
  }

  void run(std::size_t writer, const NewValues& only) {
    const std::size_t scripts = writers_.scripts.size();
    if (writer >= scripts) {
      const Setting& setting = writers_.settings[writer - scripts];
      const auto found = world_.variable_of(setting.entry);
      if (found) begun(0, false, only, true).set(*found, setting);
      return;
    }
    const PlacedScript& script = writers_.scripts[writer];
    ScriptRun run = begun(script.subtree, script.is_of_contract, only, true);
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
        ScriptRun alone =
            begun(script.subtree, script.is_of_contract, {}, false);
        alone.execute(tree, statement);
        keep_lost(alone);
      }
    }
    for (const Setting& setting : writers_.settings) {
      const auto found = world_.variable_of(setting.entry);
      if (!found) continue;
      ScriptRun alone = begun(0, false, {}, false);
      alone.set(*found, setting);
      keep_lost(alone);
    }
  }

  // A value that may be one of several in the same state; and one that is lost
  // only when all values are looked at together.
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

  // A script that is too deep to be run may assign anything.
  void refuse(const PlacedScript& script) {
    for (const ScriptName& name : script.syntax.names) {
      if (name.use == ScriptUse::Read) continue;
      const auto found =
          world_.variable_of(entry_of(expansion_, script.subtree, name.name));
      if (!found) continue;
      kept_.emplace(*found, ScriptValue::lost().as(EntryType::Other));
    }
  }

  void report_abstracted() {
    for (const EntryName& entry : read_) {
      if (world_.of.contains(entry)) continue;
      const auto reason = writers_.foreign.find(entry);
      world_.abstracted.emplace(entry, reason != writers_.foreign.end()
                                           ? reason->second
                                           : std::string(kNothingWrites));
    }
  }

  void find_places() {
    const std::size_t scripts = writers_.scripts.size();
    for (std::size_t i = 0; i < mentioned_.size(); ++i) {
      const std::uint32_t node = i < scripts
                                     ? writers_.scripts[i].node
                                     : writers_.settings[i - scripts].node;
      for (const EntryName& entry : mentioned_[i]) {
        auto& first = world_.first_node.emplace(entry, node).first->second;
        first = std::min(first, node);
      }
    }
  }

  const BtcppExpansion& expansion_;
  const ScriptDetail& detail_;
  Declarations declared_;
  // Numbers in ports and rules have asked for too much: those in scripts count.
  bool is_narrow_ = false;
  ScriptWriters writers_;
  std::set<EntryName> lost_;     // given up, though scripts alone write them
  std::set<EntryName> read_;     // or changed, or named by contracts
  std::set<EntryName> written_;  // by what can be modelled
  std::set<EntryName> created_;  // and made where there was none
  std::set<EntryName> in_scripts_;
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

std::optional<StateVariableId> ScriptWorld::variable_of(
    const EntryName& entry) const {
  const auto found = of.find(entry);
  if (found == of.end()) return std::nullopt;
  return found->second;
}

ScriptWorld script_world(const BtcppExpansion& expansion,
                         const ContractScripts& contracts,
                         const ScriptDetail& detail) {
  return WorldMaker(expansion, contracts, detail).make();
}

}  // namespace btcheck::btcpp
