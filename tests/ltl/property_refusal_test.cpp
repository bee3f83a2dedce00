// SPDX-License-Identifier: MIT
//
// What a property file may not say, and what its author is told.
#include <vector>

#include "ltl/property_text.hpp"

namespace btcheck::test::property_refusal_test {
namespace {

struct Mistake {
  std::string what;
  std::string text;
  std::string shown;
};

TEST_CASE("the commonest mistakes are answered word for word") {
  const std::vector<Mistake> rows = {
      {"an unknown word at the start of a body", "property a: nevr x.ticked\n",
       R"(error[BT1212]: `nevr` alone is not a condition
  --> p.ltl:1:13
  |
1 | property a: nevr x.ticked
  |             ^^^^ what about it?
  |
  = help: did you mean `never`?
)"},
      {"a node without an event", "prove always land\n",
       R"(error[BT1212]: `land` alone is not a condition
  --> p.ltl:1:14
  |
1 | prove always land
  |              ^^^^ what about it?
  |
  = help: a node has events behind its name, such as `.ticked`; a variable is compared with something
)"},
      {"a mistyped event", "prove fail/land.tickd\n",
       R"(error[BT1213]: `tickd` is not an event
  --> p.ltl:1:17
  |
1 | prove fail/land.tickd
  |                 ^^^^^ a node has no such event
  |
  = help: did you mean `ticked`?
)"},
      {"a mix of until and and", "prove a.done U b.done and c.done\n",
       R"(error[BT1205]: `U` and `and` need parentheses
  --> p.ltl:1:23
  |
1 | prove a.done U b.done and c.done
  |                       ^^^ tools disagree on what this means
  |
  = help: write `(a.done U b.done) and c.done` or `a.done U (b.done and c.done)`
)"},
      {"a chain of implications", "prove a.done -> b.done -> c.done\n",
       R"(error[BT1205]: a chain of `->` needs parentheses
  --> p.ltl:1:24
  |
1 | prove a.done -> b.done -> c.done
  |                        ^^ tools disagree on what this means
  |
  = help: write `(a.done -> b.done) -> c.done` or `a.done -> (b.done -> c.done)`
)"},
      {"a parenthesis that stays open",
       "prove (a.done and b.done\nprove <> dead\n",
       R"(error[BT1201]: this parenthesis is never closed
  --> p.ltl:1:7
  |
1 | prove (a.done and b.done
  |       ^ no `)` before `prove`
)"},
      {"a temporal operator in a state form", "prove never <> a.done\n",
       R"(error[BT1214]: `never` takes a condition on single states
  --> p.ltl:1:13
  |
1 | prove never <> a.done
  |             ^^ `<>` speaks of more than one state
  |
  = help: write the property as LTL: `ltl ...`
)"},
      {"a bound without a unit",
       "prove a.done leadsto b.done within 2\nprove <> dead\n",
       R"(error[BT1201]: a bound counts ticks
  --> p.ltl:1:37
  |
1 | prove a.done leadsto b.done within 2
  |                                     ^ expected `ticks`
  |
  = help: write `within 2 ticks`
)"},
      {"an interval that ends before it begins",
       "prove a.done leadsto b.done within [3,1]\n",
       R"(error[BT1215]: this interval is empty
  --> p.ltl:1:36
  |
1 | prove a.done leadsto b.done within [3,1]
  |                                    ^^^^^ it ends before it begins
  |
  = help: write `[1,3]`
)"},
      {"a half-open interval without a whole number in it",
       "prove a.done leadsto b.done within ]1,2[\n",
       R"(error[BT1215]: this interval is empty
  --> p.ltl:1:36
  |
1 | prove a.done leadsto b.done within ]1,2[
  |                                    ^^^^^ no whole number lies in it
)"},
      {"an operator used as a name", "prove X.done\n",
       R"(error[BT1221]: `X` is an operator, not a name
  --> p.ltl:1:7
  |
1 | prove X.done
  |       ^
  |
  = help: write a name that looks like it in double quotes: `"X"`
)"},
      {"a let used too early", "prove crit\nlet crit = battery == Critical\n",
       R"(error[BT1216]: `crit` is used before its `let`
  --> p.ltl:1:7
  |
1 | prove crit
  |       ^^^^
  |
  = help: move the `let` of line 2 above this line
)"},
      {"a let defined twice", "let b = x.done\nlet b = x.done\n",
       R"(error[BT1216]: `b` is defined twice
  --> p.ltl:2:5
  |
2 | let b = x.done
  |     ^
  |
  = help: line 1 defines it already; choose another name
)"},
      {"a scope without a pattern", "prove <> a.done after b.done\n",
       R"(error[BT1222]: a scope belongs to a pattern
  --> p.ltl:1:17
  |
1 | prove <> a.done after b.done
  |                 ^^^^^ of what?
  |
  = help: write `always <> a.done`, or `present`, `absent`, and the scope
)"},
      {"a scope that has no clear ends",
       "prove absent a.done between b.done and c.done and tick\n",
       R"(error[BT1205]: the ends of `between ... and ...` need parentheses
  --> p.ltl:1:40
  |
1 | prove absent a.done between b.done and c.done and tick
  |                                        ^^^^^^^^^^^^^^^ where does the first end?
  |
  = help: write `(c.done and tick)`
)"},
      {"linear and branching time mixed", "prove AG <> a.done\n",
       R"(error[BT1223]: branching and linear time are mixed
  --> p.ltl:1:7
  |
1 | prove AG <> a.done
  |       ^^^^^^^^^^^^ each X, F, G, U, W, R needs an A or E in front of it
  |
  = help: write for instance `AG EF P` or `A [P U Q]`
)"},
      {"a time where a pattern takes none",
       "prove a.done precedes b.done within [0,2]\n",
       R"(error[BT1222]: this pattern takes no time
  --> p.ltl:1:37
  |
1 | prove a.done precedes b.done within [0,2]
  |                                     ^^^^^
  |
  = help: docs/properties.md lists the patterns with their times
)"},
      {"a part without a word", "prove a.done => <> b.done\n",
       R"(warning[BT1226]: a part of this speaks of the first state only
  --> p.ltl:1:7
  |
1 | prove a.done => <> b.done
  |       ^^^^^^^^^^^^^^^^^^^ no temporal operator stands above it
  |
  = help: write `[] (a.done => <> b.done)` if it must always hold
)"},
      {"the precedence trap in branching time",
       "prove AG a.done => AF b.done\n",
       R"(warning[BT1203]: `AG` does not cover the `=>` behind it
  --> p.ltl:1:7
  |
1 | prove AG a.done => AF b.done
  |       ^^^^^^^^^ all that it covers
  |
  = help: write `AG (a.done => AF b.done)` to cover it,
          or `(AG a.done) => AF b.done` to keep this reading
)"},
      {"a condition without a word", "prove a.done\n",
       R"(warning[BT1226]: this speaks of the first state only
  --> p.ltl:1:7
  |
1 | prove a.done
  |       ^^^^^^ no word says when it must hold
  |
  = help: write `always a.done`, `never a.done` or `eventually a.done`
)"},
      {"a quote that stays open", "prove \"abc\n",
       R"(error[BT1207]: this name is never closed
  --> p.ltl:1:7
  |
1 | prove "abc
  |       ^^^^ no second `"` on the line
  |
  = help: close it with `"`
)"},
      {"a keyword with a typo between conditions",
       "prove a.done leadto b.done\n",
       R"(error[BT1201]: `leadto` cannot follow a complete condition
  --> p.ltl:1:14
  |
1 | prove a.done leadto b.done
  |              ^^^^^^ expected an operator or the end of the property
  |
  = help: did you mean `leadsto`?
)"},
      {"a formula without a property", "[] (a.done => b.done)\n",
       R"(error[BT1201]: `[]` begins no item
  --> p.ltl:1:1
  |
1 | [] (a.done => b.done)
  | ^^ expected `property`, `prove`, `let` and so on
  |
  = help: a formula stands behind `prove` or `property NAME:`
)"},
      {"not equal written as in other languages", "prove fls <> 3\n",
       R"(error[BT1212]: `fls` alone is not a condition
  --> p.ltl:1:7
  |
1 | prove fls <> 3
  |       ^^^ what about it?
  |
  = help: `<>` means eventually; not equal is written `~=` or `!=`
)"},
      {"the precedence trap", "prove [] a.done => <> b.done\n",
       R"(warning[BT1203]: `[]` does not cover the `=>` behind it
  --> p.ltl:1:7
  |
1 | prove [] a.done => <> b.done
  |       ^^^^^^^^^ all that it covers
  |
  = help: write `[] (a.done => <> b.done)` to cover it,
          or `([] a.done) => <> b.done` to keep this reading
)"},
      {"the precedence trap in words", "prove always a.done => b.done\n",
       R"(warning[BT1203]: `always` covers this `=>`, which `[]` would not
  --> p.ltl:1:21
  |
1 | prove always a.done => b.done
  |                     ^^ read as `always (...)`
  |
  = help: write `always (a.done => b.done)` to keep this reading,
          or `([] a.done) => b.done` for the other one
)"},
      {"the next operator", "prove X a.done\n",
       R"(warning[BT1204]: `X` speaks of a single step of the composed automata
  --> p.ltl:1:7
  |
1 | prove X a.done
  |       ^ any node may take that step
  |
  = help: name the event that is waited for, as in `P leadsto Q`
)"},
      {"a repeated name", "property p: <> dead\nproperty p: <> tick\n",
       R"(warning[BT1202]: `p` names a property already
  --> p.ltl:2:10
  |
2 | property p: <> tick
  |          ^ reports call this one `p#2`
  |
  = help: the first one stands on line 1
)"},
      {"an empty file", "",
       R"(error[BT1220]: no property in this file
  --> p.ltl
  = help: write one: `property NAME: never some_node.failure`
)"},
  };
  for (const Mistake& row : rows) {
    CAPTURE(row.what);
    CHECK(findings(row.text) == row.shown);
  }
}

TEST_CASE("a mix of U, W, R with another operator is refused in every order") {
  for (const std::string body :
       {"a.done U b.done and tick", "a.done and b.done U tick",
        "a.done or b.done W tick", "a.done R b.done or tick",
        "a.done => b.done U tick", "a.done U b.done => tick",
        "a.done U b.done U tick", "a.done U b.done W tick",
        "a.done <=> b.done U tick", "a.done V b.done <=> tick",
        "[] a.done U b.done or tick", "a.done until b.done release tick",
        "a.done => b.done => tick", "a.done => b.done and tick => dead"}) {
    CAPTURE(body);
    CHECK(codes("prove " + body) == "BT1205");
  }
}

TEST_CASE("`[] P => Q` is warned about, however it is written") {
  for (const std::string body :
       {"[] a.done => <> b.done", "G a.done -> b.done",
        "[] a.done and b.done => tick", "ltl ([] (a.done) => tick)",
        "[] a.done <=> tick", "always a.done => b.done",
        "always eventually a.done => b.done"}) {
    CAPTURE(body);
    CHECK(codes("prove " + body) == "BT1203");
  }
  for (const std::string body :
       {"ltl ([] a.done) => b.done", "[] (a.done => b.done)",
        "[] <> a.done => [] <> b.done", "G F a.done => G F b.done",
        "ltl not [] a.done => b.done", "ltl a.done => [] b.done",
        "always (a.done => b.done)", "never a.done => b.done"}) {
    CAPTURE(body);
    CHECK(codes("prove " + body) == "");
  }
  CHECK(proves("always a.done => b.done") == "invariant: a.done => b.done");
}

TEST_CASE("X is accepted with one warning per property") {
  CHECK(codes("prove X a.done => () b.done\nprove X dead") == "BT1204 BT1204");
}

TEST_CASE("a scope or a time in the wrong place is refused") {
  for (const std::string body :
       {"eventually always a.done after b.done", "mortal a.done before b.done",
        "deadlockfree within [0,2]", "possible a.done after b.done",
        "globally a.done", "ltl a.done after b.done", "live a.done before tick",
        "never a.done after b.done before tick",
        "never a.done within 2 ticks for 3",
        "a.done before b.done within [0,1]", "present a.done for 3",
        "absent a.done lasting 3", "present a.done lasting 0",
        "present a.done lasting 2 after b.done",
        "present a.done between b.done and tick within [0,3]",
        "absent a.done before b.done within [0,2]",
        "absent a.done before b.done for 0",
        "a.done leadsto b.done between tick and dead within [0,1]",
        "a.done forbids b.done before tick within [0,1]"}) {
    CAPTURE(body);
    CHECK(codes("prove " + body) == "BT1222");
    CHECK(!read("prove " + body).value.has_value());
  }
  CHECK(codes("prove present first a.done") == "BT1201");
  CHECK(codes("prove a.done leadsto first b.done") == "BT1201");
  CHECK(codes("prove a.done causes b.done") == "BT1201");
  CHECK(codes("prove after b.done always a.done") == "BT1201");
  CHECK(codes("prove absentAfter a.done") == "BT1201");
  CHECK(codes("prove absentAfter (a.done, b.done") == "BT1201");
}

TEST_CASE("Fiacre's tags and port events are known, and that trees have none") {
  CHECK(codes("prove drone/5/event e") == "BT1224");
  CHECK(codes("prove never drone/5/tag t") == "BT1224");
}

TEST_CASE("an assumption speaks of runs") {
  CHECK(codes("assume possible a.done\nprove <> a.done") == "BT1225");
  CHECK(codes("assume AG EF a.done\nprove <> a.done") == "BT1225");
  CHECK(codes("assume every action eventually\nprove <> a.done") == "BT1201");
  CHECK(codes("assume every action runs\nprove <> a.done") == "BT1201");
}

TEST_CASE("the words of patterns are names where they go on as names") {
  CHECK(atom_of("enter.ticked").node == "enter");
  CHECK(atom_of("live.ticked").node == "live");
  CHECK(atom_of("before.ticked").node == "before");
  CHECK(atom_of("AG.ticked").node == "AG");
  CHECK(atom_of("A == 3").left.name == "A");
  CHECK(proves("a.done leadsto first.ticked") ==
        "ltl: [] (a.done => <> first.ticked)");
}

TEST_CASE("one mistake is one error") {
  const std::vector<Row> rows = {
      {"", "BT1220"},
      {"# only a comment\n", "BT1220"},
      {"tree \"a.btf\"\n", "BT1220"},
      {"prove", "BT1201"},
      {"prove a.done and", "BT1201"},
      {"prove and a.done", "BT1201"},
      {"prove (a.done", "BT1201"},
      {"prove a.done)", "BT1201"},
      {"prove a.done b.done", "BT1201"},
      {"prove ()", "BT1201"},
      {"prove a.", "BT1201"},
      {"prove a/b", "BT1212"},
      {"prove a/b == 3", "BT1212"},
      {"prove a@.done", "BT1201"},
      {"prove land", "BT1212"},
      {"prove \"land\"", "BT1212"},
      {"prove land-now.ticked", "BT1212"},
      {"prove land.tick", "BT1213"},
      {"prove land.tick_node", "BT1213"},
      {"prove land.status", "BT1213"},
      {"prove 3", "BT1201"},
      {"prove 3 = 4", "BT1201"},
      {"prove 0 < fls < 3", "BT1201"},
      {"prove fls = ", "BT1201"},
      {"prove fls in 3", "BT1201"},
      {"prove fls in 3..1", "BT1209"},
      {"prove fls <> 3", "BT1212"},
      {"prove fls % 2 > 3", "BT1208"},
      {"prove fls + 1", "BT1212"},
      {"prove fls + > 3", "BT1201"},
      {"prove 1 + 2 > 3", "BT1201"},
      {"prove (fls + 1 > 3", "BT1201"},
      {"prove fls * (2 > 3", "BT1201"},
      {"prove a.done and b.done since c.done", "BT1205"},
      {"prove a.done since b.done since c.done", "BT1205"},
      {"prove once <> a.done", "BT1214"},
      {"prove previously enter a.done", "BT1214"},
      {"prove once", "BT1201"},
      {"prove fls > 2147483648", "BT1209"},
      {"prove fls > 99999999999999999999999999", "BT1209"},
      {"prove x@99999999999.done", "BT1209"},
      {"prove drone/99999999999/state done", "BT1209"},
      {"prove drone/99999999999/value (a = 1)", "BT1209"},
      {"prove drone/5/state", "BT1201"},
      {"prove drone/5/stat done", "BT1201"},
      {"prove drone/5/value a = 1", "BT1201"},
      {"prove drone/5/value (tick)", "BT1212"},
      {"prove drone/5/value (drone/6/state done)", "BT1201"},
      {"prove drone/5/value ([] a = 1)", "BT1214"},
      {"prove btnode[].rstatus = success", "BT1201"},
      {"prove btnode[a] = success", "BT1201"},
      {"prove never [] a.done", "BT1214"},
      {"prove possible X a.done", "BT1214"},
      {"let a = <> b.done\nprove a", "BT1214"},
      {"prove <> a.done leadsto b.done within 1 tick", "BT1214"},
      {"prove a.done leadsto [] b.done within 1 tick", "BT1214"},
      {"prove whenever a.done", "BT1201"},
      {"prove whenever a.done b.done", "BT1201"},
      {"prove a.done within 2 ticks", "BT1201"},
      {"prove a.done leadsto b.done within", "BT1201"},
      {"prove a.done leadsto b.done within 2", "BT1201"},
      {"prove a.done leadsto b.done within 2 ms", "BT1201"},
      {"prove a.done leadsto b.done within [0.5,1]", "BT1201"},
      {"prove a.done leadsto b.done within [2,1]", "BT1215"},
      {"prove a.done leadsto b.done within [-1,1]", "BT1215"},
      {"prove a.done leadsto b.done within 1000001 ticks", "BT1215"},
      {"prove a.done leadsto b.done within []", "BT1201"},
      {"prove a.done => always b.done", "BT1201"},
      {"prove GF a.done", "BT1201"},
      {"prove F.done", "BT1221"},
      {"prove G == 3", "BT1221"},
      {"prove and.done", "BT1221"},
      {"prove T.done", "BT1221"},
      {"property not: a.done", "BT1221"},
      {"property prove: a.done", "BT1221"},
      {"let U = a.done\nprove U", "BT1221 BT1201"},
      {"property : a.done", "BT1201"},
      {"property a a.done", "BT1201"},
      {"property a-b: a.done", "BT1201"},
      {"property a [] : a.done", "BT1201"},
      {"property a [x, : a.done", "BT1201"},
      {"property a expect maybe: a.done", "BT1201"},
      {"expect\nprove a.done", "BT1201"},
      {"expect holds", "BT1217"},
      {"expect holds\nexpect holds\nprove a.done", "BT1217"},
      {"expect holds\nproperty a expect violated: a.done", "BT1217"},
      {"tree a.btf\nprove a.done", "BT1201"},
      {"tree \"a\" tree \"b\" prove a.done", "BT1218"},
      {"tick all\nprove a.done", "BT1218"},
      {"tick root\ntick root\nprove a.done", "BT1218"},
      {"assert b\nproperty a: tick", "BT1219"},
      {"assert never a.done\nprove a.done", "BT1201"},
      {"let a = b\nlet b = x.done\nprove a", "BT1216"},
      {"let a = a\nprove dead", "BT1216"},
      {"let a = x.done\nlet a = y.done\nprove a", "BT1216"},
      {"let a x.done\nprove dead", "BT1201"},
      {"let a = x.done y.done\nprove a", "BT1201"},
      {"hello\nprove dead", "BT1201"},
      {"[] (a.done => b.done)", "BT1201"},
      {"prove \"a.done", "BT1207"},
      {"prove \"\".done", "BT1207"},
      {"prove a.done /* never closed", "BT1207"},
      {"prove a.done & b.done", "BT1208"},
      {"prove $a = 3", "BT1208"},
      {std::string("prove a.done\0", 13), "BT1000"},
      {"prove \xFF.done", "BT1000"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    CHECK(codes(row.text) == row.expected);
    CHECK(!read(row.text).value.has_value());
  }
}

TEST_CASE("one run shows the errors of every item") {
  CHECK(codes("property a: land\n"
              "property b: (x.done\n"
              "  and y.done\n"
              "let c = \n"
              "prove x.tickd\n"
              "expect sometimes\n"
              "tick twice\n"
              "assume x\n"
              "tree 3\n"
              "assert 3\n") ==
        "BT1212 BT1201 BT1201 BT1213 BT1201 BT1218 BT1212 BT1201 BT1201");
}

TEST_CASE("a let that was dropped for an error makes no second one") {
  CHECK(codes("let a = land\nprove never a\nprove a and x.done") == "BT1212");
}

TEST_CASE("no more than twenty errors are shown") {
  std::string text;
  for (int i = 0; i < 50; ++i) text += "prove land\n";
  CHECK(read(text).diagnostics.size() == 20);
}

TEST_CASE("nesting, size and the number of conditions have limits") {
  const auto nested = [](int depth) {
    return "prove ltl " + std::string(depth, '(') + "a.done" +
           std::string(depth, ')');
  };
  CHECK(codes(nested(500)) == "");
  CHECK(codes(nested(501)) == "BT1210");
  CHECK(codes(nested(10000)) == "BT1210");
  CHECK(codes("prove " + std::string(100000, '-') + "a.done") == "BT1210");

  std::string doubling = "let l0 = a.done\n";
  for (int i = 0; i < 64; ++i) {
    const std::string name = "l" + std::to_string(i);
    doubling +=
        "let l" + std::to_string(i + 1) + " = " + name + " and " + name + "\n";
  }
  CHECK(codes(doubling + "prove l64") == "BT1210");

  std::string atoms = "prove ltl tick";
  for (int i = 1; i < 64; ++i) atoms += " or a@" + std::to_string(i) + ".done";
  CHECK(codes(atoms) == "");
  CHECK(codes(atoms + " or b.done") == "BT1211");

  CHECK(codes(std::string((4u << 20) + 1, ' ')) == "BT1210");
}

}  // namespace
}  // namespace btcheck::test::property_refusal_test
