// SPDX-License-Identifier: MIT
//
// Edits of texts: to the letter on a few, and on random XML: what is read after
// an edit is what was read before, with that change.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/btcpp/xml_text.hpp"
#include "model/edits/contract_text.hpp"
#include "model/edits/edited_files.hpp"
#include "model/tree/node_types.hpp"
#include "text/repair.hpp"

namespace btcheck::edits_test {
namespace {

// The text after the edits; "does not fit" where they do not.
std::string edited(const std::string& name, const std::string& text,
                   const Repair& repair) {
  EditedFiles files({{name, text}});
  return files.apply(repair) ? files.files()[0].text : "does not fit";
}

SourcePlace xml(int line, int column) { return {"t.xml", line, column}; }
SourcePlace btf(int line, int column) { return {"t.btf", line, column}; }

const std::string kXml =
    "<root>\n"
    "  <!-- <Sequence> -->\n"
    "  <Sequence name=\"a>b\">\n"
    "    <A/>\n"
    "    <B x='1'/> <!-- about B -->\n"
    "  </Sequence>\n"
    "</root>\n";

TEST_CASE("an attribute is added, changed and taken away") {
  CHECK(edited("t.xml", "<A/>", {SetAttribute{xml(1, 2), "x", "a<\"b\""}}) ==
        "<A x=\"a&lt;&quot;b&quot;\"/>");
  CHECK(edited("t.xml", "<A y='1' />", {SetAttribute{xml(1, 2), "x", "2"}}) ==
        "<A y='1' x=\"2\" />");
  CHECK(edited("t.xml", "<A x='1'/>", {SetAttribute{xml(1, 2), "x", "it's"}}) ==
        "<A x='it&apos;s'/>");
  CHECK(edited("t.xml", "<A x='1' y='2'/>",
               {RemoveAttribute{xml(1, 2), "x"}}) == "<A y='2'/>");
  CHECK(edited("t.xml", "<A/>", {RemoveAttribute{xml(1, 2), "x"}}) ==
        "does not fit");
  CHECK(edited("t.xml", "<A x=\"s != 'day'\"/>",
               {ReplaceInAttributes{xml(1, 2), "'day'", "'Day'"}}) ==
        "<A x=\"s != 'Day'\"/>");
  CHECK(edited("t.xml", "<A x=\"{cup_pos}\"/>",
               {ReplaceWord{xml(1, 8), "cup_pos", "cup_pose"}}) ==
        "<A x=\"{cup_pose}\"/>");
}

TEST_CASE("a type is changed in both tags") {
  CHECK(edited("t.xml", kXml, {ChangeType{xml(3, 4), "Fallback"}}) ==
        "<root>\n"
        "  <!-- <Sequence> -->\n"
        "  <Fallback name=\"a>b\">\n"
        "    <A/>\n"
        "    <B x='1'/> <!-- about B -->\n"
        "  </Fallback>\n"
        "</root>\n");
  CHECK(edited("t.xml", "<Control ID=\"Sequence\" name=\"s\"><A/></Control>",
               {ChangeType{xml(1, 2), "Fallback"}}) ==
        "<Fallback name=\"s\"><A/></Fallback>");
}

TEST_CASE("what is wrapped is indented, what is unwrapped goes back") {
  const std::string wrapped =
      edited("t.xml", kXml,
             {WrapNodes{xml(3, 4), xml(3, 4), {"Inverter"}, {{"C"}}, {{"D"}}}});
  CHECK(wrapped ==
        "<root>\n"
        "  <!-- <Sequence> -->\n"
        "  <Inverter>\n"
        "    <C/>\n"
        "    <Sequence name=\"a>b\">\n"
        "      <A/>\n"
        "      <B x='1'/> <!-- about B -->\n"
        "    </Sequence>\n"
        "    <D/>\n"
        "  </Inverter>\n"
        "</root>\n");
  const std::string inner =
      edited("t.xml", kXml, {WrapNodes{xml(4, 6), xml(5, 6), {"Inverter"}}});
  CHECK(edited("t.xml", inner, {UnwrapNode{xml(4, 6)}}) == kXml);
}

TEST_CASE("an outer wrap and then an inner one") {
  CHECK(edited("t.xml", "<S>\n  <A/>\n  <B/>\n</S>\n",
               {WrapNodes{xml(2, 4), xml(3, 4), {"R"}},
                WrapNodes{xml(3, 4), xml(3, 4), {"Q"}}}) ==
        "<S>\n"
        "  <R>\n"
        "    <A/>\n"
        "    <Q>\n"
        "      <B/>\n"
        "    </Q>\n"
        "  </R>\n"
        "</S>\n");
}

TEST_CASE("a node is put before another, or moved there, line and all") {
  CHECK(edited("t.xml", kXml,
               {InsertBefore{xml(4, 6), {"Script", {{"code", "x := 'a'"}}}}}) ==
        "<root>\n"
        "  <!-- <Sequence> -->\n"
        "  <Sequence name=\"a>b\">\n"
        "    <Script code=\"x := 'a'\"/>\n"
        "    <A/>\n"
        "    <B x='1'/> <!-- about B -->\n"
        "  </Sequence>\n"
        "</root>\n");
  CHECK(edited("t.xml", "<S>\r\n  <A/>\r\n  <B/>\r\n</S>",
               {MoveBefore{xml(3, 4), xml(2, 4)}}) ==
        "<S>\r\n  <B/>\r\n  <A/>\r\n</S>");
  CHECK(edited("t.xml", "<S><A/><B/></S>",
               {WrapNodes{
                   xml(1, 5), xml(1, 5), {"F"}, {}, {{"N", {}, xml(1, 9)}}}}) ==
        "<S><F>\n"
        "  <A/>\n"
        "  <N>\n"
        "    <B/>\n"
        "  </N>\n"
        "</F><B/></S>");
}

TEST_CASE("the same in a .btf file") {
  const std::string text =
      "(BehaviorTree :name t  ; the (Sequence\n"
      "  (Sequence :name s\n"
      "    (Action :ID a :duration (1 2))\n"
      "    (Action :ID b)))\n";
  CHECK(edited("t.btf", text,
               {ChangeType{btf(2, 4), "ReactiveSequence"},
                SetAttribute{btf(2, 4), "halt", "1"}}) ==
        "(BehaviorTree :name t  ; the (Sequence\n"
        "  (ReactiveSequence :halt 1 :name s\n"
        "    (Action :ID a :duration (1 2))\n"
        "    (Action :ID b)))\n");
  CHECK(
      edited("t.btf", text, {WrapNodes{btf(3, 6), btf(4, 6), {"Fallback"}}}) ==
      "(BehaviorTree :name t  ; the (Sequence\n"
      "  (Sequence :name s\n"
      "    (Fallback\n"
      "      (Action :ID a :duration (1 2))\n"
      "      (Action :ID b))))\n");
  CHECK(edited("t.btf", "(Inverter (Action :ID a))", {UnwrapNode{btf(1, 2)}}) ==
        "(Action :ID a)");
}

TEST_CASE("places move with the text") {
  EditedFiles files({{"t.xml", kXml}});
  REQUIRE(files.apply({WrapNodes{xml(4, 6), xml(4, 6), {"Inverter"}}}));
  CHECK(files.moved(xml(3, 4)) == xml(3, 4));
  CHECK(files.moved(xml(4, 6)) == xml(5, 8));
  CHECK(files.moved(xml(5, 6)) == xml(7, 6));
  CHECK_FALSE(files.moved(xml(99, 1)));
}

TEST_CASE("a diff has a line of context, and says what it leaves out") {
  const CheckedRepair repair{{changed_lines("f", "a\nb\nc\nd\ne\nf\ng\nh\n",
                                            "a\nB\nc\nd\nf\ng\nh\ni\n")}};
  CHECK(diff_lines(repair, 99) ==
        std::vector<std::string>{"@@ -1,6 +1,5 @@", " a", "-b", "+B", " c",
                                 " d", "-e", " f", "@@ -8 +7,2 @@", " h",
                                 "+i"});
  CHECK(diff_lines(repair, 3) == std::vector<std::string>{"@@ -1,6 +1,5 @@",
                                                          " a", "-b",
                                                          "… 8 more lines"});
  const CheckedRepair all_new{{changed_lines("f", "", "a\n")}};
  CHECK(diff_lines(all_new, 9) ==
        std::vector<std::string>{"@@ -0,0 +1 @@", "+a"});
}

// --- Random texts ----------------------------------------------------------

struct Element {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<Element> children;

