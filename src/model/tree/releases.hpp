// SPDX-License-Identifier: MIT
//
// What BehaviorTree.CPP does in some of its releases only. Everything that is
// not here is the same from 3.5.1 to 3.8.8 and from 4.0.2 to 4.10.0. Each row
// was read from the sources on both sides of its bounds; docs/btcpp.md tells
// what it means for a tree.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"

namespace btcheck::releases {

inline constexpr int kFirst = 1;        // any; 0 is none
inline constexpr int kFirst4 = 40'000;  // no release of version 3

// The last patch of each minor release, and those between which what is refused
// has changed; the newest first.
inline constexpr std::array kKnown = {41000, 40901, 40804, 40803, 40703, 40602,
                                      40502, 40403, 40308, 40201, 40101, 40002,
                                      30808, 30700, 30601, 30506, 30501};

// Those of the same version as `release` that are so, as `is` says of each of
// kKnown; empty where all are.
template <class Is>
std::vector<Releases> those(int release, const Is& is) {
  std::vector<Releases> found;
  bool are_all = true;
  int end = release < kFirst4 ? kFirst4 : kNoRelease;
  for (std::size_t i = 0; i < kKnown.size(); ++i) {
    if ((kKnown[i] < kFirst4) != (release < kFirst4)) continue;
    const bool is_last =
        i + 1 == kKnown.size() || kKnown[i + 1] / 10'000 != kKnown[i] / 10'000;
    const int first = !is_last            ? kKnown[i + 1] + 1
                      : release < kFirst4 ? kFirst
                                          : kFirst4;
    if (!is(kKnown[i])) {
      are_all = false;
    } else if (!found.empty() && found.back().first == end) {
      found.back().first = first;
    } else {
      found.push_back({first, end});
    }
    end = first;
  }
  return are_all ? std::vector<Releases>() : found;
}

// --- Ticks: src/controls, src/decorators, src/tree_node.cpp ------------------

// A second child that runs while another one has run in the same activation
// makes the node throw.
inline constexpr Releases kReactiveSequenceThrows = {40200, 40600};
inline constexpr Releases kReactiveFallbackThrows = {40308, 40600};
// Which child has run is not forgotten when the node ends.
inline constexpr Releases kReactiveNotesForLife = {40200, 40308};
// Whichever child runs, only those on its right are reset.
constexpr bool reactive_resets_right(int release) {
  return Releases{kFirst, 30806}.has(release) ||
         Releases{kFirst4, 40301}.has(release);
}
// ReactiveFallback resets its children only where all have failed.
inline constexpr Releases kReactiveFallbackKeeps = {kFirst4, 40306};
// SKIPPED is a status that a node has until it is reset. It is not idle: of its
// preconditions, which are executed in every tick, only `_while` counts.
inline constexpr Releases kSkippedStays = {kFirst4, 40304};
// Not modelled: what a node that is skipped does before 4.1, and which halts
// execute `_onHalted`.
inline constexpr Releases kSkipsOtherwise = {kFirst4, 40100};
inline constexpr Releases kTellsFewHalts = {kFirst4, 40303};
// A node that its `_while` halts runs on, for all that others see.
inline constexpr Releases kWhileLeavesRunning = {40304, 40401};
// A Sequence or Fallback yields to others after each child that ended in its
// first tick; the Async forms came later.
inline constexpr Releases kSequencesYield = {kFirst4, 40200};
// A tree that is woken up is not ticked again within tickOnce.
inline constexpr Releases kTicksOnce = {kFirst4, 40100};
// SequenceWithMemory, halted, begins anew.
inline constexpr Releases kMemoryEndsWithHalt = {kFirst4, 40401};
// Whether all children were skipped is noted from idle to idle.
inline constexpr Releases kNotesAllSkipped = {kFirst4, 40700};
// Parallel counts anew in each tick, and compares a count when it has grown.
constexpr bool parallel_counts_anew(int release) { return release < 40302; }
// The timer of a Timeout goes on when it is halted.
constexpr bool timeout_outlives_halt(int release) { return release < 40305; }
// A child that is skipped ends a Delay or a Timeout, and is reset by a Delay or
// a SubTree; with it ForceSuccess and ForceFailure run on.
inline constexpr Releases kSkippedEnds = {kFirst4, 40200};
// `_post` runs when the node goes on running, or is skipped, as well.
inline constexpr Releases kPostIsAlways = {kFirst4, 40502};
// SequenceStar goes on where it was halted, as SequenceWithMemory does.
inline constexpr Releases kStarOutlivesHalt = {30601, 30802};
// `delay_msec` is not read: no delay.
inline constexpr Releases kDelayIsNone = {40803, 40900};
// The child of a Delay is ticked once for each delay.
inline constexpr Releases kDelaysEachTick = {kFirst, 30801};
// A Delay that was halted while it waited fails once.
inline constexpr Releases kDelayTellsHalt = {kFirst, 30600};
// A Precondition asks in each tick, and leaves a child running.
inline constexpr Releases kPreconditionAsksAlways = {kFirst4, 40700};
// Repeat and RetryUntilSuccessful of no round answer SKIPPED.
inline constexpr Releases kNoRoundIsSkipped = {40100, 40700};
// SkipUnlessUpdated and WaitValueUpdate, when they are halted, let their child
// run on.
inline constexpr Releases kUpdatedKeepsChild = {40600, 40900};
// A queue that is written in the tree is empty once it has been gone through.
inline constexpr Releases kQueueIsUsedUp = {kFirst4, 40700};
// Switch compares its cases as texts; then also the numbers they begin with.
inline constexpr Releases kSwitchComparesTexts = {kFirst, 40501};
inline constexpr Releases kSwitchReadsBeginnings = {40501, 41000};
// Parallel has one `threshold`: of three children with 2 it succeeds with the
// second success, and fails with the second failure.
inline constexpr Releases kHasOneThreshold = {kFirst, 30502};
// The port of Parallel that says how many have to succeed.
constexpr std::string_view success_port(int release) {
  return kHasOneThreshold.has(release) ? "threshold"
         : release < kFirst4           ? "success_threshold"
                                       : "success_count";
}
// Repeat and RetryUntilSuccessful do not reset their child between two rounds.
inline constexpr Releases kRoundsKeepChild = {kFirst, 30503};
// Where a negative threshold of Parallel would come to less than none of the
// children, it throws.
inline constexpr Releases kThresholdsWrap = {30800, kFirst4};
// Thresholds of Parallel are not negative.
inline constexpr Releases kThresholdsAreUnsigned = {kFirst, 30800};
// BlackboardCheckDouble compares exactly.
inline constexpr Releases kChecksExactly = {kFirst, 30700};

// --- Scripts: include/behaviortree_cpp/scripting -----------------------------

// Operators of different groups do not stand in one expression without
// brackets: `+ - * / ..` and a negative sign, `! ~ & | ^`, comparisons.
inline constexpr Releases kComparisonsStandAlone = {40600, 40700};
inline constexpr Releases kBitsStandAlone = {kFirst4, 40900};
inline constexpr Releases kJoinStandsAlone = {40700, 40900};
// `10-3-2` is 9.
inline constexpr Releases kArithmeticIsRightAssociative = {40700, 40900};
// The grammar before 4.9: `||` and `&&` bind alike; "text" is one; statements
// are separated by `;` and none stands at the end; `true` is an integer; +5 is
// a number; neither `:=` nor `? :` stands in itself.
inline constexpr Releases kHasOldGrammar = {kFirst4, 40900};
// `@x` is no name and `..` no operator.
inline constexpr Releases kHasNoRootEntries = {kFirst4, 40600};
// A newline outside of brackets ends the script.
inline constexpr Releases kNewlineEndsScript = {kFirst4, 40308};
// A text and a number are not compared.
inline constexpr Releases kComparesNoMixture = {kFirst4, 40400};
// Beside a text, a number is compared with itself.
inline constexpr Releases kComparesWithItself = {40400, 40502};
// A script that gives a text to an entry of numbers throws.
inline constexpr Releases kNumbersRefuseTexts = {kFirst4, 40600};
// Before a `?` a text is true; the empty one throws.
inline constexpr Releases kTextsAreTrue = {kFirst4, 40500};
// An integer of more than 53 bits is a number where a double is the same, and
// `~` takes numbers of any size.
inline constexpr Releases kConvertsUnchecked = {kFirst4, 40700};

// --- Loading: src/xml_parsing.cpp, blackboard.cpp ----------------------------

inline constexpr Releases kForbidsNames = {40804, kNoRelease};
inline constexpr Releases kForbidsSamePaths = {40804, kNoRelease};
inline constexpr Releases kLooksAtReactive = {40700, kNoRelease};
inline constexpr Releases kForbidsChildrenOfLeaves = {40703, kNoRelease};
// Trees without an ID, and trees called like a node type.
inline constexpr Releases kForbidsNamesOfTypes = {40602, kNoRelease};
// <MyTree/> for <SubTree ID="MyTree"/>.
inline constexpr Releases kForbidsTreeTags = {30800, kNoRelease};
inline constexpr Releases kTakesDescriptionForPort = {kFirst, 30800};
// RetryUntilSuccessful is called RetryUntilSuccesful.
inline constexpr Releases kMisspellsRetry = {kFirst, 30600};
// An entry of texts is given no other type by a port.
inline constexpr Releases kTextsAreNoOtherType = {kFirst, 30805};
// Literals of ports are read when the node is ticked.
inline constexpr Releases kReadsLiteralsLate = {kFirst, 40502};
// What is passed to a SubTree without braces is a text.
inline constexpr Releases kPassesTexts = {kFirst, 40901};
// LoopString reads no queue that is written in the tree: it throws when made.
inline constexpr Releases kReadsNoTexts = {kFirst4, 40305};
// `_autoremap` beside a `name` crashes.
inline constexpr Releases kAutoremapsNoNamed = {kFirst4, 40300};
// WhileDoElse has three children.
inline constexpr Releases kNeedsElse = {kFirst4, 40305};
// Which names `_autoremap` lets through: those that begin with `_` as well.
inline constexpr Releases kRemapsPrivateNames = {40300, 40403};
// "{=}" is an entry called `=`, of a port and of a SubTree.
inline constexpr Releases kEqualSignIsKey = {kFirst, 40502};
inline constexpr Releases kEqualSignIsKeyOfTree = {kFirst, 40600};
// "${x}" is "{x}".
inline constexpr Releases kHasDollarKeys = {kFirst, 40304};
// An output port "x" is the entry x.
inline constexpr Releases kOutputsNameEntries = {kFirst, 40402};
// The models of SubTrees say what they need.
inline constexpr Releases kHasModelsOfTrees = {40400, kNoRelease};
// `_autoremap` is about the names in the ports of the tree, and not in scripts.
constexpr bool autoremaps_ports(int release) {
  return Releases{kFirst, 30804}.has(release) ||
         Releases{kFirst4, 40300}.has(release);
}
// Each file, included ones as well, names one of its own trees as the main
// tree, or has one only.
inline constexpr Releases kEachFileHasMainTree = {kFirst, 30700};
// An entry that a text has made is one of texts for good.
inline constexpr Releases kTextsStayTexts = {kFirst4, 40300};
// SetBlackboard reads what it copies as a text, and throws where it finds none;
// then it copies an entry whatever the other one holds, or none; then it fails
// where there is nothing to copy.
inline constexpr Releases kCopiesSomething = {40700, kNoRelease};
constexpr bool copies_text(int release) {
  return Releases{kFirst, 30807}.has(release) ||
         Releases{kFirst4, 40402}.has(release);
}
constexpr bool copies_anything(int release) {
  return !copies_text(release) && !kCopiesSomething.has(release);
}

}  // namespace btcheck::releases
