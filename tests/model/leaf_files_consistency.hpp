// SPDX-License-Identifier: MIT
//
// What must hold of an XML tree with any text as its leaf contracts. The
// mutation tests and the fuzzer ask the same questions.
#pragma once

#include <string>
#include <string_view>

#include "btf_consistency.hpp"
#include "model/automata/network.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"

namespace btcheck {

// A tree with these contracts.
inline Result<BehaviorTree> tree_with_leaves(std::string_view text) {
  constexpr std::string_view kTree =
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">"
      "<BehaviorTree ID=\"M\"><ReactiveSequence><IsFree/>"
      "<SubTree ID=\"S\" level=\"{battery}\"/></ReactiveSequence>"
      "</BehaviorTree><BehaviorTree ID=\"S\"><Sequence>"
      "<Drive name=\"there\"/><Drive name=\"back\" left=\"{level}\"/>"
      "<Script code=\"done := level > 1\"/></Sequence></BehaviorTree>"
      "<TreeNodesModel><Condition ID=\"IsFree\"/><Action ID=\"Drive\">"
      "<output_port name=\"left\" type=\"int\"/></Action></TreeNodesModel>"
      "</root>";
  TreeReading reading;
  reading.profile = Profile::Btcpp4;
  reading.leaves = {{"t.leaves", std::string(text)}};
  return read_tree("t.xml", std::string(kTree), reading);
}

// What is wrong with it, or "".
inline std::string flaw_of_leaves(std::string_view text) {
  const auto read = tree_with_leaves(text);
  const std::string flaw = flaw_of(read);
  if (flaw.empty() && read.value) lower(*read.value, TickSemantics::Root);
  return flaw;
}

// Everything that such a text can say.
inline constexpr std::string_view kLeaves = R"(; what the leaves do
(defsv battery :init 3)
(defsv mode :init "slow")
(defaction S::*/back
  :returns (success failure running skipped)
  :requires (and (> level 1) (~ (= @mode "fast")))
  :answers once
  :duration [2,5]
  :on-success ((:= level (- level 1)) (:= @mode "fast"))
  :on-failure (:= level 0))
(defaction there :returns (success running) :answers anew :duration 1)
(defcondition "IsF?ee*" :returns (success) :requires (or true (< battery -2)))
)";

}  // namespace btcheck
