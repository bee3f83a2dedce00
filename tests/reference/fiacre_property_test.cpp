// SPDX-License-Identifier: MIT
//
// What the compiler of Fiacre accepts as a property, by the reader that is as
// strict; and that it accepts all that is exported.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "check/export/export_model.hpp"
#include "file_text.hpp"
#include "model/export/layout.hpp"
#include "model/lowering.hpp"
#include "reference/effort.hpp"
#include "reference/random_property.hpp"
#include "reference/random_tree.hpp"
#include "reference/read_model.hpp"

namespace btcheck::reference::fiacre_property_test {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kModel = R"(
process walk (&n : int) is
states start_, done
from start_
     n := 1;
     to done

component t is
var
  n : int := 0
par
   walk (&n)
end

t
)";

// What the reader has against a model, "" for nothing.
std::string complaint(const std::string& model) {
  try {
    read_fiacre_space(model, 1);
    return "";
  } catch (const std::exception& error) {
    return error.what();
  }
}

// Whether this may be a property's body; p0, p1, … are conditions as the
// exporter writes them.
bool is_accepted(std::string_view body) {
  const std::string written = with_propositions(body, [](std::size_t number) {
    return number % 2 == 0 ? "(t/1/state done)" : "(t/1/value (n = 1))";
  });
  return complaint(fmt::format("{}property p is {}\nassert p\n", kModel,
                               written)) == "";
}

// --- what is exported ---

struct Exported {
  int models = 0;
  int properties = 0;
  int left_out = 0;
};

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != text.npos;
       at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

// Nothing is exported where tree and properties do not fit together.
void read_back(const InputFile& tree, const InputFile& rules,
               ExportOptions options, Exported& all) {
  options.format = ExportFormat::Fiacre;
  const auto model = export_model(tree, {rules}, options);
  if (!model.value) return;
  CAPTURE(tree.name);
  CAPTURE(rules.name);
  INFO(rules.text);
  CHECK(complaint(*model.value) == "");
  const std::size_t written = count(*model.value, "\nproperty ");
  const auto named = names_of_properties(rules);
  const auto is_warned_of = [](const Diagnostic& finding) {
    return finding.code == "BT0006" || finding.code == "BT0008";
  };
  const auto left_out = std::ranges::count_if(model.diagnostics, is_warned_of);
  REQUIRE(named.value);
  CHECK(written + static_cast<std::size_t>(left_out) == named.value->size());
  ++all.models;
  all.properties += static_cast<int>(written);
  all.left_out += static_cast<int>(left_out);
}

std::vector<fs::path> files_beside(const fs::path& file) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(file.parent_path())) {
    const auto ending = entry.path().extension();
    if (ending == ".btf" || ending == ".xml") found.push_back(entry.path());
  }
  return found;
}

// The tree that the rules name, else each in their folder.
void read_back(const fs::path& file, Exported& all) {
  const InputFile rules{file.string(), file_text(file)};
  const auto named = tree_of_properties(rules);
  std::vector<fs::path> trees;
  if (named.value && !named.value->empty()) {
    trees = {file.parent_path() / *named.value};
  } else {
    trees = files_beside(file);
  }
  for (const fs::path& tree : trees) {
    read_back({tree.string(), file_text(tree)}, rules, {}, all);
  }
}

void read_back_random(std::uint64_t seed, Exported& all) {
  constexpr TickSemantics kTicks[] = {
      TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes};
  SplitMix64 random(seed);
  ExportOptions options;
  options.ticks = kTicks[seed % 3];
  const InputFile text{"random.btf", random_tree(random.next(), {})};
  const auto tree = read_btf(text.name, text.text);
  REQUIRE(tree.value);
  const Network network = lower(*tree.value, *options.ticks);
  const SplitMix64 stream(random.next());
  const bool assumes = random.percent(40);
  std::string rules;
  for (int i = 0; i < 12; ++i) {
    RandomProperty made = random_property(*tree.value, network, random, {});
    if (assumes) assume_something(made, *tree.value, network, stream);
    if (i == 0) rules = made.assumption.text;
    if (made.assumption.by_option) options.extra = ExtraAssumption::ActionsEnd;
    rules += fmt::format("property p{} : {}\n", i, made.body);
  }
  read_back(text, {"random.ltl", rules}, options, all);
}

}  // namespace

