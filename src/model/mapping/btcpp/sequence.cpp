// SPDX-License-Identifier: MIT
//
// Sequence, Fallback, their Async forms, SequenceWithMemory and
// PersistentSequence (BehaviorTree.CPP 4.10, src/controls/sequence_node.cpp,
// fallback_node.cpp, sequence_with_memory_node.cpp; 3.8.8, the same and
// sequence_star_node.cpp; Nav2's persistent_sequence.cpp). The local `next` is
// the child whose turn it is, `skipped` the number that answered skipped. That
// is counted only where it can reach the number of children. Some may count
// twice, since only a node that is idle or has been halted starts from 0.
#include "model/mapping/btcpp/builder.hpp"

namespace btcheck::mapping {
namespace {

struct Kind {
  bool is_fallback = false;
  // After a child that began and ended in the same tick it yields to others.
  bool yields = false;
  bool keeps_place = false;  // on the answer that ends it early
  bool keeps_place_when_halted = false;
  bool ends_skipped = true;
  // Its place is a blackboard entry that anyone may write between two ticks.
  bool is_told = false;
};

Kind kind_of(const Node& node, const EngineBuilder& build) {
  const bool is_async_fallback = node.type == NodeType::AsyncFallback;
  const bool is_async =
      is_async_fallback || node.type == NodeType::AsyncSequence;
  const bool is_persistent = node.type == NodeType::PersistentSequence;
  const bool has_memory = node.type == NodeType::SequenceWithMemory;
  const bool is_3 = is_release_3(build.profile());
  const bool outlives_halt =
      has_memory && (is_3 ? build.is_in(releases::kStarOutlivesHalt)
                          : !build.is_in(releases::kMemoryEndsWithHalt));
  const bool all_yield = build.is_in(releases::kSequencesYield);
  return {.is_fallback = is_async_fallback || node.type == NodeType::Fallback,
          .yields = is_async || (has_memory && !is_3) ||
                    (all_yield && !is_persistent),
          .keeps_place = has_memory,
          .keeps_place_when_halted = is_persistent || outlives_halt,
          .ends_skipped = !is_persistent,
          .is_told = is_persistent};
}

class SequenceDrawing {
 public:
  explicit SequenceDrawing(NodeBuilder& draw)
      : build_(draw, Begins::Running),
        kind_(kind_of(draw.node(), build_)),
        count_(static_cast<int>(draw.child_count())) {
    if (count_ > 1 && !kind_.is_told) next_ = draw.local("next", 1, count_, 1);
    const bool may_be_all = build_.every_child_may_skip() ||
                            (build_.some_child_may_skip() && build_.may_stay());
    if (!kind_.ends_skipped || !may_be_all) return;
    if (build_.is_in(releases::kNotesAllSkipped)) {
      all_skipped_ = draw.local("all_skipped", 0, 1, 1);
    } else {
      skipped_ = draw.local("skipped", 0, count_ + 1, 0);
    }
  }

  void draw() {
    const bool notes = skipped_ || all_skipped_;
    const LocationId begins = notes ? build_.at("begin") : build_.body();
    if (notes) {
      build_.start_anew(begins, joined(set_if_there(skipped_, 0),
                                       set_if_there(all_skipped_, 1)));
    }
    for (int i = 1; i <= count_; ++i) {
      draw_child(i);
      if (kind_.is_told) {
        build_.draw().choice(begins, calling(i, ""), {}, {},
                             "its index is " + std::to_string(i - 1));
      } else {
        enter(begins, i, next_ ? equals(*next_, i) : Expression{});
      }
    }
    if (kind_.is_told) {
      build_.draw().choice(begins, build_.at("end"), {}, {},
                           "its index is that of no child");
    }
    draw_end();
    build_.on_halt(kind_.keeps_place_when_halted ? std::vector<Assignment>{}
                                                 : fresh());
  }

 private:
  static std::size_t child(int i) { return static_cast<std::size_t>(i - 1); }
  std::vector<Assignment> go(int i) const { return set_if_there(next_, i); }
  std::vector<Assignment> fresh() const {
    return joined(go(1), set_if_there(skipped_, 0));
  }
  bool tells_new(int i) const { return kind_.yields && i < count_; }

