// SPDX-License-Identifier: MIT
//
// What a tick of the engine costs: `engine_tick TREE.btf`. Leaves are polled
// functions that do nothing but count, so what is measured is the engine. An
// action runs for three ticks and succeeds; a mission that has ended is begun
// again.
#include <string>
#include <vector>

#include "btcheck/run.hpp"
#include "file_text.hpp"
#include "measured_ticks.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"

namespace {

using namespace btcheck::run;

Engine engine_for(const std::string& name, const std::string& text,
                  const btcheck::BehaviorTree& tree) {
  Options options;
  options.pace = Pace::AtOnce;
  options.keep = Options::Keep::Nothing;
  Engine engine(name, text, options);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const btcheck::Node& node = tree.nodes[n];
    const std::string leaf = btcheck::unique_name(tree, btcheck::NodeId{n});
    if (node.type == btcheck::NodeType::Action) {
      engine.polled(leaf, [turns = 0](const Call&, Turn turn) mutable {
        turns = turn == Turn::Start ? 0 : turns + 1;
        return turns < 3 ? Status::Running : Status::Success;
      });
    } else if (node.type == btcheck::NodeType::Condition) {
      engine.condition(
          leaf, [](const Call&) { return true; }, Runs::InTick);
    } else if (node.type == btcheck::NodeType::SetSV) {
      const btcheck::StateVariable& variable = tree.variable(node.variable);
      const Value value = variable.is_enumeration() ? Value(variable.states[0])
                                                    : Value(variable.initial);
      engine.measure(
          leaf, [value](const Call&) { return value; }, Runs::InTick);
    }
  }
  return engine;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::string text = btcheck::file_text(argv[1]);
  const auto read = btcheck::read_btf(argv[1], text);
  if (!read.value) return 2;
  measure_ticks("btcheck", [&] {
    return [engine = engine_for(argv[1], text, *read.value)]() mutable {
      return engine.tick() == End::None;
    };
  });
}
