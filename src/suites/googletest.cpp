// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "model/tree/node_types.hpp"
#include "suites/formats.hpp"
#include "suites/runner.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// A literal of C++.
std::string literal(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (c == '\n') {
      quoted += "\\n";
    } else if (static_cast<unsigned char>(c) < ' ') {
      quoted += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

// The same over several lines: broken behind blanks.
std::string long_literal(std::string_view text, std::size_t indent) {
  constexpr std::size_t kWidth = 64;
  std::string lines;
  while (!text.empty()) {
    std::size_t end = text.size();
    if (end > kWidth) {
      end = text.rfind(' ', kWidth);
      if (end == text.npos) end = text.find(' ');
      end = end == text.npos ? text.size() : end + 1;
    }
    if (!lines.empty()) lines += '\n' + std::string(indent, ' ');
    lines += literal(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines.empty() ? "\"\"" : lines;
}

// Literals of C++ that are strings, and numbers of their type.
std::string value_literal(const btcpp::ScriptValue& value) {
  if (value.kind == btcpp::ScriptKind::Text) {
    return fmt::format("std::string({})", literal(value.text));
  }
  if (value.type == btcpp::NumberType::Integer) {
    return fmt::format("{}", static_cast<std::int64_t>(value.number));
  }
  const std::string digits = fmt::format("{}", value.exact_number());
  const bool has_point = digits.find_first_of(".en") != digits.npos;
  return has_point ? digits : digits + ".0";
}

class Writer {
 public:
  Writer(const DescribedSuite& described, const BehaviorTree& tree,
         const Suite& suite)
      : described_(described), tree_(tree), suite_(suite) {}

  std::string text() const {
    return heading() +
           fmt::format("#define BTCHECK_SUITE_RELEASE {}\n\n",
                       described_.release) +
           runner() + includes() + tree_text() + coverage_text() + tests_text();
  }

 private:
  std::string heading() const {
    std::string text = fmt::format(
        "// {} of {}: the tree {}.\n"
        "//\n"
        "// Fakes stand for the leaves and answer what a test says; what every "
        "node does\n"
        "// because of it, tick by tick, is what the exhaustive search of the "
        "model says.\n"
        "// All that can be forced on an engine is reached by some test:\n"
        "//\n",
        kSuiteMark, described_.file, described_.title);
    const std::string summary = suite_summary(suite_, tree_);
    for (std::size_t begin = 0; begin < summary.size();) {
      const std::size_t end = summary.find('\n', begin);
      text += "//   " + unbroken(summary.substr(begin, end - begin)) + '\n';
      begin = end + 1;
    }
    const auto names = [&](const std::vector<std::string>& types) {
      return fmt::format("{}", fmt::join(types, ", "));
    };
    if (!described_.linked.empty()) {
      text += fmt::format(
          "//\n// The tree has nodes of Nav2 that are no leaves: {}.\n"
          "// Compile this file in a program that links Nav2, with\n"
          "// BTCHECK_SUITE_NODES naming a header that defines\n"
          "//   void register_suite_nodes(BT::BehaviorTreeFactory&)\n",
          names(described_.linked));
    }
    if (!described_.unknown.empty()) {
      text += fmt::format(
          "//\n// The tree has control nodes or decorators of the program's "
          "own: {}.\n// What they do is not known, and nothing beyond them is "
          "tested; register them\n// as above.\n",
          names(described_.unknown));
    }
    return text;
  }

  // Without its first lines, which are no business of who reads the tests.
  static std::string runner() {
    std::string text(kSuiteRunner);
    const std::string pragma = "#pragma once\n\n";
    text.erase(0, text.find(pragma) + pragma.size());
    return text;
  }

  static std::string includes() {
    return "\n#include <gtest/gtest.h>\n\n"
           "#ifdef BTCHECK_SUITE_NODES\n#include BTCHECK_SUITE_NODES\n"
           "#endif\n\n"
           "// clang-format off\nnamespace {\n\n"
           "using btcheck::suite::Cell;\nusing btcheck::suite::ScriptedRun;\n";
  }

  std::string tree_text() const {
    std::string text = fmt::format(
        "\nconst btcheck::suite::Tree kTree = {{\n    // The tree, with all "
        "that it includes.\n    {},\n    // The leaves that the program "
        "registers.\n    {{\n",
        raw_text(described_.xml));
    for (const SuiteLeaf& leaf : described_.leaves) {
      std::string ports;
      for (const SuiteLeafPort& port : leaf.ports) {
        ports +=
            fmt::format("{}{{{}, '{}', {}}}", ports.empty() ? "" : ", ",
                        literal(port.name), port.direction, literal(port.type));
      }
      text += fmt::format("        {{{}, {}, {{{}}}}},\n", literal(leaf.id),
                          leaf.is_condition, ports);
    }
    text +=
        "    },\n    // The nodes in pre-order; true for a leaf that keeps "
        "its answer until reset.\n    {\n";
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      const Node& node = tree_.nodes[n];
      if (node.is_root()) continue;
      text += fmt::format(
          "        {{{}, {}, {}}},\n", literal(described_.keys[n]),
          literal(node.type == NodeType::SubTree ? "SubTree" : node.id),
          node.contract.memory == LeafMemory::Latched);
    }
    return text + "    }};\n";
  }

  // In pieces: a compiler need not take more than 65,536 bytes at once.
  static std::string raw_text(std::string_view text) {
    constexpr std::size_t kMost = 16'000;
    std::string pieces;
    while (!text.empty()) {
      const std::string_view piece = text.substr(0, kMost);
      text.remove_prefix(piece.size());
      pieces += pieces.empty() ? "" : "\n    ";
      pieces += piece.find(")btcheck\"") == piece.npos
                    ? fmt::format("R\"btcheck({})btcheck\"", piece)
                    : literal(piece);
    }
    return pieces;
  }

  std::string coverage_text() const {
    std::string text =
        "\n// What the engine itself has answered is counted, and told in the "
        "end.\nconst std::set<Cell> kReached = {\n";
    for (const auto& [node, question] : suite_.reached) {
      text += fmt::format("    {{{}, \"{}\"}},\n", index(node) - 1,
                          word_of(question));
    }
    text += fmt::format(
        "}};\n\nclass Coverage : public ::testing::Environment {{\n public:\n"
        "  void SetUp() override {{\n"
        "#ifdef BTCHECK_SUITE_NODES\n"
        "    btcheck::suite::more_nodes() = register_suite_nodes;\n"
        "#endif\n  }}\n"
        "  void TearDown() override {{\n"
        "    std::size_t reached = 0;\n"
        "    for (const Cell& cell : kReached) {{\n"
        "      reached += btcheck::suite::reached().count(cell);\n    }}\n"
        "    std::printf(\"reached on the engine: %zu of %zu answers and halts "
        "that are proven \"\n"
        "                \"possible; left out by name: {}\\n\", reached,\n"
        "                std::size_t{{{}}});\n  }}\n}};\n"
        "[[maybe_unused]] const auto* kCoverage =\n"
        "    ::testing::AddGlobalTestEnvironment(new Coverage);\n",
        suite_.left_out.size(), suite_.proven.size());
    return text;
  }

  std::string tests_text() const {
    std::string text;
    for (const SuiteTest& test : suite_.tests) text += test_text(test);
    return text + "\n}  // namespace\n";
  }

  std::string written(const EntryWrite& write) const {
    return fmt::format("{}, {}, {}", key(write.home), literal(write.key),
                       value_literal(write.value));
  }
  std::string key(NodeId node) const {
    return literal(described_.keys[index(node)]);
  }

  std::string test_text(const SuiteTest& test) const {
    std::string text = fmt::format(
        "\n// {}{}\nTEST({}, {}) {{\n"
        "  ScriptedRun run(kTree);\n",
        unbroken(test.about), test.code.empty() ? "" : ": " + test.code,
        described_.name, test.name);
    for (const EntryWrite& write : suite_.initial) {
      text += fmt::format("  run.set({});\n", written(write));
    }
    for (const auto& [leaf, answers] : test.leaves) {
      text += fmt::format("  run.leaf({}, {});\n", key(leaf),
                          long_literal(answers_text(answers), 11));
      for (std::size_t i = 0; i < answers.size(); ++i) {
        for (const EntryWrite& write : answers[i].writes) {
          text += fmt::format("  run.writes({}, {}, {});\n", key(leaf), i + 1,
                              written(write));
        }
      }
    }
    for (const SuiteTick& tick : test.ticks) {
      for (const EntryWrite& write : tick.before) {
        text += fmt::format("  run.set({});\n", written(write));
      }
      text += fmt::format("  EXPECT_EQ(run.tick(),\n            {}){};\n",
                          long_literal(tick_text(described_, tick), 12),
                          tick.root.empty() ? "" : " << run.why()");
    }
    return text + "}\n";
  }

  const DescribedSuite& described_;
  const BehaviorTree& tree_;
  const Suite& suite_;
};

}  // namespace

std::vector<SuiteFile> googletest_files(const DescribedSuite& described,
                                        const BehaviorTree& tree,
                                        const Suite& suite) {
  const std::string build = fmt::format(
      "# {}: the tests of this folder, one program each.\n"
      "#   cmake -S . -B build && cmake --build build && ctest --test-dir "
      "build\n"
      "# -DENGINE=behaviortree_cpp_v3 takes BehaviorTree.CPP 3.8, and\n"
      "# -DNODES=HEADER a header of your own that registers more nodes, with "
      "-DLINK=LIBRARIES.\n"
      "cmake_minimum_required(VERSION 3.16)\n"
      "project(btcheck_tests CXX)\n\n"
      "set(ENGINE behaviortree_cpp CACHE STRING \"The engine's package\")\n"
      "set(NODES \"\" CACHE FILEPATH \"A header that registers more nodes\")\n"
      "set(LINK \"\" CACHE STRING \"Libraries that it needs\")\n"
      "find_package(${{ENGINE}} REQUIRED)\n"
      "find_package(GTest REQUIRED)\n"
      "set(library ${{ENGINE}})\n"
      "if(TARGET BT::${{ENGINE}})\n  set(library BT::${{ENGINE}})\nendif()\n\n"
      "enable_testing()\n"
      "file(GLOB tests CONFIGURE_DEPENDS \"*_test.cpp\")\n"
      "foreach(test ${{tests}})\n"
      "  get_filename_component(name ${{test}} NAME_WE)\n"
      "  add_executable(${{name}} ${{test}})\n"
      "  target_compile_features(${{name}} PRIVATE cxx_std_17)\n"
      "  target_link_libraries(${{name}} PRIVATE ${{library}} "
      "GTest::gtest_main "
      "${{LINK}})\n"
      "  if(NODES)\n"
      "    target_compile_definitions(${{name}} PRIVATE "
      "BTCHECK_SUITE_NODES=\"${{NODES}}\")\n"
      "  endif()\n"
      "  add_test(NAME ${{name}} COMMAND ${{name}})\n"
      "endforeach()\n",
      kSuiteMark);
  return {{described.name + "_test.cpp", Writer(described, tree, suite).text()},
          {"CMakeLists.txt", build}};
}

}  // namespace btcheck
