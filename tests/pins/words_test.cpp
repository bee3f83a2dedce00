// SPDX-License-Identifier: MIT
#include "pins/words.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace btcheck::words_test {
namespace {

using Line = std::vector<std::string>;

TEST_CASE("words stand between blanks, in quotation marks, before comments") {
  const auto read =
      split_words("a.btpins",
                  "drone3.btf --prop 'my rules.ltl'  # the mission\n"
                  "-e \"never 'land'\" --to=x' 'y ''\n");
  REQUIRE(read.value);
  CHECK(*read.value == Line{"drone3.btf", "--prop", "my rules.ltl", "-e",
                            "never 'land'", "--to=x y", ""});
}

TEST_CASE("a quotation without an end is told where it begins") {
  const auto read = split_words("a.btpins", "drone3.btf\n  --prop 'rules\n");
  REQUIRE(!read.value);
  CHECK(read.diagnostics[0].code == "BT1308");
  CHECK(read.diagnostics[0].span.line == 2);
  CHECK(read.diagnostics[0].span.column == 10);
}

TEST_CASE("what is written as a word is read as the same word") {
  for (const std::string word : {"plain", "", "two words", "it's", "'", "\"",
                                 "'\"'", "a#b", "''", "a'b\"c d'e"}) {
    CAPTURE(word);
    const auto read = split_words("a.btpins", as_word(word));
    REQUIRE(read.value);
    CHECK(*read.value == Line{word});
  }
}

TEST_CASE("the module's own words are sorted out") {
  const PinsWords sorted = sorted_pins_words(
      {"--packed", "drone3.btf", "--idle", "--forget", "--guards", "--names"});
  CHECK(sorted.others == Line{"drone3.btf"});
  CHECK(sorted.choices.slots == SlotKind::Packed);
  CHECK(sorted.choices.tells_idle);
  CHECK(sorted.choices.forgets);
  CHECK(sorted.choices.has_guards);
  CHECK(sorted.choices.tells_names);
}

TEST_CASE("of an export those words are kept that say what is exported") {
  CHECK(words_of_export({"export", "drone3.btf", "--to", "ltsmin", "--prop",
                         "my rules.ltl", "-q", "--color=never", "--tick",
                         "none"}) ==
        "drone3.btf --prop 'my rules.ltl' --tick none");
}

}  // namespace
}  // namespace btcheck::words_test
