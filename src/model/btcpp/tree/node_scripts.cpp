// SPDX-License-Identifier: MIT
#include "model/btcpp/tree/node_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "model/btcpp/entries/run.hpp"
#include "model/btcpp/enumerators.hpp"
#include "model/btcpp/script/script.hpp"
#include "model/btcpp/script/value.hpp"
#include "text/findings.hpp"
#include "text/utf8.hpp"

namespace btcheck::btcpp {
namespace {

Script of(std::string text, ScriptMeaning meaning, std::int32_t program) {
  Script script;
  script.text = std::move(text);
  script.assignments = std::move(meaning.assignments);
  script.may_hold = std::move(meaning.may_hold);
  script.may_fail = std::move(meaning.may_fail);
  script.program = program;
  if (!is_never(meaning.may_lack)) {
    script.may_lack = std::move(meaning.may_lack);
  }
  if (!is_never(meaning.may_leave)) {
    script.may_leave = std::move(meaning.may_leave);
  }
  return script;
}

Expression where_one(const Expression& left, const Expression& right) {
  if (is_never(left)) return right;
  return is_never(right) ? left
                         : Expression::binary(Operation::Or, left, right);
}

// With one blank for every gap.
std::string in_one_line(std::string_view code) {
  std::string line(code);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\t' || c == '\r'; },
      ' ');
  return wrapped(line, 0, std::string::npos);
}

// What the map says of an entry, or a default.
template <class Value>
Value value_at(const std::map<EntryName, Value>& map, const EntryName& entry) {
  const auto found = map.find(entry);
  return found == map.end() ? Value() : found->second;
}

// The name in `{name}`; nothing for a literal.
std::optional<std::string> pointed_at(std::string_view port) {
  if (!port.starts_with('{') || !port.ends_with('}')) return std::nullopt;
  port = port.substr(1, port.size() - 2);
  const std::size_t begin = port.find_first_not_of(' ');
  if (begin == port.npos) return std::string();
  return std::string(
      port.substr(begin, port.find_last_not_of(' ') - begin + 1));
}

}  // namespace

NodeScripts::NodeScripts(const BtcppExpansion& expansion,
                         const ContractScripts& contracts,
                         const ScriptDetail& detail)
    : expansion_(expansion),
      world_(script_world(expansion, contracts, detail)),
      programs_(std::make_shared<EntryPrograms>()) {
  programs_->release = expansion.document->engine();
  programs_->enums = enumerators_of(*expansion.document);
  for (const auto& [entry, variable] : world_.of) {
    if (world_.domain(variable).limits) add_measurements(entry, variable);
  }
}

// What is executed where a declared entry comes to each of its values.
void NodeScripts::add_measurements(const EntryName& entry,
                                   StateVariableId variable) {
  StateVariable& of = world_.variables[index(variable)];
  const EntryNumber number = number_of(entry);
  of.programs.assign(of.states.size(), kNoProgram);
  for (const int state : of.measured) {
    const auto at = static_cast<std::size_t>(state);
    EntryProgram program;
    program.text = fmt::format("{} := {}", of.name, of.value_name(state));
    program.writes = {{number, world_.domain(variable).values[at]}};
    program.writes_surely = true;
    of.programs[at] = add(std::move(program));
  }
}

EntryNumber NodeScripts::number_of(const EntryName& entry) {
  const auto next = static_cast<EntryNumber>(programs_->entries.size());
  const auto [found, is_new] = numbers_.emplace(entry, next);
  if (!is_new) return found->second;
  ProgramEntry made;
  made.subtree = entry.subtree;
  made.key = made.name = entry.name;
  made.variable = world_.variable_of(entry);
  if (made.variable) made.name = world_.variables[index(*made.variable)].name;
  made.initial = value_at(world_.writers.literals, entry);
  made.declared = value_at(world_.writers.declared, entry);
  made.exists = world_.writers.declared.contains(entry);
  made.is_typed_by_leaves = world_.writers.typed_by_leaves.contains(entry);
  made.is_foreign = !made.variable && !world_.lost.contains(entry);
  made.is_enumerator = may_be_enumerator(entry);
  if (made.variable) made.limits = world_.domain(*made.variable).limits;
  made.group = value_at(world_.groups, entry);
  programs_->entries.push_back(std::move(made));
  return next;
}

// One that nothing in the tree writes, and the program is not known to write.
bool NodeScripts::may_be_enumerator(const EntryName& entry) const {
  const auto reason = world_.abstracted.find(entry);
  return expansion_.document->release == BtcppRelease::V4 &&
         reason != world_.abstracted.end() &&
         reason->second == kNothingWrites &&
         !world_.writers.declared.contains(entry) &&
         btcpp::may_be_enumerator(entry.name);
}

