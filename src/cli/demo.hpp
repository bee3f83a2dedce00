// SPDX-License-Identifier: MIT
//
// The texts of `btcheck demo`, compiled in from examples/ at build time.
#pragma once

#include <string_view>

namespace btcheck {

// What is said before, between and after the two checks.
inline constexpr std::string_view kDemoBegin = R"(
A drone surveys an area. Its behavior tree is the published one of a paper by
F. Ingrand: before anything else, every tick, it measures the battery. Four
rules, checked against every run that the tree can have:

)";
inline constexpr std::string_view kDemoFinding = R"(
The hole: on the way to the charger (line 27) the plain Sequence on line 17
resumes its running child, so the nodes to the left of it are not ticked again.
A battery that turns Critical on that flight is never noticed.

With a ReactiveSequence on line 17 (examples/drone3-fixed.btf), proven over
every run:

)";
inline constexpr std::string_view kDemoEnd = R"(
Next:  btcheck your_tree.btf            what each of its nodes can and cannot do
       btcheck your_tree.btf --prop your_rules.ltl
)";

extern const std::string_view kDemoTree;
extern const std::string_view kDemoFixedTree;
extern const std::string_view kDemoProperties;

}  // namespace btcheck