TEST_CASE("frac accepts the properties that its language has") {
  for (const std::string_view body :
       {"deadlockfree", "always p0", "absent p0 after p1",
        "absent p0 before p1 for 2", "absent p0 after p1 within [0,3]",
        "present p0 lasting 2", "present p0 after p1 until p2",
        "p0 precedes p1 between p2 and p3", "absent t/1/state done",
        "absent (p0 and not p1)", "p0 leadsto p1",
        "p0 leadsto p1 before p2 within [1,3]", "ltl t/1/state done",
        "ltl [] p0", "ltl not <> p0", "ltl (p0 => p1)",
        "ltl [] (p0 => <> p1 and not p2 until p3)"}) {
    CAPTURE(body);
    CHECK(is_accepted(body));
  }
}

TEST_CASE("frac refuses a formula whose top stands without parentheses") {
  for (const std::string_view body :
       {"ltl p0 => p1", "ltl p0 and p1", "ltl p0 or p1", "ltl p0 until p1",
        "ltl p0 release p1", "ltl [] p0 => <> p1", "absent not p0",
        "absent p0 and p1", "not p0 leadsto p1", "p0 leadsto p1 or p2"}) {
    CAPTURE(body);
    CHECK(!is_accepted(body));
  }
}

TEST_CASE("frac has no constants, no W and no <=>") {
  for (const std::string_view body :
       {"ltl (true => p0)", "ltl true", "absent (p0 or false)", "absent false",
        "ltl (p0 W p1)", "ltl (p0 <=> p1)"}) {
    CAPTURE(body);
    CHECK(!is_accepted(body));
  }
  CHECK(is_accepted("absent t/1/value (false)"));
}

TEST_CASE("frac has few patterns with a time, and closed intervals only") {
  for (const std::string_view body :
       {"p0 leadsto first p1 within [1,2]", "present first p0 within [1,2]",
        "absent p0 after p1 for [0,3]", "absent p0 lasting 2",
        "always p0 within [0,1]", "p0 precedes p1 within [0,1]",
        "present p0 before p1 within [0,1]",
        "p0 leadsto p1 between p2 and p3 within [0,1]",
        "p0 leadsto p1 within [0,1] before p2", "p0 leadsto p1 within [1,...[",
        "p0 leadsto p1 within ]0,1]", "p0 leadsto p1 within [0,1["}) {
    CAPTURE(body);
    CHECK(!is_accepted(body));
  }
}

TEST_CASE("words of Fiacre name no property, and a name is given once") {
  const std::string model(kModel);
  const std::string p = "property p is deadlockfree\nassert p\n";
  CHECK(complaint(model + p) == "");
  CHECK(complaint(model + p + p) != "");
  CHECK(complaint(model + "property mortal is deadlockfree\nassert mortal\n") !=
        "");
}

TEST_CASE("frac accepts the exports of all trees with their properties") {
  Exported all;
  for (const char* folder :
       {BTCHECK_EXAMPLES, BTCHECK_PROPERTIES, BTCHECK_REGRESS}) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() == ".ltl") read_back(entry.path(), all);
    }
  }
  MESSAGE(all.models << " models, " << all.properties << " properties, "
                     << all.left_out << " left out");
  CHECK_COVERED(all.models >= 200);
}

TEST_CASE("frac accepts the exports of random properties") {
  Exported all;
  const int cases = by_effort(100, 3000);
  for (int i = 0; i < cases; ++i) {
    read_back_random(seed_or(1) * 1'000'000 + static_cast<std::uint64_t>(i),
                     all);
  }
  MESSAGE(all.models << " models, " << all.properties << " properties, "
                     << all.left_out << " left out");
  CHECK_COVERED(all.models > cases / 2);
}

}  // namespace btcheck::reference::fiacre_property_test
