// SPDX-License-Identifier: MIT
//
// What the style is, language by language, to the letter.
#include "style/style.hpp"

#include <doctest/doctest.h>

#include <string>

#include "text/diagnostic.hpp"

namespace btcheck {
namespace style_test {
namespace {

std::string styled_text(const std::string& name, const std::string& text) {
  const Result<std::string> once = styled({name, text});
  for (const Diagnostic& each : once.diagnostics) MESSAGE(render(each));
  REQUIRE(once.value.has_value());
  const Result<std::string> twice = styled({name, *once.value});
  REQUIRE(twice.value.has_value());
  CHECK(*twice.value == *once.value);
  return *once.value;
}

std::string xml(const std::string& text) { return styled_text("t.xml", text); }
std::string btf(const std::string& text) { return styled_text("t.btf", text); }
std::string ltl(const std::string& text) { return styled_text("t.ltl", text); }

std::string code_of(const std::string& name, const std::string& text) {
  const Result<std::string> result = styled({name, text});
  CHECK_FALSE(result.value.has_value());
  REQUIRE(result.diagnostics.size() > 0);
  CHECK(result.diagnostics[0].severity == Severity::Error);
  return result.diagnostics[0].code;
}

}  // namespace

TEST_CASE("xml: a tag has a line of its own, and two blanks for each level") {
  CHECK(xml("<root BTCPP_format='4'><BehaviorTree ID=\"a\"><Sequence>\n"
            "\t\t<Fallback>  <AlwaysSuccess   /></Fallback><A></A >"
            "</Sequence></BehaviorTree></root>") ==
        R"(<root BTCPP_format="4">
  <BehaviorTree ID="a">
    <Sequence>
      <Fallback>
        <AlwaysSuccess/>
      </Fallback>
      <A></A>
    </Sequence>
  </BehaviorTree>
</root>
)");
}

TEST_CASE("xml: attributes are ordered by what is known of the type") {
  const auto node = [](const std::string& tag) {
    const std::string text =
        xml("<root BTCPP_format=\"4\"><BehaviorTree ID=\"t\">" + tag +
            "</BehaviorTree><TreeNodesModel><Action ID=\"Mine\"><input_port "
            "name=\"b\"/><output_port name=\"a\"/></Action></TreeNodesModel>"
            "</root>");
    const std::size_t begin = text.find("    <") + 4;
    return text.substr(begin, text.find('\n', begin) - begin);
  };
  CHECK(node("<ClearEntireCostmap service_name='s' zz='1' name='n'/>") ==
        "<ClearEntireCostmap name=\"n\" service_name=\"s\" zz=\"1\"/>");
  CHECK(node("<SetBlackboard output_key='k' value='v'/>") ==
        "<SetBlackboard value=\"v\" output_key=\"k\"/>");
  CHECK(node("<Mine z='1' _onSuccess='x:=1' a='1' y='2' _skipIf='q' _d='' "
             "b='2' _failureIf='p' name='m'/>") ==
        "<Mine name=\"m\" b=\"2\" a=\"1\" z=\"1\" y=\"2\" _failureIf=\"p\" "
        "_skipIf=\"q\" _onSuccess=\"x:=1\" _d=\"\"/>");
  CHECK(node("<Action a='1' b='2' ID='Mine'/>") ==
        "<Action ID=\"Mine\" b=\"2\" a=\"1\"/>");
  CHECK(node("<SubTree y='1' _autoremap='true' x='2' ID='u'/>") ==
        "<SubTree ID=\"u\" y=\"1\" x=\"2\" _autoremap=\"true\"/>");
}

TEST_CASE("xml: values stay as they are written, quotes where they can") {
  CHECK(xml("<r a='say \"hi\"' b='&lt;&apos;&#10;' c =\n \"it's\"/>") ==
        "<r a='say \"hi\"' b=\"&lt;&apos;&#10;\" c=\"it's\"/>\n");
  CHECK(xml("<r a = \"x := 1;\n     y := 2\" b=\"1\"/>") ==
        "<r a=\"x := 1;\n     y := 2\"\n   b=\"1\"/>\n");
}

TEST_CASE("xml: a long tag has one attribute a line") {
  const std::string value(38, 'v');
  CHECK(xml("<r><Node a=\"" + value + "\" b=\"" + value + "\" c=\"\"/></r>") ==
        "<r>\n  <Node a=\"" + value + "\" b=\"" + value +
            "\" c=\"\"/>\n</r>\n");
  CHECK(xml("<r><Node a=\"" + value + "\" b=\"" + value + "\" c=\"1\"/></r>")
            .find("<Node a=\"" + value + "\"\n        b=\"") !=
        std::string::npos);
}

TEST_CASE("xml: comments, texts and what stands around the root are kept") {
  CHECK(xml("\n<?xml version='1.0'?><!-- head -->\n\n\n\n<root><!-- in -->\n\n"
            "\n<a/><!--\n   two\nlines -->\n<b> text <c  d='1'/> </b>\n"
            "<e><![CDATA[ <x ]]></e><f> </f>\n\n</root><!-- tail -->\n"
            "  <second  />") ==
        R"(<?xml version='1.0'?> <!-- head -->

<root> <!-- in -->

  <a/> <!--
   two
lines -->
  <b> text <c  d='1'/> </b>
  <e><![CDATA[ <x ]]></e>
  <f></f>

</root> <!-- tail -->
<second  />
)");
}

TEST_CASE("line ends, a byte order mark and the last line") {
  CHECK(xml("\xEF\xBB\xBF<r>\r\n<a/></r>\r\n\r\n") ==
        "\xEF\xBB\xBF<r>\r\n  <a/>\r\n</r>\r\n");
  CHECK(btf("\xEF\xBB\xBF(defsv x :max 3)  ; c \r\n") ==
        "\xEF\xBB\xBF(defsv x :max 3)  ; c\r\n");
  CHECK(ltl("\xEF\xBB\xBFprove dead\r\n\r\n\r\nprove  dead") ==
        "\xEF\xBB\xBFprove dead\r\n\r\nprove dead\r\n");
}

TEST_CASE("xml: what a comment allows stays allowed, and nothing else") {
  const std::string wide = "x=\"" + std::string(90, 'x') + "\"";
  // The tag keeps its line, however long it is.
  CHECK(
      xml("<r>\n<a " + wide + " y=''/> <!-- btcheck: allow BT2208 -->\n</r>") ==
      "<r>\n  <a " + wide + " y=\"\"/> <!-- btcheck: allow BT2208 -->\n</r>\n");
  // Or its lines.
  CHECK(xml("<r>\n<!-- btcheck: allow BT2208 -->\n<a x=''\n  y=''/></r>") ==
        "<r>\n  <!-- btcheck: allow BT2208 -->\n  <a x=''\n  y=''/>\n</r>\n");
  CHECK(code_of("t.xml", "<r><a/><b/> <!-- btcheck: allow BT2208 --></r>") ==
        "BT0013");
}

TEST_CASE("btf: two blanks for each level, below the list around it") {
  CHECK(btf("((defsv x\n:max 3)\n\n\n (BehaviorTree :name t\n(Sequence (Action "
            ":ID a)\n   (Eval  (and (= x 1)\n (= x 2)))))\n)") ==
        R"(((defsv x
  :max 3)

(BehaviorTree :name t
  (Sequence
    (Action :ID a)
    (Eval (and (= x 1)
               (= x 2))))))
)");
}