  // Executes child i. A form that yields distinguishes a child that was idle.
  void enter(LocationId from, int i, const Expression& guard,
             std::vector<Assignment> updates = {}) {
    NodeBuilder& draw = build_.draw();
    if (!tells_new(i)) {
      draw.edge(from, calling(i, ""), guard, std::move(updates));
      return;
    }
    const Expression idle = build_.is_idle(child(i));
    draw.edge(from, calling(i, "_new"), both(guard, idle), updates);
    draw.edge(from, calling(i, ""), both(guard, negated(idle)),
              std::move(updates));
  }

  LocationId calling(int i, std::string_view occasion) {
    return build_.draw().calling(child(i), occasion);
  }

  void draw_child(int i) {
    draw_answers(i, "", false);
    if (tells_new(i)) draw_answers(i, "_new", true);
    if (i > 1) enter(build_.turn(child(i)), i, {});
  }

  void draw_answers(int i, std::string_view occasion, bool was_new) {
    const LocationId stops =
        kind_.is_fallback ? build_.success() : build_.failure();
    const std::vector<Assignment> moves =
        i == count_ ? std::vector<Assignment>{} : go(i + 1);
    const auto after = [&] { return build_.turn(child(i) + 1); };
    const auto not_skipped = set_if_there(all_skipped_, 0);
    const Reaction goes_on{was_new ? build_.yielding() : after(),
                           joined(moves, not_skipped)};
    const Reaction ends{ending(i, stops), not_skipped};
    Reactions reactions{.success = {kind_.is_fallback ? ends : goes_on},
                        .failure = {kind_.is_fallback ? goes_on : ends},
                        .running = {{build_.running(), not_skipped}},
                        .skipped = {{after(), moves}}};
    if (skipped_) {
      const Expression is_all = at_least(*skipped_, count_ + 1);
      reactions.skipped = {
          {after(), joined(moves, {count(*skipped_)}), negated(is_all)},
          {after(), moves, is_all}};
    }
    build_.tick(child(i), reactions, occasion);
  }

  // The answer that ends it early.
  LocationId ending(int i, LocationId answer) {
    if (!kind_.keeps_place) return build_.resetting("stop", answer, go(1));
    return build_.once("stop_" + std::to_string(i), [&](LocationId location) {
      std::vector<std::size_t> rest;
      for (int k = i; k <= count_; ++k) rest.push_back(child(k));
      build_.reset(location, answer, rest);
    });
  }

  void draw_end() {
    const LocationId answer =
        kind_.is_fallback ? build_.failure() : build_.success();
    const LocationId end = build_.at("end");
    if (all_skipped_) {
      return build_.end(end, answer, fresh(), equals(*all_skipped_, 0),
                        equals(*all_skipped_, 1));
    }
    if (!skipped_) return build_.reset_all(end, answer, fresh());
    build_.end(end, answer, fresh(), differs(*skipped_, count_),
               equals(*skipped_, count_));
  }

