// SPDX-License-Identifier: MIT
//
// The networks on which reductions are compared, all their states written out.
//
// What random trees have too rarely is put into them: a second tree that works
// on the same variables, so that edges of different trees depend on each other;
// and weather that is asked twice, so that it matters whether it may change in
// between. Every fifth is an XML tree, with the nodes of each profile in turn.
#include "reference/reduction_cases.hpp"

#include <algorithm>
#include <array>

#include "model/lowering.hpp"
#include "model/tree_file.hpp"
#include "reference/effort.hpp"
#include "reference/random_tree.hpp"
#include "reference/random_xml_tree.hpp"

namespace btcheck::reference {
namespace {

constexpr TickSemantics kTicks[] = {TickSemantics::Root, TickSemantics::Leaves,
                                    TickSemantics::Nodes, TickSemantics::None};

std::array<RandomTreeWeights, 4> weight_settings() {
  RandomTreeWeights plain;
  plain.max_nodes = 7;
  RandomTreeWeights one_of_two = plain;
  one_of_two.max_nodes = 3;
  one_of_two.max_parallels = 0;
  one_of_two.max_variables = 0;
  one_of_two.max_running = 1;
  one_of_two.duration = 0;
  one_of_two.looping_root = 0;
  RandomTreeWeights timed = plain;
  timed.duration = 70;
  timed.contract = 60;
  timed.sampled = 20;
  timed.timed_moves = 60;
  RandomTreeWeights weathered = plain;
  weathered.max_nodes = 5;
  return {plain, one_of_two, timed, weathered};
}

bool is_tree(const SExpression& form) {
  return form.is_list && !form.list.empty() &&
         form.list.front().word == "BehaviorTree";
}

// Makes the tree's child a Sequence of these three.
void surround(SExpression& tree, std::string_view before, SExpression work,
              std::string_view after) {
  SExpression all = parse_s_expression("(Sequence)");
  if (!before.empty()) all.list.push_back(parse_s_expression(before));
  all.list.push_back(std::move(work));
  all.list.push_back(parse_s_expression(after));
  tree.list.back() = std::move(all);
}

void define(SExpression& file, std::string_view variable) {
  file.list.insert(file.list.begin(), parse_s_expression(variable));
}

// The same tree twice, in parallel: when they have done their work, `t` looks
// at a door and `u` opens it.
std::string doubled(const std::string& text) {
  SExpression file = parse_s_expression(text);
  SExpression& first =
      *std::find_if(file.list.begin(), file.list.end(), is_tree);
  SExpression second = first;
  std::replace(second.list.begin(), second.list.end(),
               parse_s_expression("(t)").list.front(),
               parse_s_expression("(u)").list.front());
  surround(first, "", SExpression(first.list.back()), "(Eval (= door Open))");
  surround(second, "", SExpression(second.list.back()),
           "(Eval (:= door Open))");
  file.list.push_back(std::move(second));
  file.list.push_back(parse_s_expression("(Trees t u)"));
  define(file, "(defsv door :states (Open Closed) :init Closed)");
  return print_s_expression(file);
}

// What the tree does, between two questions for the weather.
std::string weathered(const std::string& text) {
  SExpression file = parse_s_expression(text);
  SExpression& tree =
      *std::find_if(file.list.begin(), file.list.end(), is_tree);
  SExpression work = parse_s_expression("(ForceSuccess)");
  work.list.push_back(tree.list.back());
  surround(tree, "(Eval (= weather Dry))", std::move(work),
           "(Eval (= weather Wet))");
  define(file, text.size() % 2 == 0
                   ? "(defsv weather :states (Dry Wet) :transitions :all)"
                   : "(defsv weather :states (Dry Wet)"
                     " :transitions ((Dry Wet [1,2]) (Wet Dry [0,1])))");
  return print_s_expression(file);
}

// Whose nodes an XML tree has.
Profile profile_of(std::uint64_t seed) {
  constexpr std::array<Profile, 5> kProfiles = {
      Profile::Btcpp38, Profile::Btcpp4, Profile::Nav2Humble,
      Profile::Nav2Jazzy, Profile::Nav2Main};
  return kProfiles[seed / 5 % kProfiles.size()];
}

std::string text_of(std::uint64_t seed) {
  const std::size_t kind = seed % 5;
  if (kind == 4) return random_xml_tree(seed, profile_of(seed));
  const std::string text = random_tree(seed, weight_settings()[kind]);
  if (kind == 1) return doubled(text);
  return kind == 3 ? weathered(text) : text;
}

int timers(const Network& network) {
  return static_cast<int>(std::count_if(
      network.automata.begin(), network.automata.end(),
      [](const Automaton& each) { return each.kind == AutomatonKind::Timer; }));
}

int ranged_timers_of(const Network& network) {
  return static_cast<int>(std::count_if(
      network.automata.begin(), network.automata.end(),
      [](const Automaton& each) {
        return each.kind == AutomatonKind::Timer &&
               std::any_of(each.edges.begin(), each.edges.end(),
                           [](const Edge& edge) {
                             return edge.when.lower != edge.when.upper;
                           });
      }));
}

bool has_free_variable(const Network& network) {
  return std::any_of(network.automata.begin(), network.automata.end(),
                     [](const Automaton& automaton) {
                       return automaton.kind == AutomatonKind::StateVariable &&
                              !automaton.edges.empty();
                     });
}

bool is_xml(const std::string& text) { return text.starts_with('<'); }

bool has_word(const std::string& text, std::string_view word) {
  return text.find(word) != std::string::npos;
}

}  // namespace

std::optional<ReductionCase> reduction_case(const std::string& text,
                                            TickSemantics ticks,
                                            std::uint64_t seed) {
  TreeReading reading;
  if (is_xml(text)) {
    // No node of theirs takes time.
    if (ticks == TickSemantics::Leaves || ticks == TickSemantics::Nodes) {
      return std::nullopt;
    }
    reading.profile = profile_of(seed);
    reading.loops = seed % 2 == 0;
    reading.wakes = seed % 3 == 0;
  }
  const auto tree =
      read_tree(is_xml(text) ? "random.xml" : "random.btf", text, reading);
  if (!tree.value) return std::nullopt;
  Network network = lower(*tree.value, ticks);
  auto space = naive_space(network, kMostStatesOfCase);
  if (!space) return std::nullopt;
  return ReductionCase{text, ticks, seed, std::move(network),
                       std::move(*space)};
}

void for_reduction_cases(
    unsigned own_seed, int trees,
    const std::function<GoOn(const ReductionCase&)>& check) {
  const std::uint64_t first = shifted_seed(own_seed) * std::uint64_t{1'000'000};
  for (int i = 0; i < trees; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const std::string text = text_of(seed);
    for (const TickSemantics ticks : kTicks) {
      const auto made = reduction_case(text, ticks, seed);
      if (made && check(*made) == GoOn::No) return;
    }
  }
}

void ReductionCensus::count(const ReductionCase& each) {
  const NaiveNetwork naive(each.network);
  ++networks;
  xml_trees += is_xml(each.text);
  several_trees += has_word(each.text, "(Trees");
  untimed += each.ticks == TickSemantics::None;
  free_variables += has_free_variable(each.network);
  contracts += has_word(each.text, ":on-success") ||
               has_word(each.text, ":on-failure") ||
               has_word(each.text, ":requires");
  const int ranged = ranged_timers_of(each.network);
  ranged_timers += ranged > 0;
  fixed_timers += timers(each.network) > ranged;
  faults += std::any_of(
      each.space.states.begin(), each.space.states.end(),
      [&](const NaiveState& state) { return naive.is_faulty(state); });
  states += each.space.states.size();
}

}  // namespace btcheck::reference