TEST_CASE("btf: a list that fits stays in its line, a longer one is broken") {
  CHECK(btf("(BehaviorTree (Repeat :repeat 3 (Action)))(Trees t)") ==
        "(BehaviorTree (Repeat :repeat 3 (Action)))\n(Trees t)\n");
  CHECK(btf("(BehaviorTree :name t (Sequence :name sequence (Action :ID "
            "a_long_name_of_an_action_1) (Action :ID b :args (one \"value of "
            "one\" two \"value of two\" three \"value of three\"))))") ==
        R"((BehaviorTree :name t
  (Sequence :name sequence
    (Action :ID a_long_name_of_an_action_1)
    (Action :ID b :args (one "value of one" two "value of two" three "value of three"))))
)");
  CHECK(btf("(BehaviorTree (Action :ID b :args (one \"value of one\" two "
            "\"value of two\" three \"value of three\" four \"value of "
            "four\")))") ==
        R"((BehaviorTree
  (Action :ID b
    :args (one "value of one" two "value of two" three "value of three" four "value of four")))
)");
}

TEST_CASE("btf: comments keep their lines, and their columns") {
  CHECK(btf("(                ; head\n   ; alone\n (defsv x  ; x\n :max  ; a "
            "number\n 3 ; last\n ))\n; behind") ==
        R"((                ; head
; alone
(defsv x   ; x
  :max ; a number
  3 ; last
))
; behind
)");
}

TEST_CASE("rules: lines are the author's") {
  CHECK(ltl("##  A title\nproperty  p [ safety,req=SR-12 ]  expect holds :\n"
            "  always  ( a.ticked=>b.done )\n     and x==1 # why\n\n\n\nlet "
            "low=battery== Low\n") ==
        R"(##  A title
property p [ safety,req=SR-12 ] expect holds :
    always (a.ticked => b.done)
       and x == 1 # why

let low = battery == Low
)");
}

TEST_CASE("what cannot be read is told, with its place") {
  CHECK(code_of("t.xml", "<root><a></root>") == "BT1600");
  CHECK(code_of("t.btf", "(BehaviorTree (Sequence)") == "BT1001");
  CHECK(code_of("t.leaves", "(defaction a) )") == "BT1001");
  CHECK(code_of("t.ltl", "property p never dead") == "BT1201");
  CHECK(code_of("t.yaml", "a: 1") == "BT1652");
}

}  // namespace style_test
}  // namespace btcheck