std::int32_t NodeScripts::add(EntryProgram program) {
  programs_->programs.push_back(std::move(program));
  return static_cast<std::int32_t>(programs_->programs.size() - 1);
}

Script NodeScripts::script(ScriptRole role, std::uint32_t subtree,
                           std::string_view code) {
  const bool is_action =
      role == ScriptRole::Action || role == ScriptRole::Effect;
  const bool is_of_contract =
      role == ScriptRole::Requirement || role == ScriptRole::Effect;
  ScriptSyntax syntax = is_of_contract
                            ? parse_contract_script(code, *expansion_.document)
                            : parse_script(code, *expansion_.document);
  const Expression never = Expression::constant(0);
  if (!syntax.flaw.empty()) {
    Script unread;
    if (is_action) unread.may_fail = never;
    return unread;
  }
  ScriptMeaning meaning =
      compile_script(expansion_, world_, subtree, syntax, is_of_contract);
  EntryProgram program;
  program.text = in_one_line(code);
  program.is_condition = !is_action;
  program.is_of_contract = is_of_contract;
  program.tree = std::move(syntax.tree);
  program.names.resize(program.tree.terms.size());
  program.is_own_name.resize(program.tree.terms.size());
  const bool may_run = !is_too_deep(program.tree);
  for (std::size_t i = 0; i < program.names.size(); ++i) {
    const ScriptTerm& term = program.tree.terms[i];
    if (term.operation != ScriptOperation::Name) continue;
    const EntryName entry = entry_of(expansion_, subtree, term.text);
    program.names[i] = number_of(entry);
    program.is_own_name[i] = is_own_name(entry, subtree, term.text);
  }
  if (meaning.is_rough) note_rough(program);
  if (is_action) {
    meaning.may_hold = std::move(meaning.may_end);
    meaning.may_fail = never;
  }
  std::string text = program.text;
  std::optional<Expression> may_throw;
  if (may_run && !is_of_contract && may_throw_as_said(program, meaning)) {
    may_throw = is_action
                    ? std::move(meaning.may_throw)
                    : where_one(meaning.may_throw, meaning.may_be_no_truth);
  }
  const std::int32_t number = may_run ? add(std::move(program)) : kNoProgram;
  Script script = of(std::move(text), std::move(meaning), number);
  if (may_throw && !is_never(*may_throw)) {
    script.may_throw = std::move(may_throw);
  }
  return script;
}

// Whether to keep where the script may throw: an execution with real values can
// confirm it. An entry from outside is assumed to hold what the script needs.
bool NodeScripts::may_throw_as_said(const EntryProgram& program,
                                    const ScriptMeaning& meaning) const {
  const auto entries = program.entries();
  return meaning.is_simplified ||
         std::ranges::none_of(entries, [&](EntryNumber entry) {
           return programs_->entries[entry].is_foreign;
         });
}

ProgramOperand NodeScripts::operand_of(std::uint32_t subtree,
                                       std::string_view port) {
  const auto name = pointed_at(port);
  if (!name) return {{}, std::string(port)};
  return {number_of(entry_of(expansion_, subtree, *name)), {}};
}

Script NodeScripts::equality(std::uint32_t subtree, PortComparison how,
                             std::string_view one, std::string_view other) {
  EntryProgram program;
  program.kind = EntryProgram::Kind::Equality;
  program.how = how;
  program.left = operand_of(subtree, one);
  program.right = operand_of(subtree, other);
  Script script;
  script.text = program.text = fmt::format("{} == {}", one, other);
  // The values of each side: of its entry, or the one that is written.
  struct Side {
    std::optional<StateVariableId> variable;
    std::vector<ScriptValue> values;
  };
  const auto side_of = [&](const ProgramOperand& operand) {
    if (!operand.entry) return Side{{}, {ScriptValue::of(operand.text)}};
    const auto variable = programs_->entries[*operand.entry].variable;
    if (!variable) return Side{{}, {ScriptValue::any()}};
    return Side{variable, world_.domains[index(*variable)].values};
  };
  const Side left = side_of(program.left);
  const Side right = side_of(program.right);
  const auto where = [](const Side& side, std::size_t i) {
    return side.variable
               ? ScriptGuard::is(*side.variable, i, side.values.size())
               : ScriptGuard::always();
  };
  const bool is_itself = left.variable && left.variable == right.variable;
  ScriptGuard holds;
  ScriptGuard fails;
  bool is_rough = false;
  for (std::size_t i = 0; i < left.values.size(); ++i) {
    for (std::size_t k = 0; k < right.values.size(); ++k) {
      if (is_itself && i != k) continue;
      const ScriptEnums* enums = programs_->enums.get();
      const Equality here =
          compared(how, left.values[i], right.values[k], enums);
      if (is_beside_enumerator(how, left.values[i], right.values[k], enums)) {
        note_open_case(program, left.values[i], right.values[k]);
      }
      is_rough |= here.may_hold && here.may_fail && !is_open(left.values[i]) &&
                  !is_open(right.values[k]);
      const ScriptGuard guard = both(where(left, i), where(right, k));
      if (here.may_hold) holds = either(holds, guard);
      if (here.may_fail) fails = either(fails, guard);
    }
  }
  script.may_hold = holds.expression();
  script.may_fail = fails.expression();
  if (is_rough) note_rough(program);
  script.program = add(std::move(program));
  return script;
}

