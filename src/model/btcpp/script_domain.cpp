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
#include "model/btcpp/script_domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>
#include <utility>

#include "model/btcpp/script_bounds.hpp"
#include "model/btcpp/script_run.hpp"
#include "model/btcpp/script_variables.hpp"
#include "model/btcpp/script_writers.hpp"

namespace btcheck::btcpp {
namespace {

constexpr std::size_t kMostValues = 128;
constexpr double kMostKept = 0x1p31;

class WorldMaker {
 public:
  WorldMaker(const BtcppExpansion& expansion, const ContractScripts& contracts)
      : expansion_(expansion), writers_(script_writers(expansion, contracts)) {
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
    return std::move(world_);
  }

 private:
  void find_names() {
    for (const PlacedScript& script : writers_.scripts) {
      std::set<EntryName> mentioned;
      for (const ScriptName& name : script.syntax.names) {
        const EntryName entry = entry_of(expansion_, script.subtree, name.name);
        mentioned.insert(entry);
        if (name.use == ScriptUse::Read || script.is_of_contract) {
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
    if (expansion_.document->release != BtcppRelease::V4) {
      writers_.all_foreign = "scripts are of version 4";
    }
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
      domain.is_text = !writers_.typed.contains(entry);
      world_.domains.push_back(std::move(domain));
    }
    for (const Setting& setting : writers_.settings) {
      if (ScriptDomain* domain = domain_of(setting.entry)) {
        domain->may_be_empty = true;
      }
    }
    for (const EntryName& entry : writers_.unset) {
      if (ScriptDomain* domain = domain_of(entry)) {
        domain->values.push_back(ScriptValue::unset());
      }
    }
    add_literals();
    find_bounds(expansion_, writers_, mentioned_, world_);
  }

  void add_literals() {
    for (const auto& [entry, value] : writers_.literals) {
      ScriptDomain* domain = domain_of(entry);
      if (domain == nullptr) continue;
      if (value.is_text()) {
        domain->takes_texts = true;
      } else {
        domain->is_text = false;
      }
      if (value.kind > ScriptKind::AnyText) domain->values.push_back(value);
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
    is_waiting_.assign(count, true);
    waiting_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      waiting_.push_back(i);
      for (const EntryName& entry : mentioned_[i]) {
        const auto found = world_.of.find(entry);
        if (found != world_.of.end()) users_[index(found->second)].push_back(i);
      }
    }
    while (!waiting_.empty()) {
      const std::size_t next = waiting_.front();
      waiting_.pop_front();
      is_waiting_[next] = false;
      if (!is_taken_up(next)) return false;
    }
    return true;
  }

  // Gives up the entries of which no value is known.
  bool are_known() {
    drop_lost_texts();
    bool all_known = true;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (world_.domains[i].values.size() > 1) continue;
      writers_.foreign[names_[i]] = "none of its values is known";
      all_known = false;
    }
    return all_known;
  }

  bool is_taken_up(std::size_t writer) {
    kept_.clear();
    run(writer);
    for (const auto& [variable, value] : kept_) {
      ScriptDomain& domain = world_.domains[index(variable)];
      const bool is_new = is_added(value, domain);
      if (domain.values.size() > kMostValues) {
        writers_.foreign[names_[index(variable)]] =
            fmt::format("it takes more than {} values", kMostValues);
        return false;
      }
      if (!is_new) continue;
      for (const std::size_t user : users_[index(variable)]) {
        if (is_waiting_[user]) continue;
        is_waiting_[user] = true;
        waiting_.push_back(user);
      }
    }
    return true;
  }

  // False when nothing is new.
  static bool is_added(const ScriptValue& value, ScriptDomain& domain) {
    const bool is_text = value.is_text();
    const bool was_text = domain.is_text;
    const bool took_texts = domain.takes_texts;
    domain.is_text = was_text && is_text;
    domain.takes_texts = took_texts || is_text;
    const bool is_kept = value.kind > ScriptKind::AnyText &&
                         !(is_text && !domain.is_text) &&
                         domain.index_of(value) == 0;
    if (is_kept) domain.values.push_back(value);
    return is_kept || domain.is_text != was_text ||
           domain.takes_texts != took_texts;
  }

  // A text that came before the first number is not kept either; what the
  // entry begins with is.
  void drop_lost_texts() {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      ScriptDomain& domain = world_.domains[i];
      const auto literal = writers_.literals.find(names_[i]);
      if (domain.is_text) continue;
      std::erase_if(domain.values, [&](const ScriptValue& value) {
        return value.kind == ScriptKind::Text &&
               (literal == writers_.literals.end() || literal->second != value);
      });
    }
  }

