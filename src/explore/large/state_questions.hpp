// SPDX-License-Identifier: MIT
//
// Questions about single states, asked by a parallel search: is there a
// reachable one such that …? All are asked at once; the search ends when all
// are answered. Of the states of the first depth with an answer the one with
// the least vector is taken, so that threads make no difference.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "explore/large/parallel_breadth_first.hpp"

namespace btcheck {

struct FoundState {
  Word pair = 0;
  std::size_t depth = 0;
  StateVector words;
};

// `Holds`: callable as holds(question, StateView, bool is_dead), by several
// threads at once.
template <PairSystem System, class Holds>
class StateQuestions : public PairVisitor {
 public:
  // The system must outlive it.
  StateQuestions(const System& system, std::size_t questions, Holds holds)
      : system_(system),
        holds_(std::move(holds)),
        answers_(questions),
        best_(questions) {}

  class Part {
   public:
    explicit Part(StateQuestions& all)
        : all_(all),
          words_(all.system_.word_count()),
          found_(all.answers_.size()) {}

    void expanded(Word pair, std::size_t steps,
                  typename System::Worker& /*worker*/) {
      all_.system_.load(pair, words_.data());
      for (std::size_t q = 0; q < found_.size(); ++q) {
        if (all_.answers_[q]) continue;
        if (found_[q] && found_[q]->words <= words_) continue;
        if (!all_.holds_(q, StateView(words_), steps == 0)) continue;
        found_[q] = FoundState{pair, all_.depth_, words_};
      }
    }
    void rest() { all_.gather(found_); }

   private:
    StateQuestions& all_;
    StateVector words_;
    std::vector<std::optional<FoundState>> found_;
  };

  Part part() { return Part(*this); }
  GoOn depth_done() {
    for (std::size_t q = 0; q < answers_.size(); ++q) {
      if (!answers_[q]) answers_[q] = std::move(best_[q]);
    }
    ++depth_;
    const bool has_all =
        std::all_of(answers_.begin(), answers_.end(),
                    [](const auto& answer) { return answer.has_value(); });
    return has_all ? GoOn::No : GoOn::Yes;
  }

  // By question; nothing where no state was found.
  const std::vector<std::optional<FoundState>>& answers() const {
    return answers_;
  }

 private:
  // The least of what the threads have found in a round.
  void gather(std::vector<std::optional<FoundState>>& found) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (std::size_t q = 0; q < found.size(); ++q) {
      if (!found[q]) continue;
      if (!best_[q] || found[q]->words < best_[q]->words) best_[q] = found[q];
      found[q].reset();
    }
  }

  const System& system_;
  Holds holds_;
  std::vector<std::optional<FoundState>> answers_;
  std::size_t depth_ = 0;
  std::mutex mutex_;
  std::vector<std::optional<FoundState>> best_;  // of the present depth
};

}  // namespace btcheck
