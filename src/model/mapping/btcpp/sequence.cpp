// SPDX-License-Identifier: MIT
//
// Sequence, Fallback, their Async forms, SequenceWithMemory and
// PersistentSequence (BehaviorTree.CPP 4.10, src/controls/sequence_node.cpp,
// fallback_node.cpp, sequence_with_memory_node.cpp; 3.8.8, the same and
// sequence_star_node.cpp; Nav2's persistent_sequence.cpp). The local `next` is
// the child whose turn it is, `skipped` how many answered skipped. That is
// asked only where it can come to be all of them, also by counting some twice:
// the count begins anew only in a node that is idle, or has been halted.
#include "model/mapping/btcpp/builder.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::mapping {
namespace {

struct Kind {
  bool is_fallback = false;
  // A child that ended in the tick in which it began lets others be heard.
  bool yields = false;
  bool keeps_place = false;  // on the answer that ends it early
  bool keeps_place_when_halted = false;
  bool ends_skipped = true;
  // Its place is an entry that anybody may write between two ticks.
  bool is_told = false;
};

Kind kind_of(const Node& node, Profile profile) {
  switch (node.type) {
    case NodeType::Fallback:
      return {.is_fallback = true};
    case NodeType::AsyncFallback:
      return {.is_fallback = true, .yields = true};
    case NodeType::AsyncSequence:
      return {.yields = true};
    case NodeType::SequenceWithMemory:
      return {.yields = !is_release_3(profile),
              .keeps_place = true,
              .keeps_place_when_halted = !is_release_3(profile)};
    case NodeType::PersistentSequence:
      return {.keeps_place_when_halted = true,
              .ends_skipped = false,
              .is_told = true};
    default:
      return {};
  }
}

class SequenceDrawing {
 public:
  explicit SequenceDrawing(NodeBuilder& draw)
      : build_(draw, Begins::Running),
        kind_(kind_of(draw.node(), build_.profile())),
        count_(static_cast<int>(draw.child_count())) {
    if (count_ > 1 && !kind_.is_told) next_ = draw.local("next", 1, count_, 1);
    const bool may_be_all = build_.every_child_may_skip() ||
                            (build_.some_child_may_skip() && build_.may_stay());
    if (kind_.ends_skipped && may_be_all) {
      skipped_ = draw.local("skipped", 0, count_ + 1, 0);
    }
  }

