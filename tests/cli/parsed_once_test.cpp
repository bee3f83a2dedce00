// SPDX-License-Identifier: MIT
//
// However many stages look at a text, it is parsed once.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "batch/entries/entries.hpp"
#include "batch/entry_result.hpp"
#include "batch/results/kept_results.hpp"
#include "check/repairs/repairs.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/options/options.hpp"
#include "model/btcpp/unknown_leaves.hpp"
#include "temporary_folder.hpp"
#include "text/input_file.hpp"

namespace btcheck::parsed_once_test {
namespace {

constexpr const char* kTree =
    R"(<root BTCPP_format="4" main_tree_to_execute="M">
  <include path="more.xml"/>
  <BehaviorTree ID="M">
    <Sequence>
      <Fallback><IsOpen/><OpenDoor/></Fallback>
      <SubTree ID="Inside"/>
      <SubTree ID="Beside"/>
    </Sequence>
  </BehaviorTree>
  <TreeNodesModel><Condition ID="IsOpen"/></TreeNodesModel>
</root>
)";

std::string tree_of(const std::string& id) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"" + id +
         "\"><Sequence><Go/></Sequence></BehaviorTree></root>\n";
}

class Texts {
 public:
  Texts() {
    write("m.xml", kTree);
    write("more.xml", tree_of("Inside"));
    write("beside.xml", tree_of("Beside"));
    write("m.ltl", "tree \"m.xml\"\nproperty p: never OpenDoor.halted\n");
    write("m.leaves", "(defaction Go :returns (success running))\n");
  }

  std::string file(const std::string& name) const {
    return folder_.path() / name;
  }
  std::string folder() const { return folder_.path(); }

  // Those that were not parsed just once, edited ones aside.
  std::vector<std::string> wrong(const ParseCount& count) const {
    std::vector<std::string> wrong;
    for (const auto& [name, text] : texts_) {
      const auto found = count.of_texts().find(text);
      const int times = found == count.of_texts().end() ? 0 : found->second;
      if (times != 1) wrong.push_back(name + " " + std::to_string(times));
    }
    for (const auto& [text, times] : count.of_texts()) {
      if (times > 1) wrong.push_back(std::to_string(times) + "\n" + text);
    }
    return wrong;
  }

 private:
  void write(const std::string& name, const std::string& text) {
    write_file(file(name), text);
    texts_.emplace_back(name, text);
  }

  TemporaryFolder folder_;
  std::vector<std::pair<std::string, std::string>> texts_;
};

Options options_for(const Texts& texts) {
  Options options;
  options.input = texts.file("m.xml");
  options.properties = {texts.file("m.ltl")};
  options.leaves = {texts.file("m.leaves")};
  return options;
}

Inputs inputs_for(const Options& options) {
  std::vector<Diagnostic> found;
  auto inputs =
      gather_inputs(options.input, options.properties, options, found);
  REQUIRE(inputs);
  return std::move(*inputs);
}

TEST_CASE("a check with repairs") {
  const Texts texts;
  const ParseCount count;
  const Inputs inputs = inputs_for(options_for(texts));
  const auto result = check_and_repair(inputs.tree, inputs.properties, {});
  CHECK(result.files.size() == 1);
  CHECK(texts.wrong(count) == std::vector<std::string>());
}

TEST_CASE("the default report with a repair, and a .btf") {
  for (const std::string name : {"t.xml", "t.btf"}) {
    TemporaryFolder folder;
    write_file((folder.path() / name).string(),
               name == "t.xml"
                   ? "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\">"
                     "<ReactiveSequence><IsOpen/>\n<OpenDoor/>\n<Sequence><Go/>"
                     "</Sequence></ReactiveSequence></BehaviorTree>"
                     "<TreeNodesModel><Condition ID=\"IsOpen\"/>"
                     "</TreeNodesModel></root>"
                   : "((BehaviorTree :name t (ReactiveSequence :halt 1\n"
                     "(Condition :ID is_open)\n(Action :ID open_door)\n"
                     "(Sequence (Action :ID go)))))\n");
    Options options;
    options.input = (folder.path() / name).string();
    const ParseCount count;
    const Inputs inputs = inputs_for(options);
    check_and_repair(inputs.tree, inputs.properties, {});
    CHECK(count.of_texts().size() > (name == "t.xml" ? 1 : 0));
    for (const auto& [text, times] : count.of_texts()) {
      INFO(text);
      CHECK(times == 1);
    }
  }
}

TEST_CASE("lint, and leaves that are unknown") {
  const Texts texts;
  {
    const ParseCount count;
    const Inputs inputs = inputs_for(options_for(texts));
    lint_inputs(inputs.tree, inputs.properties);
    CHECK(texts.wrong(count) == std::vector<std::string>());
  }
  const ParseCount count;
  const Inputs inputs = inputs_for(options_for(texts));
  UnknownLeaves leaves;
  add_unknown_leaves(inputs.tree.name, inputs.tree.text, inputs.tree.reading,
                     leaves);
  tree_of_properties(inputs.properties[0]);
  CHECK(texts.wrong(count) == std::vector<std::string>());
}

TEST_CASE("a tree that only older releases take") {
  Options options;
  TemporaryFolder folder;
  options.input = folder.path() / "t.xml";
  write_file(options.input,
             "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\">"
             "<ScriptCondition code=\"x == &quot;a&quot; || x := 2\"/>"
             "</BehaviorTree></root>");
  const ParseCount count;
  const Inputs inputs = inputs_for(options);
  lint_inputs(inputs.tree, inputs.properties);
  CHECK(count.of_texts().size() == 1);
  for (const auto& [text, times] : count.of_texts()) CHECK(times == 1);
}

class KeepsNothing final : public KeptResults {
 public:
  Found find(const std::string&) const override { return {}; }
  void use(const std::string&) override {}
  void add(const std::string&, const ReportedTree&) override {}
};

TEST_CASE("a batch of a folder, all of its trees together") {
  const Texts texts;
  Options options;
  options.command = Command::Batch;
  options.batch.sources = {texts.folder()};
  options.leaves = {texts.file("m.leaves")};
  const ParseCount count;
  const auto entries = gather_batch(options);
  CHECK(entries.size() == 1);
  KeepsNothing kept;
  for (const BatchEntry& entry : entries) {
    const auto result = result_of(entry, options, kept,
                                  [](const std::string&, const LookedAt&) {});
    REQUIRE(result);
    CHECK(result->tree.code != ExitCode::BadInput);
  }
  CHECK(texts.wrong(count) == std::vector<std::string>());
}

}  // namespace
}  // namespace btcheck::parsed_once_test
