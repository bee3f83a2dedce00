// SPDX-License-Identifier: MIT
//
// Formatting keeps what files mean: of all files of this project and of random
// trees, with blanks, line breaks and comments wherever they may stand. A style
// is one: formatted again, nothing changes.
//
// BTCHECK_STYLE_FOLDER names another folder whose files are taken instead.
#include "style/kept.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "btcpp_random/scripted_tree.hpp"
#include "file_text.hpp"
#include "ltl/rules/parser.hpp"
#include "ltl/rules/property.hpp"
#include "model/btcpp/outline.hpp"
#include "model/btcpp/xml_text.hpp"
#include "model/btf/forms.hpp"
#include "model/tree_file.hpp"
#include "reference/effort.hpp"
#include "reference/random_tree.hpp"
#include "style/style.hpp"

namespace btcheck {
namespace kept_test {
namespace {

namespace fs = std::filesystem;

using reference::SplitMix64;

// --- What a file says ----------------------------------------------------

struct Counts {
  int files = 0;
  int changed = 0;
  int networks = 0;
  int rules = 0;
};

void compare_networks(const std::string& name, const std::string& before,
                      const std::string& after, Counts& counts,
                      const TreeReading& reading) {
  const auto one =
      lowered_input({{name, before}, reading}, {}, TickSemantics::Root);
  if (!one.value) return;
  const auto other =
      lowered_input({{name, after}, reading}, {}, TickSemantics::Root);
  REQUIRE(other.value.has_value());
  CHECK(difference(*one.value, *other.value) == "");
  ++counts.networks;
}

void compare_trees(const std::string& name, const std::string& before,
                   const std::string& after, Counts& counts) {
  if (!is_xml(name, before)) {
    return compare_networks(name, before, after, counts, {});
  }
  const auto outline = outline_of(before);
  if (!outline) return;
  for (const std::string& tree : outline->trees) {
    TreeReading reading;
    reading.main_tree = tree;
    compare_networks(name, before, after, counts, reading);
  }
}

std::string unspaced(std::string text) {
  std::erase(text, ' ');
  return text;
}

void compare_rules(const std::string& name, const std::string& before,
                   const std::string& after, Counts& counts) {
  const auto one = read_properties(name, before);
  const auto other = read_properties(name, after);
  REQUIRE(one.value.has_value());
  REQUIRE(other.value.has_value());
  CHECK(one.value->tree == other.value->tree);
  CHECK(one.value->ticks == other.value->ticks);
  CHECK(one.value->atoms.size() == other.value->atoms.size());
  REQUIRE(one.value->properties.size() == other.value->properties.size());
  for (std::size_t i = 0; i < one.value->properties.size(); ++i) {
    const Property& here = one.value->properties[i];
    const Property& there = other.value->properties[i];
    CHECK(here.name == there.name);
    CHECK(here.title == there.title);
    CHECK(here.tags == there.tags);
    CHECK(here.expectation == there.expectation);
    CHECK(here.form == there.form);
    // Formulas are numbered in the order in which they are read.
    CHECK(here.formula == there.formula);
    CHECK(unspaced(here.text) == unspaced(there.text));
    ++counts.rules;
  }
}

std::vector<std::string> words_of_forms(const std::string& text) {
  const btf::ParsedForms parsed(text);
  std::vector<std::string> words;
  for (const btf::Token& token : parsed.forms.tokens) {
    words.emplace_back(token.text);
  }
  return words;
}

// Values as our reader reads them, in any order.
std::vector<std::string> said_by(const std::string& text) {
  const btcpp::ParsedXml parsed(text);
  REQUIRE(parsed.value.has_value());
  std::vector<std::string> said;
  for (const btcpp::XmlElement& element : *parsed.value) {
    std::set<std::string> attributes;
    for (const auto& each : element.attributes) {
      attributes.insert(each.name + "=" + each.value);
    }
    said.push_back(element.name + " in " + std::to_string(element.parent) +
                   ": " + element.text);
    said.insert(said.end(), attributes.begin(), attributes.end());
  }
  return said;
}

// Formats twice and compares; false where the file cannot be read.
bool is_kept(const std::string& name, const std::string& before,
             Counts& counts) {
  const auto once = styled({name, before});
  if (!once.value) {
    CHECK(has_error(once.diagnostics));
    CHECK(once.diagnostics[0].file == name);
    return false;
  }
  CAPTURE(name);
  const auto twice = styled({name, *once.value});
  REQUIRE(twice.value.has_value());
  CHECK(*twice.value == *once.value);
  ++counts.files;
  counts.changed += *once.value == before ? 0 : 1;
  if (is_property_file(name)) {
    compare_rules(name, before, *once.value, counts);
  } else if (is_xml(name, before)) {
    CHECK(said_by(*once.value) == said_by(before));
    compare_trees(name, before, *once.value, counts);
  } else {
    CHECK(words_of_forms(*once.value) == words_of_forms(before));
    if (name.ends_with(".btf")) {
      compare_trees(name, before, *once.value, counts);
    }
  }
  return true;
}

// --- Blanks, line breaks and comments anywhere ----------------------------

std::string random_gap(SplitMix64& random, const std::string& comment) {
  static const std::vector<std::string> gaps = {
      " ", " ", "\n", "\n   ", "\n\n\n\n", "\t", "   ", "\r\n"};
  std::string gap;
  for (int i = random.below(3); i >= 0; --i) {
    gap += gaps[static_cast<std::size_t>(
        random.below(static_cast<int>(gaps.size())))];
    if (random.percent(8)) gap += comment;
  }
  return gap;
}

// The words of a .btf, anew.
std::string scattered_forms(const std::string& text, SplitMix64& random) {
  std::string scattered;
  const btf::ParsedForms parsed(text);
  int number = 0;
  for (const btf::Token& token : parsed.forms.tokens) {
    scattered +=
        random_gap(random, "; comment " + std::to_string(++number) + "  \n");
    scattered += token.text;
  }
  return scattered + random_gap(random, "; the end\n");
}

// Between tags, and between attributes without the comments.
std::string scattered_xml(const std::string& text, SplitMix64& random) {
  std::string scattered;
  int number = 0;
  char quote = '\0';
  bool is_in_tag = false;
  for (const char c : text) {
    if (quote != '\0') {
      quote = c == quote ? '\0' : quote;
      scattered += c;
    } else if (is_in_tag && (c == '"' || c == '\'')) {
      quote = c;
      scattered += c;
    } else if (is_in_tag && c == ' ') {
      scattered += random_gap(random, "");
    } else if (c == '<') {
      if (!scattered.empty()) {
        scattered += random_gap(
            random, "<!-- note\n " + std::to_string(++number) + " -->");
      }
      is_in_tag = true;
      scattered += c;
    } else if (is_in_tag || (c != '\n' && c != ' ')) {
      is_in_tag = is_in_tag && c != '>';
      scattered += c;
    }
  }
  return scattered + random_gap(random, "<!-- the end -->");
}

// Blanks and comments between words of a line, and at the ends of lines.
std::string scattered_rules(const std::string& text, SplitMix64& random) {
  const std::vector<std::string> gaps = {" ", "    ", "\t", " /* note */ "};
  const SourceText source("", text);
  const TokenList read = tokenize(source);
  std::string scattered;
  std::size_t at = 0;
  for (const Token& token : read.tokens) {
    const bool is_end = token.kind == TokenKind::End;
    const std::size_t begin = is_end ? text.size() : token.begin;
    const std::string gap = text.substr(at, begin - at);
    if (gap.find_first_not_of(" \t") != gap.npos || gap.empty()) {
      const bool begins_line = gap.starts_with('\n') && random.percent(20);
      scattered += (begins_line ? "  # note" : "") + gap;
    } else {
      scattered += gaps[static_cast<std::size_t>(random.below(4))];
    }
    scattered += text.substr(begin, token.end - begin);
    at = token.end;
  }
  return scattered;
}

// Whether the networks of two trees are told apart, and by what.
std::string told_apart(const std::string& one, const std::string& other) {
  const auto before =
      lowered_input({{"t.btf", one}, {}}, {}, TickSemantics::Root);
  const auto after =
      lowered_input({{"t.btf", other}, {}}, {}, TickSemantics::Root);
  REQUIRE(before.value.has_value());
  REQUIRE(after.value.has_value());
  return difference(*before.value, *after.value);
}

}  // namespace

TEST_CASE("networks are told apart by all that is checked, not by lines") {
  const std::string tree =
      "(defsv x :max 3 :init 0)\n(BehaviorTree :name t (Repeat :repeat 2 "
      "(Sequence (Action :ID a) (Action :ID b :duration 3) (Eval (< x 2)))))";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string other = tree;
    other.replace(other.find(from), from.size(), to);
    return told_apart(tree, other);
  };
  CHECK(with("(Sequence", "\n\n(Sequence ; a comment\n") == "");
  CHECK(with("(Sequence", "(Fallback") != "");
  CHECK(with(":repeat 2", ":repeat 3") != "");
  CHECK(with(":ID a", ":ID c") != "");
  CHECK(with(":ID a", ":ID a :SF") != "");
  CHECK(with(":duration 3", ":duration 4") != "");
  CHECK(with("(< x 2)", "(< x 1)") != "");
  CHECK(with("(< x 2)", "(> x 2)") != "");
  CHECK(with(":max 3", ":max 4") != "");
  CHECK(with(":init 0", ":init 1") != "");
  CHECK(with(":name t", ":name t :loop 1") != "");
  CHECK(with("(Action :ID a) ", "") != "");
}

TEST_CASE("every file means the same in its style, and has only one") {
  const char* other = std::getenv("BTCHECK_STYLE_FOLDER");
  std::vector<std::string> folders = {BTCHECK_ROOT "/examples",
                                      BTCHECK_ROOT "/properties",
                                      BTCHECK_ROOT "/tests"};
  if (other != nullptr) folders = {other};
  Counts counts;
  int refused = 0;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string name = entry.path().string();
      const bool is_ours = is_tree_name(name) || is_property_file(name) ||
                           name.ends_with(".leaves");
      if (!entry.is_regular_file() || !is_ours) continue;
      refused += is_kept(name, file_text(name), counts) ? 0 : 1;
    }
  }
  MESSAGE(counts.files << " files, " << counts.changed << " in another style, "
                       << counts.networks << " networks, " << counts.rules
                       << " rules; " << refused << " cannot be read");
  if (other != nullptr) return;
  CHECK(counts.files > 1000);
  CHECK(counts.networks > 600);
  CHECK(counts.rules > 3000);
}