  bool operator==(const Element&) const = default;
};

Element read(const std::vector<btcpp::XmlElement>& all, std::size_t at) {
  Element element{all[at].name, {}, {}};
  for (const auto& each : all[at].attributes) {
    element.attributes.emplace_back(each.name, each.value);
  }
  for (const std::size_t child : all[at].children) {
    element.children.push_back(read(all, child));
  }
  return element;
}

class RandomXml {
 public:
  explicit RandomXml(unsigned seed) : random_(seed) {}

  std::string text() {
    nodes_left_ = 12;
    return "<?xml version=\"1.0\"?>\n" + filler(0) + element(0) + "\n";
  }
  int below(int count) {
    return std::uniform_int_distribution<int>(0, count - 1)(random_);
  }

 private:
  std::string element(int depth) {
    const std::string name(1, static_cast<char>('A' + below(5)));
    std::string text = "<" + name;
    for (const char* attribute : {"x", "yy", "z"}) {
      if (below(3) > 0) continue;
      static constexpr const char* kValues[] = {
          "\"1\"", "'a > b'", "\"it's &lt;\"", "'\"'", "\"</A>\"", "\"<!--\""};
      const char* gap = below(4) == 0 ? "\n    " : " ";
      text += gap + std::string(attribute) + "=" + kValues[below(6)];
    }
    const int children = depth > 3 ? 0 : below(4);
    if (children == 0 && below(2) == 0) return text + (below(2) ? "/>" : " />");
    text += ">";
    for (int i = 0; i < children && nodes_left_ > 0; ++i) {
      --nodes_left_;
      text += filler(depth + 1) + element(depth + 1);
    }
    return text + filler(depth) + "</" + name + ">";
  }

