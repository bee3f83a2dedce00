// SPDX-License-Identifier: MIT
//
// A tree run with leaves of a test's own.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "model/lowering.hpp"
#include "model/tree/tree.hpp"
#include "run/engine/tree_engine.hpp"
#include "run/record/recorder.hpp"

namespace btcheck {

struct LoweredTree {
  explicit LoweredTree(const std::string& text) {
    auto read = read_btf("tree.btf", text);
    REQUIRE(read.value.has_value());
    tree = std::move(*read.value);
    network = lower(tree, TickSemantics::Root);
  }
  BehaviorTree tree;
  Network network;
};

struct Driven : EngineObserver {
  void breached(const Breach& breach) override { breaches.push_back(breach); }
  void stopped(NodeId node) override { stops.push_back(node); }

  std::string lines;
  std::vector<Breach> breaches;
  std::vector<NodeId> stops;
  EngineState end = EngineState::Ready;
  std::string reason;
  bool is_run_of_the_model = false;
};

// So many ticks at most; every step is executed once more.
inline Driven drive(const LoweredTree& lowered, const CompiledNetwork& system,
                    Leaves& leaves, OnBreach policy, int ticks) {
  Driven driven;
  RunRecorder recorder;
  TickTeller teller(lowered.tree, system, [&](const std::string& line) {
    driven.lines += line + "\n";
  });
  TreeEngine engine(lowered.tree, system, leaves, policy);
  engine.add(recorder);
  engine.add(teller);
  engine.add(driven);
  engine.begin();
  for (int t = 0; t < ticks && engine.state() == EngineState::Ready; ++t) {
    engine.tick();
  }
  driven.lines += teller.rest();
  driven.end = engine.state();
  driven.reason = engine.reason();
  engine.stop();
  const auto run = recorder.replayed(lowered.network);
  driven.is_run_of_the_model =
      run && run->state(run->steps.size()) == unpacked(system, engine.now());
  return driven;
}

}  // namespace btcheck
