// SPDX-License-Identifier: MIT
//
// Runs of words on disk, and the search that keeps its states in them, with so
// little room that every one of their ways is taken.
#include "explore/large/disk_breadth_first.hpp"

#include <doctest/doctest.h>

#include <random>
#include <set>

#include "explore/halves/split_network.hpp"
#include "explore/large/markings.hpp"
#include "explore/large/state_questions.hpp"
#include "explore/search/reachability.hpp"
#include "tiny_scratch.hpp"
#include "wheels.hpp"

namespace btcheck::disk_breadth_first_test {
namespace {

// Some close together, some far apart, the least and the largest among them.
std::set<Word> some_words(unsigned seed, std::size_t count) {
  std::mt19937_64 random(seed);
  std::set<Word> words{0, UINT64_MAX};
  while (words.size() < count) {
    const Word word = random() >> (random() % 60);
    words.insert(word);
    words.insert(word + 1);
  }
  return words;
}

SortedRun run_of(const std::set<Word>& words, const Scratch& scratch) {
  RunWriter writer(scratch);
  for (const Word word : words) writer.add(word);
  return writer.finish();
}

template <class Cursor>
std::vector<Word> all_of(Cursor cursor) {
  std::vector<Word> found;
  for (; !cursor.is_at_end(); cursor.advance()) found.push_back(cursor.word());
  return found;
}

const auto kGoOn = [] { return true; };

TEST_CASE("a run gives back what was written, from memory and from disk") {
  for (const std::size_t count : {2u, 15u, 16u, 17u, 32u, 33u, 1000u}) {
    CAPTURE(count);
    const std::set<Word> words = some_words(7, count);
    const SortedRun on_disk = run_of(words, tiny_scratch());
    const SortedRun in_memory = run_of(words, Scratch{});
    CHECK((on_disk.bytes_on_disk() > 0) == (words.size() > 16));
    CHECK(in_memory.bytes_on_disk() == 0);
    for (const SortedRun* run : {&on_disk, &in_memory}) {
      CHECK(run->size() == words.size());
      CHECK(all_of(RunCursor(*run)) ==
            std::vector<Word>(words.begin(), words.end()));
    }
  }
  const SortedRun nothing = run_of({}, tiny_scratch());
  CHECK(RunCursor(nothing).is_at_end());
  CHECK(!RunCursor(nothing).contains(0));
}

TEST_CASE("a run on disk knows what it contains") {
  const std::set<Word> words = some_words(1, 1000);
  const std::set<Word> others = some_words(2, 3000);
  const SortedRun on_disk = run_of(words, tiny_scratch());
  const SortedRun in_memory = run_of(words, Scratch{});
  // Few questions pass over blocks, many walk through them.
  for (const std::size_t every : {1u, 7u, 500u}) {
    RunCursor disk(on_disk);
    RunCursor memory(in_memory);
    std::set<Word> asked(words);
    asked.insert(others.begin(), others.end());
    std::size_t number = 0;
    for (const Word word : asked) {
      if (++number % every != 0) continue;
      REQUIRE(disk.contains(word) == (words.count(word) == 1));
      REQUIRE(memory.contains(word) == (words.count(word) == 1));
    }
  }
}

TEST_CASE("runs that share a file do not disturb each other") {
  const Scratch scratch = tiny_scratch();
  const auto file = std::make_shared<ScratchFile>(scratch.folder);
  std::vector<SortedRun> runs;
  for (unsigned i = 0; i < 5; ++i) {
    RunWriter writer(scratch, file);
    for (const Word word : some_words(i, 3 + 40 * i)) writer.add(word);
    runs.push_back(writer.finish());
  }
  for (unsigned i = 0; i < 5; ++i) {
    const std::set<Word> words = some_words(i, 3 + 40 * i);
    CHECK(all_of(RunCursor(runs[i])) ==
          std::vector<Word>(words.begin(), words.end()));
    CHECK(runs[i].bytes_on_disk() > 0);
  }
}

TEST_CASE("what is gathered comes back in order, each once") {
  const Scratch scratch = tiny_scratch();
  std::mt19937_64 random(3);
  for (const std::size_t count : {10u, 200u, 20'000u}) {
    Gathering gathering(scratch, 64);
    std::set<Word> expected;
    std::vector<Word> taken;
    for (std::size_t i = 0; i < count; ++i) {
      taken.push_back(random() % (count * 2));
      expected.insert(taken.back());
      if (taken.size() == 10) gathering.take(taken);
    }
    gathering.take(taken);
    CHECK(taken.empty());
    CHECK((gathering.bytes_on_disk() > 0) == (count > 10));
    CHECK(all_of(gathering.merged()) ==
          std::vector<Word>(expected.begin(), expected.end()));
  }
}

TEST_CASE("a set of runs contains what its runs do, however they are merged") {
  const Scratch scratch = tiny_scratch();
  RunSet set(scratch);
  std::set<Word> all;
  for (unsigned i = 0; i < 30; ++i) {
    std::set<Word> fresh;
    for (const Word word : some_words(i, i * i % 37 + 2)) {
      if (all.insert(word).second) fresh.insert(word);
    }
    set.add(std::make_shared<const SortedRun>(run_of(fresh, scratch)), kGoOn);
  }
  std::set<Word> asked = some_words(99, 500);
  asked.insert(all.begin(), all.end());
  RunSet::Cursor cursor(set);
  for (const Word word : asked) {
    REQUIRE(cursor.contains(word) == (all.count(word) == 1));
  }
}

TEST_CASE("a search on disk counts what one in memory counts") {
  const Network network = wheels(5, 6);
  const CompiledNetwork system(network);
  const Limits limits;
  ReachabilityVisitor nothing;
  const ReachabilityResult expected = BreadthFirst(system, limits).run(nothing);
  for (const unsigned threads : {1u, 3u}) {
    for (const KeepDepths keep : {KeepDepths::No, KeepDepths::Yes}) {
      const Scratch scratch = tiny_scratch();
      SplitNetwork split(system);
      DiskMarkings<SplitNetwork> markings(split, scratch, 64);
      DiskBreadthFirst<SplitNetwork> search(split, limits, threads, scratch,
                                            keep);
      const ParallelResult result = search.run(markings);
      const ReachabilityResult& found = result.reachability;
      CHECK(found.is_complete);
      CHECK(found.progress.states == expected.progress.states);
      CHECK(found.progress.expanded == expected.progress.expanded);
      CHECK(found.progress.transitions == expected.progress.transitions);
      CHECK(found.progress.depth == expected.progress.depth);
      CHECK(result.peak_bytes_on_disk > 1000);
      CHECK(markings.dead() == 0);
      CHECK(markings.count(search.visited()) == expected.progress.states);
    }
  }
}

TEST_CASE("the disk's faults and the limits end a search on disk") {
  const Network network = wheels(5, 6);
  const CompiledNetwork system(network);
  SplitNetwork split(system);
  PairVisitor nothing;
  Scratch scratch = tiny_scratch();
  {
    const Limits few{500, UINT64_MAX, nullptr};
    const auto stopped =
        DiskBreadthFirst<SplitNetwork>(split, few, 2, scratch).run(nothing);
    CHECK(stopped.reachability.stopped == StopReason::MaxStates);
    CHECK(!stopped.reachability.is_complete);
    CHECK(stopped.reachability.progress.states >= 500);
  }
  scratch.folder += "/there-is-no-such-folder";
  const Limits limits;
  const auto failed =
      DiskBreadthFirst<SplitNetwork>(split, limits, 2, scratch).run(nothing);
  CHECK(failed.reachability.stopped == StopReason::Disk);
  CHECK(!failed.reachability.is_complete);
  CHECK_THROWS_AS(ScratchFile{scratch.folder}, ScratchFault);
}

}  // namespace
}  // namespace btcheck::disk_breadth_first_test
