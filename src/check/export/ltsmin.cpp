// SPDX-License-Identifier: MIT
//
// Time never stops in our runs: a state from which nothing leads is for ever
// followed by itself. LTSmin is told of these idle steps where it is asked for
// linear time, and of nothing else; so it counts what `space` counts, and
// judges what `check` judges. Runs on which only free variables move are none:
// an assumption in front of the formula says so.
#include "check/export/ltsmin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "model/export/layout.hpp"
#include "model/export/names.hpp"
#include "model/export/steps.hpp"

namespace btcheck {
namespace {

bool is_of_states(const Proposition& proposition) {
  return proposition.kind != PropositionKind::Moves &&
         proposition.kind != PropositionKind::Passes;
}

// A name in LTSmin's formulas and in a line of separated values.
std::string plain(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    const bool is_kept = code > ' ' && code < 127 && c != ',' && c != '"' &&
                         c != '\\' && c != '\'';
    name += is_kept ? c : '_';
  }
  return name;
}

class Names {
 public:
  void add(std::string_view text) {
    std::string name = plain(text);
    for (int i = 2; !used_.insert(name).second; ++i) {
      name = fmt::format("{}#{}", plain(text), i);
    }
    all_.push_back(std::move(name));
  }
  std::vector<std::string> take() { return std::move(all_); }

 private:
  std::set<std::string> used_;
  std::vector<std::string> all_;
};

std::string movers_text(const Network& network,
                        const std::vector<AutomatonId>& movers) {
  if (movers.empty()) return "false";
  const std::vector<std::string> names = mover_names(network);
  std::string text;
  for (const AutomatonId mover : movers) {
    append(text, " || ", fmt::format("node == \"{}\"", names[index(mover)]));
  }
  return "(" + text + ")";
}

std::string proposition_text(const Network& network, const LtsminClaim& claim,
                             std::size_t number) {
  const Proposition& of = claim.propositions.at(number);
  const std::string label = label_name(claim, number);
  switch (of.kind) {
    case PropositionKind::State:
      return label;
    case PropositionKind::Enter:
      return fmt::format("(!{0} && X {0})", label);
    case PropositionKind::Leave:
      return fmt::format("({0} && X !{0})", label);
    case PropositionKind::Moves:
      return movers_text(network, of.movers);
    case PropositionKind::Passes:
      return fmt::format("node == \"{}\"", mover_names(network).back());
  }
  return {};
}

std::string formula_text(const Network& network, const LtsminClaim& claim) {
  const std::string formula =
      with_propositions(claim.formula, [&](std::size_t number) {
        return proposition_text(network, claim, number);
      });
  const bool has_front = !claim.is_invariant && has_free_moves(network);
  return has_front
             ? fmt::format("([] (<> progress == \"yes\")) -> ({})", formula)
             : formula;
}

std::string claim_text(std::string_view file, const Network& network,
                       const LtsminClaim& claim) {
  std::string text = fmt::format("\n# {}\n", claim.name);
  for (const std::string& remark : claim.remarks) {
    text += fmt::format("#   {}\n", remark);
  }
  const std::string formula = formula_text(network, claim);
  if (claim.is_invariant) {
    return text + fmt::format("pins2lts-mc $load --invariant='{}' {}\n",
                              formula, file);
  }
  return text + fmt::format("BTCHECK_PINS={} pins2lts-mc $load --ltl='{}' {}\n",
                            kTellsIdle, formula, file);
}

}  // namespace

std::string label_name(const LtsminClaim& claim, std::size_t number) {
  return fmt::format("{}_p{}", claim.name, number);
}

std::vector<LtsminLabel> labels_of(const std::vector<LtsminClaim>& claims) {
  std::vector<LtsminLabel> labels;
  for (const LtsminClaim& claim : claims) {
    for (std::size_t i = 0; i < claim.propositions.size(); ++i) {
      if (!is_of_states(claim.propositions[i])) continue;
      labels.push_back({label_name(claim, i), claim.propositions[i].of});
    }
  }
  return labels;
}

std::vector<std::string> action_names(const Network& network) {
  Names names;
  for (const Automaton& automaton : network.automata) {
    for (const Edge& edge : automaton.edges) {
      names.add(fmt::format("{}:{}->{}", automaton.name,
                            automaton.source(edge).name,
                            automaton.target(edge).name));
    }
  }
  names.add("time");
  return names.take();
}

std::vector<std::string> mover_names(const Network& network) {
  Names names;
  for (const Automaton& automaton : network.automata) {
    names.add(automaton.name);
  }
  names.add("time");
  return names.take();
}

std::string ltsmin_text(std::string_view name, std::string_view words,
                        const Network& network,
                        const std::vector<LtsminClaim>& claims) {
  const std::string stem(name.substr(name.rfind('/') + 1));
  const std::string file = as_identifier(stem) + ".btpins";
  std::string text = fmt::format(
      "# {0}, for LTSmin: `sh THIS_FILE libbtcheck-pins.so`, with a path\n"
      "# before the name of the module; or line by line.\n"
      "load=--loader=${{1:?where is libbtcheck-pins.so}}\n"
      "cat >{1} <<'END'\n{2}\nEND\n"
      "\n# every state\n"
      "pins2lts-seq $load {1}\n"
      "pins2lts-mc $load --strategy=bfs --state=tree {1}\n"
      "BTCHECK_PINS=--packed mpirun -x BTCHECK_PINS -np 2 pins2lts-dist --mpi "
      "$load "
      "{1}\n"
      "pins2lts-sym $load {1}\n"
      "\n# dead states\n"
      "pins2lts-mc $load --strategy=bfs --deadlock {1}\n",
      comment_text(stem), file, words);
  for (const LtsminClaim& claim : claims) {
    text += claim_text(file, network, claim);
  }
  return text;
}

}  // namespace btcheck