std::optional<Script> NodeScripts::reading(std::uint32_t subtree, PortType type,
                                           std::string_view name,
                                           std::string_view value) {
  EntryProgram program;
  program.kind = EntryProgram::Kind::Reading;
  program.port = type;
  program.left = operand_of(subtree, value);
  if (!program.left.entry) return std::nullopt;
  const auto variable = programs_->entries[*program.left.entry].variable;
  if (!variable) return std::nullopt;
  ScriptGuard suits;
  ScriptGuard throws;
  ScriptGuard lacks;
  bool is_rough = false;
  const auto& values = world_.domain(*variable).values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ScriptGuard here = ScriptGuard::is(*variable, i, values.size());
    const PortReading reads = read_by_port(type, values[i]);
    const bool is_unknown = values[i].kind == ScriptKind::Unknown;
    if (reads.may_suit) suits = either(suits, here);
    if (is_unknown) lacks = either(lacks, here);
    if (reads.may_throw && !is_unknown) throws = either(throws, here);
    is_rough |= reads.may_suit && reads.may_throw && !is_unknown;
  }
  Script script;
  script.text = program.text = fmt::format("{}=\"{}\"", name, value);
  script.may_hold = suits.expression();
  script.may_fail = Expression::constant(0);
  const auto where = [](const ScriptGuard& guard) {
    const Expression here = guard.expression();
    return is_never(here) ? std::nullopt : std::optional(here);
  };
  script.may_lack = where(lacks);
  script.may_throw = where(throws);
  if (!script.may_lack && !script.may_throw) return std::nullopt;
  if (is_rough) note_rough(program);
  script.program = add(std::move(program));
  return script;
}

Script NodeScripts::set_blackboard(const BtcppInstance& node) {
  ScriptMeaning meaning = compile_set_blackboard(expansion_, world_, node);
  std::int32_t number = kNoProgram;
  std::string text;
  if (const auto setting = setting_of(expansion_, node)) {
    EntryProgram program;
    program.kind = EntryProgram::Kind::Setting;
    program.left.entry = number_of(setting->entry);
    program.is_own = setting->is_own;
    program.right.text = setting->text;
    if (setting->source) program.right.entry = number_of(*setting->source);
    text = program.text =
        setting->source
            ? fmt::format("{} := {{{}}}", setting->entry.name,
                          setting->source->name)
            : fmt::format("{} := \"{}\"", setting->entry.name, setting->text);
    if (meaning.is_rough) note_rough(program);
    number = add(std::move(program));
  }
  return of(std::move(text), std::move(meaning), number);
}

Script NodeScripts::unset_blackboard(const BtcppInstance& node) {
  ScriptMeaning meaning = compile_unset_blackboard(expansion_, world_, node);
  std::int32_t number = kNoProgram;
  if (const auto entry = unset_by(expansion_, node)) {
    EntryProgram program;
    program.kind = EntryProgram::Kind::Unsetting;
    program.left.entry = number_of(*entry);
    program.text = fmt::format("unset {}", entry->name);
    number = add(std::move(program));
  }
  return of("", std::move(meaning), number);
}