  std::string filler(int depth) {
    static constexpr const char* kOthers[] = {
        "", "", "<!-- <A x=\"> -->", "<!-- </A> -->", "<![CDATA[<B></B>]]>"};
    const std::string what = depth == 0 ? "" : kOthers[below(5)];
    if (below(3) == 0) return what;
    return what + "\n" + std::string(static_cast<std::size_t>(2 * depth), ' ');
  }

  std::mt19937 random_;
  int nodes_left_ = 0;
};

// An element and the way to it.
struct Found {
  Element* element;
  Element* parent;
  std::size_t place;  // among the children of `parent`
};
void list(Element& at, Element* parent, std::size_t place,
          std::vector<Found>& found) {
  found.push_back({&at, parent, place});
  for (std::size_t i = 0; i < at.children.size(); ++i) {
    list(at.children[i], &at, i, found);
  }
}

TEST_CASE("random XML: what is read after an edit is what was meant") {
  int edits = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    RandomXml random(seed);
    const std::string text = random.text();
    const btcpp::ParsedXml before(text);
    INFO(text);
    REQUIRE(before.value);
    Element meant = read(*before.value, 0);
    std::vector<Found> all;
    list(meant, nullptr, 0, all);
    const auto number =
        static_cast<std::size_t>(random.below(static_cast<int>(all.size())));
    const auto& span = (*before.value)[number].span;
    const SourcePlace place{"t.xml", span.line, span.column};
    const auto& [element, parent, index] = all[number];
    Repair repair;
    switch (random.below(5)) {
      case 0: {
        repair = {SetAttribute{place, "yy", "1 < 2 & \"'"}};
        const auto there = std::ranges::find_if(
            element->attributes, [](const auto& a) { return a.first == "yy"; });
        if (there != element->attributes.end()) {
          there->second = "1 < 2 & \"'";
        } else {
          element->attributes.emplace_back("yy", "1 < 2 & \"'");
        }
        break;
      }
      case 1:
        repair = {ChangeType{place, "Longer"}};
        element->name = "Longer";
        break;
      case 2: {
        if (parent == nullptr) continue;
        repair = {WrapNodes{place, place, {"W"}, {{"V"}}}};
        Element wrapped{"W", {}, {Element{"V", {}, {}}, *element}};
        *element = std::move(wrapped);
        break;
      }
      case 3: {
        if (parent == nullptr || element->children.empty()) continue;
        repair = {UnwrapNode{place}};
        const std::vector<Element> inside = element->children;
        auto& siblings = parent->children;
        siblings.erase(siblings.begin() + static_cast<std::ptrdiff_t>(index));
        siblings.insert(siblings.begin() + static_cast<std::ptrdiff_t>(index),
                        inside.begin(), inside.end());
        break;
      }
      default: {
        if (parent == nullptr || index == 0) continue;
        const auto& first =
            (*before.value)[(*before.value)[(*before.value)[number].parent]
                                .children[0]];
        repair = {
            MoveBefore{place, {"t.xml", first.span.line, first.span.column}}};
        auto& siblings = parent->children;
        std::rotate(siblings.begin(),
                    siblings.begin() + static_cast<std::ptrdiff_t>(index),
                    siblings.begin() + static_cast<std::ptrdiff_t>(index) + 1);
      }
    }
    const std::string changed = edited("t.xml", text, repair);
    INFO(changed);
    const btcpp::ParsedXml after(changed);
    REQUIRE(after.value);
    CHECK(read(*after.value, 0) == meant);
    ++edits;
  }
  CHECK(edits > 1500);
}

TEST_CASE("a contract says one thing more") {
  const auto with = [](std::string_view text, NodeType leaf, std::string name,
                       std::string keyword, std::string value) {
    return with_clause(
        text, {leaf, std::move(name), std::move(keyword), std::move(value)});
  };
  const NodeType action = NodeType::Action;
  CHECK(with("", action, "Drive", "may-be-lost", "") ==
        "(defaction Drive :may-be-lost)\n");
  CHECK(with("; mine", action, "\"a b\"", "may-stay", "no") ==
        "; mine\n(defaction \"a b\" :may-stay no)\n");
  // In the contract that is there, whatever stands around it.
  const std::string text =
      "; (defaction Drive)\n"
      "(defcondition Drive :asked-once)\n"
      "(DefAction \"Drive\" ; ours\n  :returns (success running)\n"
      "  ; the end\n)\n(defaction Other)\n";
  CHECK(with(text, action, "Drive", "idempotent", "") ==
        "; (defaction Drive)\n"
        "(defcondition Drive :asked-once)\n"
        "(DefAction \"Drive\" ; ours\n  :returns (success running)\n"
        "  ; the end\n :idempotent)\n(defaction Other)\n");
  // What was said otherwise is replaced, and a list has more in it.
  CHECK(with("(defaction A :may-stay no :idempotent)", action, "A", "may-stay",
             "") == "(defaction A :may-stay :idempotent)");
  CHECK(with("(defaction A :may-stay :idempotent)", action, "A", "may-stay",
             "no") == "(defaction A :may-stay no :idempotent)");
  CHECK(with("(defaction A :returns (success running))", action, "A", "returns",
             "(success)") == "(defaction A :returns (success))");
  const NodeType condition = NodeType::Condition;
  CHECK(with("(defcondition C :holds-while A)", condition, "C", "holds-while",
             "(A \"b c\")") == "(defcondition C :holds-while (A \"b c\"))");
  CHECK(with("(defcondition C :holds-while (A ; a\n B) :asked-once)", condition,
             "C", "holds-while",
             "(B D)") == "(defcondition C :holds-while (A B D) :asked-once)");
}

}  // namespace

}  // namespace btcheck::edits_test
