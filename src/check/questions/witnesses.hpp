// SPDX-License-Identifier: MIT
//
// Searches as witnesses: what they have seen answers questions and decides
// suspicions.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "check/findings/suspicion.hpp"
#include "check/questions/default_questions.hpp"
#include "check/questions/defaults.hpp"
#include "check/questions/reporter.hpp"

namespace btcheck {

// What a search has seen, and who tells it.
struct Seen {
  const DefaultQuestions& questions;
  Reporter& reporter;
};

// By NodeId: what a node is known never to do.
using NeverDone = std::vector<NodeQuestions>;

// What is known before any search.
struct KnownAnswers {
  NeverDone never;
  // By NodeId: runs that end with what the node is asked for; empty: none.
  std::vector<std::array<std::optional<KeptRun>, kNodeQuestionCount>> nodes;
  // By number: runs to the sighting, and on until what has to follow; empty:
  // none.
  struct Sighted {
    KeptRun run;
    std::optional<KeptRun> followed = {};
  };
  std::vector<std::optional<Sighted>> sighted;
};

// What all have seen, the one whose runs are shortest first.
class Evidence {
 public:
  Evidence() = default;
  explicit Evidence(KnownAnswers known) : known_(std::move(known)) {}

  void add(Seen seen) { seen_.push_back(seen); }

  // `first` gives the state or step that the questions have noted. Of the tree:
  template <class First>
  Possibility possibility(First first) const {
    return told(first,
                [](const QuestionsAsked& asked) { return asked.of_tree; });
  }
  // Of a node:
  Possibility possibility(NodeId node, std::size_t question) const;

  const std::vector<Seen>& seen() const { return seen_; }
  bool has_sighting(std::size_t i) const;
  // A run up to the sighting, and on until what has to follow.
  std::optional<KeptRun> run_to(
      std::size_t sighting, const std::optional<Consequence>& then = {}) const;

 private:
  template <class First, class IsAsked>
  Possibility told(First first, IsAsked is_asked) const {
    Possibility answer;
    for (const Seen& each : seen_) {
      if (!is_asked(each.questions.asked)) continue;
      answer = each.reporter.possibility(std::invoke(first, each.questions));
      if (answer.verdict != Verdict::Undecided) break;
    }
    return answer;
  }

  KnownAnswers known_;
  std::vector<Seen> seen_;
};

// Decides suspicions one after the other.
class Judge {
 public:
  Judge(const Evidence& evidence, bool is_complete)
      : evidence_(evidence), is_complete_(is_complete) {}

  // Whether it is so; then with the run that shows it.
  bool confirm(Suspicion& suspicion);

 private:
  const Evidence& evidence_;
  bool is_complete_;
  std::size_t next_ = 0;
};

}  // namespace btcheck