  EngineBuilder build_;
  Kind kind_;
  int count_;
  std::optional<VariableId> next_;
  std::optional<VariableId> skipped_;      // how many
  std::optional<VariableId> all_skipped_;  // in older releases: whether all
};

void draw_engine_sequence(NodeBuilder& draw) { SequenceDrawing(draw).draw(); }

// Every tick starts at the first child. Whichever answers running, all others
// are halted and left idle, those on its left as well; one that is skipped is
// reset (src/controls/reactive_sequence.cpp, reactive_fallback.cpp). Some
// releases reset those on its right only, and some throw where another child
// has run before.
void draw_engine_reactive(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const bool is_fallback = draw.node().type == NodeType::ReactiveFallback;
  const bool resets_right = releases::reactive_resets_right(build.release());
  const bool throws =
      build.is_in(is_fallback ? releases::kReactiveFallbackThrows
                              : releases::kReactiveSequenceThrows);
  const std::size_t count = draw.child_count();
  const LocationId passed = is_fallback ? build.failure() : build.success();
  const LocationId decided = is_fallback ? build.success() : build.failure();
  // Whether no child has answered anything but skipped in this tick.
  std::optional<VariableId> all_skipped;
  if (build.every_child_may_skip()) {
    all_skipped = draw.local("all_skipped", 0, 1, 1);
  }
  // Whether all have failed, where that makes a difference.
  std::optional<VariableId> all_failed;
  if (is_fallback && build.is_in(releases::kReactiveFallbackKeeps) &&
      build.some_child_may_skip()) {
    all_failed = draw.local("all_failed", 0, 1, 1);
  }
  const auto noted = [&](int value) {
    return set_if_there(all_skipped, value);
  };
  const auto begins = joined(noted(1), set_if_there(all_failed, 1));
  const LocationId decides = build.resetting("decided", decided);
  // The child that has run since the node was idle, 0 for none.
  std::optional<VariableId> ran;
  if (throws && count > 1)
    ran = draw.local("ran", 0, static_cast<int>(count), 0);
  if (ran && !build.is_in(releases::kReactiveNotesForLife)) {
    const LocationId begin = build.at("begin");
    build.start_anew(begin, {set(*ran, 0)});
    draw.edge(begin, build.turn(0), {}, begins);
  } else {
    draw.edge(build.body(), build.turn(0), {}, begins);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(i + 1);
    const int own = static_cast<int>(i) + 1;
    std::vector<std::size_t> others = build.all_children();
    others.erase(resets_right ? others.begin() : others.begin() + own - 1,
                 others.begin() + own);
    const LocationId alone = build.at("alone_" + number);
    if (ran) {
      const LocationId look = build.at("runs_" + number);
      const Expression is_own = either(equals(*ran, 0), equals(*ran, own));
      build.reset(alone, look, others);
      draw.edge(look, build.running(), is_own, {set(*ran, own)});
      build.throws(look, negated(is_own), "another child has run before");
    } else {
      build.reset(alone, build.running(), others);
    }
    const Reaction goes_on{build.turn(i + 1), noted(0)};
    const Reaction ends{decides};
    Reactions reactions{.success = {is_fallback ? ends : goes_on},
                        .failure = {is_fallback ? goes_on : ends},
                        .running = {{alone}}};
    if (build.may_skip(i)) {
      const LocationId again = build.at("skipped_" + number);
      build.reset(again, build.turn(i + 1), {i});
      reactions.skipped = {{again, set_if_there(all_failed, 0)}};
    }
    draw.edge(build.turn(i), build.tick(i, reactions));
  }
  const LocationId end = build.at("end");
  if (all_failed) {
    const LocationId kept = build.at("some_skipped");
    const Expression none =
        all_skipped ? equals(*all_skipped, 0) : Expression{};
    draw.edge(end, kept, equals(*all_failed, 0));
    draw.edge(kept, passed, none);
    if (all_skipped) draw.edge(kept, build.skipped(), equals(*all_skipped, 1));
    build.reset(end, passed, build.all_children(), {}, equals(*all_failed, 1));
  } else if (all_skipped) {
    build.end(end, passed, noted(1), equals(*all_skipped, 0),
              equals(*all_skipped, 1));
  } else {
    build.reset_all(end, passed);
  }
  build.on_halt();
}

constexpr Drawing kEngineSequenceRows[] = {
    {NodeType::Sequence, draw_engine_sequence},
    {NodeType::Fallback, draw_engine_sequence},
    {NodeType::SequenceWithMemory, draw_engine_sequence},
    {NodeType::AsyncSequence, draw_engine_sequence},
    {NodeType::AsyncFallback, draw_engine_sequence},
    {NodeType::PersistentSequence, draw_engine_sequence},
    {NodeType::ReactiveSequence, draw_engine_reactive},
    {NodeType::ReactiveFallback, draw_engine_reactive}};

}  // namespace

constinit const Family kEngineSequenceDrawings = kEngineSequenceRows;

}  // namespace btcheck::mapping