TEST_CASE("rules mean the same, whatever stands between their words") {
  Counts counts;
  SplitMix64 random(reference::seed_or(1));
  for (const char* folder :
       {BTCHECK_ROOT "/examples", BTCHECK_ROOT "/properties"}) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string name = entry.path().string();
      if (!is_property_file(name)) continue;
      const std::string text = file_text(name);
      const std::string scattered = scattered_rules(text, random);
      CAPTURE(scattered);
      REQUIRE(is_kept(name, scattered, counts));
      compare_rules(name, text, *styled({name, scattered}).value, counts);
    }
  }
  CHECK(counts.files > 150);
}

TEST_CASE("random trees of .btf mean the same, wherever their lines break") {
  const std::uint64_t trees = reference::by_effort(200u, 2500u);
  Counts counts;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t seed = reference::seed_or(1) * 1'000'003 + i;
    const std::string text =
        reference::random_tree(seed, i % 2 == 0 ? reference::RandomTreeWeights()
                                                : reference::large_trees());
    SplitMix64 random(seed);
    const std::string scattered =
        i % 5 == 0 ? text : scattered_forms(text, random);
    CAPTURE(scattered);
    REQUIRE(is_kept("t.btf", scattered, counts));
  }
  CHECK(counts.networks == static_cast<int>(trees));
}

TEST_CASE("random XML trees mean the same, and have one style") {
  const std::uint64_t trees = reference::by_effort(200u, 2500u);
  constexpr Profile kProfiles[] = {Profile::Btcpp4, Profile::Btcpp38,
                                   Profile::Nav2Humble, Profile::Nav2Main};
  Counts counts;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t seed = reference::seed_or(1) * 1'000'003 + i;
    const std::string text =
        reference::random_scripted_tree(seed, kProfiles[i % 4],
                                        reference::World::Scripted, 5)
            .xml;
    SplitMix64 random(seed);
    const std::string scattered = scattered_xml(text, random);
    CAPTURE(scattered);
    REQUIRE(is_kept("t.xml", scattered, counts));
    compare_trees("t.xml", text, *styled({"t.xml", scattered}).value, counts);
  }
  CHECK(counts.networks > static_cast<int>(trees));
}

}  // namespace kept_test
}  // namespace btcheck