  void run(std::size_t writer) {
    const std::size_t scripts = writers_.scripts.size();
    if (writer >= scripts)
      return run_setting(writers_.settings[writer - scripts]);
    const PlacedScript& script = writers_.scripts[writer];
    ScriptRun run(expansion_, world_, script.subtree);
    run.on_keep([&](StateVariableId variable, const ScriptValue& value) {
      kept_.emplace(variable, value);
    });
    const ScriptTree& tree = script.syntax.tree;
    for (const std::uint32_t statement : tree.statements) {
      if (tree.terms[statement].depth > kMostScriptDepth) {
        return refuse(script);
      }
      run.execute(tree, statement);
    }
  }

  // What is too deep to be run may assign anything.
  void refuse(const PlacedScript& script) {
    for (const ScriptName& name : script.syntax.names) {
      if (name.use == ScriptUse::Read) continue;
      const auto found =
          world_.of.find(entry_of(expansion_, script.subtree, name.name));
      if (found != world_.of.end()) kept_.emplace(found->second, ScriptValue{});
    }
  }

  void run_setting(const Setting& setting) {
    const auto found = world_.of.find(setting.entry);
    if (found == world_.of.end()) return;
    ScriptRun run(expansion_, world_, 0);
    run.on_keep([&](StateVariableId variable, const ScriptValue& value) {
      kept_.emplace(variable, value);
    });
    run.set(found->second, setting);
  }

  void report_abstracted() {
    for (const EntryName& entry : read_) {
      if (world_.of.contains(entry)) continue;
      const auto reason = writers_.foreign.find(entry);
      world_.abstracted.push_back(
          {entry, reason != writers_.foreign.end()
                      ? reason->second
                      : "nothing in the tree writes it"});
    }
  }

  const BtcppExpansion& expansion_;
  ScriptWriters writers_;
  std::set<EntryName> read_;     // by scripts, or named by contracts
  std::set<EntryName> written_;  // by what can be modelled
  std::set<EntryName> created_;  // and made where there was none
  // By each script, then by each setting.
  std::vector<std::vector<EntryName>> mentioned_;

  ScriptWorld world_;
  std::vector<EntryName> names_;                 // of the variables
  std::vector<std::vector<std::size_t>> users_;  // of the variables
  std::deque<std::size_t> waiting_;              // scripts, then settings
  std::vector<bool> is_waiting_;
  std::set<std::pair<StateVariableId, ScriptValue>> kept_;
};

}  // namespace

ScriptValue ScriptDomain::kept(const ScriptValue& value) const {
  const double above = highest + 1;
  const double below = lowest - 1;
  const bool has_above = above <= kMostKept && value.kind != ScriptKind::AtMost;
  const bool has_below =
      below >= -kMostKept && value.kind != ScriptKind::AtLeast;
  if (!value.is_number()) return value;
  if (value.number >= above && has_above) {
    return {ScriptKind::AtLeast, above, {}};
  }
  if (value.number <= below && has_below) {
    return {ScriptKind::AtMost, below, {}};
  }
  return value.kind == ScriptKind::Number ? value : ScriptValue{};
}

std::size_t ScriptDomain::index_of(const ScriptValue& value) const {
  const auto found = std::find(values.begin(), values.end(), value);
  if (found == values.end()) return 0;
  return static_cast<std::size_t>(found - values.begin());
}

ScriptWorld script_world(const BtcppExpansion& expansion,
                         const ContractScripts& contracts) {
  return WorldMaker(expansion, contracts).make();
}

}  // namespace btcheck::btcpp