  void draw() {
    const LocationId begins = skipped_ ? build_.at("begin") : build_.body();
    if (skipped_) {
      build_.draw().edge(build_.body(), begins, build_.was_idle(),
                         {set(*skipped_, 0)});
      build_.draw().edge(build_.body(), begins, negated(build_.was_idle()));
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
    std::vector<Assignment> forgets;
    if (!kind_.keeps_place_when_halted) {
      forgets = first();
      if (skipped_) forgets.push_back(set(*skipped_, 0));
    }
    build_.on_halt(forgets);
  }

 private:
  static std::size_t child(int i) { return static_cast<std::size_t>(i - 1); }
  std::vector<Assignment> go(int i) const {
    return next_ ? std::vector<Assignment>{set(*next_, i)}
                 : std::vector<Assignment>{};
  }
  std::vector<Assignment> first() const { return go(1); }
  bool tells_new(int i) const { return kind_.yields && i < count_; }

  // Executes child i; a form that yields tells a child that was idle from one
  // that was not.
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

  // Where the next child is executed, or the end.
  LocationId after(int i) {
    if (i == count_) return build_.at("end");
    return build_.at("turn_" + std::to_string(i + 1));
  }

  void draw_child(int i) {
    draw_answers(i, "", false);
    if (tells_new(i)) draw_answers(i, "_new", true);
    if (i > 1) enter(build_.at("turn_" + std::to_string(i)), i, {});
  }

  void draw_answers(int i, std::string_view occasion, bool was_new) {
    const bool is_last = i == count_;
    const LocationId stops =
        kind_.is_fallback ? build_.success() : build_.failure();
    std::vector<Assignment> moves =
        is_last ? std::vector<Assignment>{} : go(i + 1);
    const Reaction goes_on = was_new ? Reaction{build_.yielding(), moves, {}}
                                     : Reaction{after(i), moves, {}};
    const Reaction ends{ending(i, stops), {}, {}};
    Reactions reactions;
    reactions.success = {kind_.is_fallback ? ends : goes_on};
    reactions.failure = {kind_.is_fallback ? goes_on : ends};
    reactions.running = {{build_.running(), {}, {}}};
    if (skipped_) {
      std::vector<Assignment> counted = moves;
      counted.push_back(count(*skipped_));
      reactions.skipped = {
          {after(i), counted, negated(at_least(*skipped_, count_ + 1))},
          {after(i), moves, at_least(*skipped_, count_ + 1)}};
    } else {
      reactions.skipped = {{after(i), moves, {}}};
    }
    build_.tick(child(i), reactions, occasion);
  }

  // The answer that ends it early.
  LocationId ending(int i, LocationId answer) {
    if (!kind_.keeps_place) return build_.resetting("stop", answer, first());
    const std::string name = "stop_" + std::to_string(i);
    const bool is_new = !build_.draw().knows(name);
    const LocationId location = build_.at(name);
    if (is_new) {
      std::vector<std::size_t> rest;
      for (int k = i; k <= count_; ++k) rest.push_back(child(k));
      build_.reset(location, answer, rest);
    }
    return location;
  }

  void draw_end() {
    const LocationId answer =
        kind_.is_fallback ? build_.failure() : build_.success();
    const LocationId end = build_.at("end");
    std::vector<Assignment> updates = first();
    if (!skipped_) {
      build_.reset_all(end, answer, updates);
      return;
    }
    updates.push_back(set(*skipped_, 0));
    build_.reset(end, answer, build_.all_children(), updates,
                 differs(*skipped_, count_));
    build_.reset(end, build_.skipped(), build_.all_children(), updates,
                 equals(*skipped_, count_));
  }

  EngineBuilder build_;
  Kind kind_;
  int count_;
  std::optional<VariableId> next_;
  std::optional<VariableId> skipped_;
};

}  // namespace

void draw_engine_sequence(NodeBuilder& draw) { SequenceDrawing(draw).draw(); }

// Every tick starts at the first child. Whichever answers running, all others
// are halted and left idle, those on its left as well; one that is skipped is
// reset (src/controls/reactive_sequence.cpp, reactive_fallback.cpp; release 3
// from 3.8.7 on).
void draw_engine_reactive(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const bool is_fallback = draw.node().type == NodeType::ReactiveFallback;
  const std::size_t count = draw.child_count();
  const LocationId passed = is_fallback ? build.failure() : build.success();
  const LocationId decided = is_fallback ? build.success() : build.failure();
  // Whether no child has answered anything but skipped in this tick.
  std::optional<VariableId> all_skipped;
  if (build.every_child_may_skip()) {
    all_skipped = draw.local("all_skipped", 0, 1, 1);
  }
  const auto noted = [&](int value) {
    return all_skipped ? std::vector<Assignment>{set(*all_skipped, value)}
                       : std::vector<Assignment>{};
  };
  const LocationId decides = build.resetting("decided", decided);
  const auto turn = [&](std::size_t i) {
    return i == count ? build.at("end")
                      : build.at("turn_" + std::to_string(i + 1));
  };
  draw.edge(build.body(), turn(0), {}, noted(1));
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(i + 1);
    std::vector<std::size_t> others = build.all_children();
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const LocationId alone = build.at("alone_" + number);
    build.reset(alone, build.running(), others);
    Reactions reactions;
    reactions.running = {{alone, {}, {}}};
    const Reaction goes_on{turn(i + 1), noted(0), {}};
    const Reaction ends{decides, {}, {}};
    reactions.success = {is_fallback ? ends : goes_on};
    reactions.failure = {is_fallback ? goes_on : ends};
    if (build.may_skip(i)) {
      const LocationId again = build.at("skipped_" + number);
      build.reset(again, turn(i + 1), {i});
      reactions.skipped = {{again, {}, {}}};
    }
    draw.edge(turn(i), build.tick(i, reactions));
  }
  const LocationId end = build.at("end");
  if (all_skipped) {
    build.reset(end, passed, build.all_children(), noted(1),
                equals(*all_skipped, 0));
    build.reset(end, build.skipped(), build.all_children(), noted(1),
                equals(*all_skipped, 1));
  } else {
    build.reset_all(end, passed);
  }
  build.on_halt();
}

}  // namespace btcheck::mapping