// Before what the contract itself says.
void NodeScripts::add_port_writes(std::uint32_t instance,
                                  LeafContract& contract) {
  const auto found = world_.writers.port_writes.find(instance);
  if (found == world_.writers.port_writes.end()) return;
  std::vector<WrittenEntry> written;
  for (const PortWrite& write : found->second) {
    const auto variable = world_.variable_of(write.entry);
    if (!variable) continue;
    if (world_.domain(*variable).limits) {
      auto& all = contract.measures;
      const bool is_new = std::ranges::find(all, *variable) == all.end();
      if (is_new) all.push_back(*variable);
      continue;
    }
    written.push_back({number_of(write.entry), write.value});
  }
  if (written.empty()) return;
  const auto add_to = [&](std::vector<StateAssignment>& assignments,
                          std::int32_t& program, bool is_sure) {
    const auto writes = compile_port_writes(world_, found->second, is_sure);
    assignments.insert(assignments.begin(), writes.begin(), writes.end());
    if (program == kNoProgram) program = add({});
    EntryProgram& executed =
        programs_->programs[static_cast<std::size_t>(program)];
    executed.writes = written;
    executed.writes_surely = is_sure;
  };
  add_to(contract.on_success, contract.success_program, true);
  add_to(contract.on_failure, contract.failure_program, false);
  add_to(contract.on_running, contract.running_program, false);
}

std::string NodeScripts::why_too_large(std::uint32_t subtree,
                                       std::string_view name) const {
  return value_at(world_.too_large, entry_of(expansion_, subtree, name));
}

EntryType NodeScripts::type_by_ports(std::uint32_t subtree,
                                     std::string_view name) const {
  return value_at(world_.writers.declared, entry_of(expansion_, subtree, name));
}

std::vector<EntryName> NodeScripts::written_by_open_ports(
    std::uint32_t instance) const {
  std::vector<EntryName> all;
  const auto found = world_.writers.port_writes.find(instance);
  if (found == world_.writers.port_writes.end()) return all;
  for (const PortWrite& write : found->second) {
    const auto variable = world_.variable_of(write.entry);
    if (!variable || !write.is_open_port) continue;
    // What moves by itself may have any value at any time anyhow.
    const bool is_free =
        world_.variables[index(*variable)].moves == Moves::Free;
    if (!is_free) all.push_back(write.entry);
  }
  return all;
}

std::optional<std::string> NodeScripts::why_abstracted(
    std::uint32_t subtree, std::string_view name) const {
  const auto found =
      world_.abstracted.find(entry_of(expansion_, subtree, name));
  if (found == world_.abstracted.end()) return std::nullopt;
  return found->second;
}

void NodeScripts::note_open_case(const EntryProgram& program,
                                 const ScriptValue& one,
                                 const ScriptValue& other) {
  const std::string& name =
      btcpp::may_be_enumerator(one.text) ? one.text : other.text;
  for (const EntryNumber entry : program.entries()) {
    open_cases_[entry].insert(name);
  }
}

void NodeScripts::note_rough(const EntryProgram& program) {
  for (const EntryNumber entry : program.entries()) rough_.insert(entry);
}

// First the entries without a state variable, then those whose values are
// not told apart well enough somewhere.
std::vector<OpenEntry> NodeScripts::open_entries() const {
  std::vector<OpenEntry> all;
  const auto add_entry = [&](const EntryName& entry, std::string name,
                             std::string reason, bool is_rough) {
    OpenEntry open{std::move(name),
                   std::move(reason),
                   {},
                   0,
                   is_rough,
                   value_at(world_.groups, entry)};
    const auto node = world_.first_node.find(entry);
    if (node != world_.first_node.end()) {
      const BtcppPlace& place = expansion_.nodes[node->second].node->place;
      open.span = place.span;
      open.included = place.file;
    }
    all.push_back(std::move(open));
  };
  for (const auto& [entry, reason] : world_.abstracted) {
    const std::string& path = expansion_.subtrees[entry.subtree].path;
    const bool may_be_named = may_be_enumerator(entry);
    add_entry(entry, path.empty() ? entry.name : path + "/" + entry.name,
              may_be_named ? std::string(kMayBeEnumerator) : reason,
              may_be_named || world_.lost.contains(entry));
  }
  for (const EntryNumber number : rough_) {
    const ProgramEntry& entry = programs_->entries[number];
    if (!entry.variable) continue;
    const ScriptDomain& domain = world_.domains[index(*entry.variable)];
    const bool has_ranges =
        !domain.limits &&
        std::ranges::any_of(domain.values, [](const ScriptValue& value) {
          return value.is_range();
        });
    const auto cases = open_cases_.find(number);
    if (cases != open_cases_.end()) {
      add_entry({entry.subtree, entry.key}, entry.name,
                fmt::format("it is compared with {}, {}",
                            listed(std::vector<std::string>(
                                cases->second.begin(), cases->second.end())),
                            kMayBeEnumerator),
                true);
      continue;
    }
    add_entry({entry.subtree, entry.key}, entry.name,
              has_ranges ? fmt::format("only numbers from {} to {} are told "
                                       "apart",
                                       domain.lowest, domain.highest)
                         : "what is computed with it is not always known",
              true);
  }
  return all;
}

}  // namespace btcheck::btcpp
