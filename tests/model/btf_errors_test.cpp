// SPDX-License-Identifier: MIT
//
// What the .btf reader says about mistakes, to the letter.
#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "btf_text.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf_errors_test {
namespace {

struct Mistake {
  std::string_view what;
  std::string_view text;
  std::string_view shown;
};

constexpr Mistake kMistakes[] = {
    {"a surplus parenthesis closes nothing",
     R"((BehaviorTree (Action)))
)",
     R"(error[BT1001]: this `)` closes nothing
  --> t.btf:1:24
  |
1 | (BehaviorTree (Action)))
  |                        ^ every `(` before it is closed already
  |
  = help: delete it, or look for one too many before it
)"},

    {"a missing parenthesis is seen at the next form",
     R"((BehaviorTree :name a
 (Sequence (Action :ID x)
  (Action :ID y)
(defsv fls :max 3)
)",
     R"(error[BT1001]: `(BehaviorTree` is never closed
  --> t.btf:1:1
  |
1 | (BehaviorTree :name a
  | ^ opened here
  |
  = help: 2 `)` are missing before line 4
)"},

    {"a missing parenthesis is seen at the end",
     R"(((BehaviorTree (Action))
)",
     R"(error[BT1001]: `(` is never closed
  --> t.btf:1:1
  |
1 | ((BehaviorTree (Action))
  | ^ opened here
  |
  = help: a `)` is missing before the end
)"},

    {"an unknown node type, with the nearest one",
     R"((BehaviorTree
 (Sequnce (Action) (Action)))
)",
     R"(error[BT1004]: unknown node type `Sequnce`
  --> t.btf:2:3
  |
2 |  (Sequnce (Action) (Action)))
  |   ^^^^^^^
  |
  = help: did you mean `Sequence`?
)"},

    {"a node type of another engine, with ours",
     R"((BehaviorTree (Selector (Action)))
)",
     R"(error[BT1004]: unknown node type `Selector`
  --> t.btf:1:16
  |
1 | (BehaviorTree (Selector (Action)))
  |                ^^^^^^^^
  |
  = help: here it is called `Fallback`
)"},

    {"an unknown keyword, with the nearest one",
     R"((BehaviorTree (ReactiveSequence :hlt 1 (Action)))
)",
     R"(error[BT1005]: unknown keyword `:hlt`
  --> t.btf:1:33
  |
1 | (BehaviorTree (ReactiveSequence :hlt 1 (Action)))
  |                                 ^^^^ not a keyword of ReactiveSequence
  |
  = help: did you mean `:halt`?
)"},

    {"a keyword of another node type, with its owners",
     R"((BehaviorTree (Sequence :repeat 1 (Action)))
)",
     R"(error[BT1005]: `:repeat` does not belong to Sequence
  --> t.btf:1:25
  |
1 | (BehaviorTree (Sequence :repeat 1 (Action)))
  |                         ^^^^^^^
  |
  = help: it is a keyword of `Repeat`
)"},

    {"a wrong number of children",
     R"((BehaviorTree (Recovery :retry 1 (Action)))
)",
     R"(error[BT1009]: Recovery takes 2 children, not 1
  --> t.btf:1:16
  |
1 | (BehaviorTree (Recovery :retry 1 (Action)))
  |                ^^^^^^^^
)"},

    {"a required keyword is missing",
     R"((BehaviorTree (Parallel (Action)))
)",
     R"(error[BT1006]: Parallel needs `:success`
  --> t.btf:1:16
  |
1 | (BehaviorTree (Parallel (Action)))
  |                ^^^^^^^^
  |
  = help: write `(Parallel :success ...)`
)"},

    {"a keyword is given twice",
     R"((BehaviorTree (Repeat :repeat 1 :repeat 2 (Action)))
)",
     R"(error[BT1006]: `:repeat` is given twice
  --> t.btf:1:33
  |
1 | (BehaviorTree (Repeat :repeat 1 :repeat 2 (Action)))
  |                                 ^^^^^^^ the first one is used
  |
  = help: delete one of them
)"},

    {"a value out of its bounds",
     R"((BehaviorTree (Parallel :success 3 (Action) (Action)))
)",
     R"(error[BT1008]: `3` is not a value of `:success`
  --> t.btf:1:34
  |
1 | (BehaviorTree (Parallel :success 3 (Action) (Action)))
  |                                  ^ a whole number from 1 to 2 is needed
)"},

    {"a variable is declared twice",
     R"((defsv fls :max 3)
(defsv Fls :max 4)
(BehaviorTree (Action))
)",
     R"(error[BT1011]: the state variable `Fls` is declared twice
  --> t.btf:2:8
  |
2 | (defsv Fls :max 4)
  |        ^^^ declared again here
  |
  = help: the first declaration is on line 1
)"},

    {"an unknown variable, with the nearest one",
     R"((defsv fls :max 3)
(defsv battery :states (Good Low Critical))
(BehaviorTree (Eval (= batery Low)))
)",
     R"(error[BT1012]: unknown state variable `batery`
  --> t.btf:3:24
  |
3 | (BehaviorTree (Eval (= batery Low)))
  |                        ^^^^^^
  |
  = help: did you mean `battery`?
)"},

    {"an unknown state, with the states there are",
     R"((defsv fls :max 3)
(defsv battery :states (Good Low Critical))
(BehaviorTree (Eval (= battery Bad)))
)",
     R"(error[BT1013]: `Bad` is not a state of `battery`
  --> t.btf:3:32
  |
3 | (BehaviorTree (Eval (= battery Bad)))
  |                                ^^^
  |
  = help: its states are `Good`, `Low` and `Critical`
)"},

    {"a difference in case is a warning",
     R"((defsv fls :max 3)
(defsv battery :states (Good Low Critical))
(BehaviorTree (Eval (= battery critical)))
)",
     R"(warning[BT1007]: `Critical` is written `critical` here
  --> t.btf:3:32
  |
3 | (BehaviorTree (Eval (= battery critical)))
  |                                ^^^^^^^^ upper and lower case differ
  |
  = help: write `Critical`
)"},

    {"a number where true or false is needed",
     R"((defsv fls :max 3)
(defsv battery :states (Good Low Critical))
(BehaviorTree (Eval (and (= fls 1) fls)))
)",
     R"(error[BT1015]: `fls` is a number
  --> t.btf:3:36
  |
3 | (BehaviorTree (Eval (and (= fls 1) fls)))
  |                                    ^^^ true or false is needed
  |
  = help: compare it: `(= fls ...)`
)"},

    {"true or false where a number is needed",
     R"((defsv fls :max 3)
(defsv battery :states (Good Low Critical))
(BehaviorTree (Eval (< fls (= fls 1))))
)",
     R"(error[BT1015]: `(= ...)` is true or false
  --> t.btf:3:28
  |
3 | (BehaviorTree (Eval (< fls (= fls 1))))
  |                            ^ a number is needed
)"},

    {"a comparison that is always false is a warning",
     R"((defsv fls :max 3)
(defsv battery :states (Good Low Critical))
(BehaviorTree (Eval (= fls 4)))
)",
     R"(warning[BT1017]: this comparison is always false
  --> t.btf:3:28
  |
3 | (BehaviorTree (Eval (= fls 4)))
  |                            ^ `fls` ranges from 0 to 3
)"},

    {"an assignment out of range",
     R"((defsv fls :max 3)
(defsv battery :states (Good Low Critical))
(BehaviorTree (Eval (:= fls 4)))
)",
     R"(error[BT1016]: `fls` cannot become 4
  --> t.btf:3:29
  |
3 | (BehaviorTree (Eval (:= fls 4)))
  |                             ^ its range is 0 to 3
)"},

    {"an assignment inside an expression",
     R"((defsv fls :max 3)
(defsv battery :states (Good Low Critical))
(BehaviorTree (Eval (not (:= fls 1))))
)",
     R"(error[BT1016]: `:=` stands inside an expression
  --> t.btf:3:27
  |
3 | (BehaviorTree (Eval (not (:= fls 1))))
  |                           ^^
  |
  = help: an assignment is the whole of an Eval: `(Eval (:= v e))`
)"},

    {"an ambiguous node, with all candidates",
     R"((BehaviorTree (Sequence
 (Action :ID land)
 (Fallback :ID fail
  (Action :ID land))
 (Eval (= land.rstatus success))))
)",
     R"(error[BT1014]: `land` is the name of 2 nodes
  --> t.btf:5:11
  |
5 |  (Eval (= land.rstatus success))))
  |           ^^^^^^^^^^^^ which one is meant?
  |
  = help: write `land_btn2` (line 2) or `land_btn4` (line 4)
)"},

    {"an unknown node, with the nearest one",
     R"((BehaviorTree (Sequence (Action :ID land)
 (Eval (= lnd.rstatus success))))
)",
     R"(error[BT1014]: unknown node `lnd`
  --> t.btf:2:11
  |
2 |  (Eval (= lnd.rstatus success))))
  |           ^^^^^^^^^^^ no node has this name
  |
  = help: did you mean `land`?
)"},

    {"a tree that contains itself",
     R"((BehaviorTree :name a (SubTree :ID b))
(BehaviorTree :name b (Sequence
 (SubTree :ID a)))
)",
     R"(error[BT1018]: the tree `a` contains itself
  --> t.btf:3:15
  |
3 |  (SubTree :ID a)))
  |               ^ a subtree of itself here
  |
  = help: repeat with `Repeat`, or with `:loop 1` on the BehaviorTree
)"},

    {"several trees that could run",
     R"((BehaviorTree :name a (Action))
(BehaviorTree :name b (Action))
)",
     R"(error[BT1019]: there are 2 trees to run
  --> t.btf:2:2
  |
2 | (BehaviorTree :name b (Action))
  |  ^^^^^^^^^^^^ no SubTree refers to it
  |
  = help: to run them in parallel, write `(Trees a b)`
)"},

    {"an empty file",
     R"(; nothing but a comment
)",
     R"(error[BT1019]: the file is empty
  --> t.btf
  = help: write `(BehaviorTree :name main (...))`
)"},

    {"a file without a tree",
     R"((defsv fls :max 3)
)",
     R"(error[BT1019]: there is no BehaviorTree in this file
  --> t.btf
  = help: write `(BehaviorTree :name main (...))`
)"},

    {"a contract that no leaf has",
     R"((defaction lnd :returns (success))
(BehaviorTree (Action :ID land))
)",
     R"(warning[BT1021]: no Action is called `lnd`
  --> t.btf:1:12
  |
1 | (defaction lnd :returns (success))
  |            ^^^ this contract is not used
)"},

    {"a label left over from LaTeX",
     R"((BehaviorTree (*@ \label{ll:x} @*)
 (Action))
)",
     R"(error[BT1003]: `(*@ ... @*)` is not part of the language
  --> t.btf:1:15
  |
1 | (BehaviorTree (*@ \label{ll:x} @*)
  |               ^^^^^^^^^^^^^^^^^^^^ a line label of a LaTeX listing
  |
  = help: delete it
)"},
};

TEST_CASE("every mistake is shown with its place and what to do") {
  for (const Mistake& mistake : kMistakes) {
    CAPTURE(mistake.what);
    CHECK(findings_of(mistake.text) == mistake.shown);
  }
}

// The codes of all findings, in order, joined by blanks.
std::string codes_of(std::string_view text) {
  std::string codes;
  for (const Diagnostic& found : read_btf("t.btf", text).diagnostics) {
    codes += (codes.empty() ? "" : " ") + found.code;
  }
  return codes;
}

// The codes for a node inside (BehaviorTree ...), with two variables.
std::string node_codes(std::string_view node) {
  return codes_of(
      "(defsv fls :max 3) (defsv battery :states (Good Low))"
      "(defsv panel :states (In Out)) (BehaviorTree :name t " +
      std::string(node) + ")");
}

TEST_CASE("what a declaration of a variable can get wrong") {
  const struct {
    std::string_view declaration;
    std::string_view codes;
  } kCases[] = {
      {"(defsv)", "BT1010"},
      {"(defsv 3 :max 3)", "BT1010"},
      {"(defsv a)", "BT1006"},
      {"(defsv a :min 0)", "BT1006"},
      {"(defsv a :max)", "BT1006"},
      {"(defsv a b :max 1)", "BT1010"},
      {"(defsv a :min 2 :max 1)", "BT1010"},
      {"(defsv a :max 2147483648)", "BT1008"},
      {"(defsv a :min -2147483648 :max 0)", "BT1008"},
      {"(defsv a :max 99999999999999999999)", "BT1008"},
      {"(defsv a :max 1.5)", "BT1008"},
      {"(defsv a :max 3 :init 4)", "BT1008"},
      {"(defsv a :max 3 :moves often)", "BT1008"},
      {"(defsv a :states (X Y) :max 3)", "BT1005"},
      {"(defsv a :states ())", "BT1010"},
      {"(defsv a :states X)", "BT1010"},
      {"(defsv a :states (X (Y)))", "BT1010"},
      {"(defsv a :states (X 2))", "BT1010"},
      {"(defsv a :states (X x))", "BT1011"},
      {"(defsv a :states (X Y) :init Z)", "BT1013"},
      {"(defsv a :states (X Y) :init x)", "BT1007"},
      {"(defsv a :states (X Y) :transitions some)", "BT1010"},
      {"(defsv a :states (X Y) :transitions (X Y))", "BT1010 BT1010"},
      {"(defsv a :states (X Y) :transitions ((X Y Z)))", "BT1008"},
      {"(defsv a :states (X Y) :transitions ((X Q)))", "BT1013"},
      {"(defsv a :states (X Y) :moves often)", "BT1008"},
      {"(defsv a :max 3 :color red)", "BT1005"},
      {"(DefSV a :max 3)", "BT1007"},
  };
  for (const auto& each : kCases) {
    CAPTURE(each.declaration);
    CHECK(codes_of(std::string(each.declaration) +
                   " (BehaviorTree (Action))") == each.codes);
  }
}

TEST_CASE("what a node can get wrong") {
  const struct {
    std::string_view node;
    std::string_view codes;
  } kCases[] = {
      {"(Sequence)", "BT1009"},
      {"(Inverter (Action) (Action))", "BT1009"},
      {"(Action (Action))", "BT1009"},
      {"(Sequence (Action) x)", "BT1003"},
      {"(Sequence ((Action)))", "BT1003"},
      {"(Sequence ())", "BT1003"},
      {"(sequence (action))", "BT1007 BT1007"},
      {"(Sequence (Bogus (Sequnce (Action :hlt 1))))", "BT1004 BT1004 BT1005"},
      {"(Action :ID)", "BT1006"},
      {"(Action :ID :name x)", "BT1006"},
      {"(Action :ID 3)", "BT1008"},
      {"(Action :ID \"a b\")", "BT1008"},
      {"(Action :ID a :id b)", "BT1006"},
      {"(Action : a)", "BT1003 BT1003"},
      {"(Action :args x)", "BT1008"},
      {"(Action :args (x))", "BT1008"},
      {"(Action :args ((x) 1))", "BT1008"},
      {"(Action :duration 1.5)", "BT1008"},
      {"(Action :duration -1)", "BT1008"},
      {"(Action :duration [5,2])", "BT1008"},
      {"(Action :duration [1,2,3])", "BT1008"},
      {"(Action :duration [])", "BT1008"},
      {"(Action :duration (a b))", "BT1008"},
      {"(Action :duration 1000001)", "BT1008"},
      {"(Action :SF :duration 3)", "BT1020"},
      {"(Condition :SF)", "BT1005"},
      {"(Condition :duration 3)", "BT1005"},
      {"(Wait)", "BT1006"},
      {"(Wait :args (wait_duration 5))", "BT1006"},
      {"(SetSV)", "BT1006"},
      {"(SetSV :sv q)", "BT1012"},
      {"(Repeat (Action))", "BT1006"},
      {"(Repeat :repeat 0 (Action))", "BT1008"},
      {"(Repeat :repeat -1 (Action))", "BT1008"},
      {"(RetryUntilSuccessful (Action))", "BT1006"},
      {"(Recovery (Action) (Action))", "BT1006"},
      {"(Recovery :retry 1 :num_retries 1 (Action) (Action))", "BT1006"},
      {"(ParallelAll :success 1 (Action))", "BT1005"},
      {"(Parallel :success 0 (Action))", "BT1008"},
      {"(Parallel :success (Action) (Action))", "BT1006"},
      {"(ReactiveSequence :halt 2 (Action))", "BT1008"},
      {"(RateController (Action))", "BT1006"},
      {"(RateController :hz 0 (Action))", "BT1008"},
      {"(RateController :hz fast (Action))", "BT1008"},
      {"(RateController :hz inf (Action))", "BT1008"},
      {"(RateController :args (hz nan) (Action))", "BT1008"},
      {"(SubTree)", "BT1006 BT1018"},
      {"(SubTree :ID q)", "BT1018"},
      {"(SubTree :ID q (Action))", "BT1009 BT1018"},
      {"(SubTree :ID t)", "BT1018"},
      {"(Eval)", "BT1009"},
      {"(Eval (= fls 1) (= fls 2))", "BT1009"},
  };
  for (const auto& each : kCases) {
    CAPTURE(each.node);
    CHECK(node_codes(each.node) == each.codes);
  }
}

TEST_CASE("what an expression can get wrong") {
  const struct {
    std::string_view expression;
    std::string_view codes;
  } kCases[] = {
      {"fls", "BT1015"},
      {"3", "BT1015"},
      {"q", "BT1012"},
      {"$q", "BT1012"},
      {"()", "BT1004"},
      {"((= fls 1))", "BT1004"},
      {"(== fls 1)", "BT1004"},
      {"(= fls)", "BT1009"},
      {"(< 0 fls 3)", "BT1009"},
      {"(and)", "BT1009"},
      {"(~ (= fls 1) (= fls 2))", "BT1009"},
      {"(= fls 1.5)", "BT1017"},
      {"(= fls 2147483648)", "BT1008"},
      {"(= fls [1,2])", "BT1003"},
      {"(= fls \"x\")", "BT1003"},
      {"(= fls :x)", "BT1003"},
      {"(= fls (/ 1 0))", "BT1015"},
      {"(= fls (mod 1 (- 1 1)))", "BT1015"},
      {"(= fls battery)", "BT1015"},
      {"(= battery 1)", "BT1015"},
      {"(= battery (+ 1 2))", "BT1015"},
      {"(= battery panel)", "BT1015"},
      {"(= battery Lo)", "BT1013"},
      {"(= battery $Low)", "BT1012"},
      {"(< battery Low)", "BT1015 BT1012"},
      {"(= Low Good)", "BT1012"},
      {"(= (= fls 1) (= fls 2))", "BT1015"},
      {"(= q.rstatus success)", "BT1014"},
      {"(= t.rstatus idle)", "BT1013"},
      {"(= t.rstatus 1)", "BT1015"},
      {"(= t.rstatus battery)", "BT1013"},
      {"(and t.rstatus (= fls 1))", "BT1015"},
      {"(= t_btn9.rstatus success)", "BT1014"},
      {"(= T.rstatus success)", "BT1007"},
      {"(= FLS 1)", "BT1007"},
      {"(>= fls 4)", "BT1017"},
      {"(<= fls 9)", "BT1017"},
      {"(= 4 fls)", "BT1017"},
      {"(:= fls)", "BT1009"},
      {"(:= (+ 1 2) 3)", "BT1009"},
      {"(:= q 1)", "BT1012"},
      {"(:= fls 4)", "BT1016"},
      {"(:= fls (+ 2 2))", "BT1016"},
      {"(:= fls Low)", "BT1012"},
      {"(:= fls battery)", "BT1015"},
      {"(:= fls (= fls 1))", "BT1015"},
      {"(:= battery 1)", "BT1015"},
      {"(:= battery In)", "BT1013"},
      {"(:= battery panel)", "BT1015"},
      {"(:= battery (:= fls 1))", "BT1016"},
      {"(:= battery t.rstatus)", "BT1015"},
  };
  for (const auto& each : kCases) {
    CAPTURE(each.expression);
    CHECK(node_codes("(Eval " + std::string(each.expression) + ")") ==
          each.codes);
  }
}

TEST_CASE("what a file can get wrong") {
  const struct {
    std::string_view text;
    std::string_view codes;
  } kCases[] = {
      {"", "BT1019"},
      {"()", "BT1019"},
      {"word (BehaviorTree (Action))", "BT1003"},
      {"(Sequence (Action)) (BehaviorTree (Action))", "BT1004"},
      {"(defsw a :max 1) (BehaviorTree (Action))", "BT1004"},
      {"((((BehaviorTree (Action)))))", "BT1001 BT1001 BT1001"},
      {"(BehaviorTree)", "BT1009"},
      {"(BehaviorTree (Action) (Action))", "BT1009"},
      {"(BehaviorTree :loop 2 (Action))", "BT1008"},
      {"(BehaviorTree (Action)) (Trees)", "BT1021 BT1019"},
      {"(BehaviorTree :name a (Action)) (Trees b)", "BT1021 BT1018"},
      {"(BehaviorTree :name a (Action)) (Trees a a)", "BT1011"},
      {"(BehaviorTree :name a (Action)) (Trees a) (Trees a)", "BT1019"},
      {"(BehaviorTree :name a (Action)) (Trees A)", ""},
      {"(BehaviorTree :name a (Action)) (BehaviorTree :name A (Action))",
       "BT1011 BT1021"},
      {"(BehaviorTree :name a (Action)) (Trees a) (BehaviorTree :name b "
       "(Sequence (SubTree :ID c) (Eval (= q 1)))) (BehaviorTree :name c "
       "(Action))",
       "BT1021 BT1012 BT1021"},
      {"(BehaviorTree :name a (SubTree :ID a))", "BT1018"},
      {"(defaction) (BehaviorTree (Action))", "BT1020"},
      {"(defaction a b) (BehaviorTree (Action :ID a))", "BT1020"},
      {"(defaction a :returns ()) (BehaviorTree (Action :ID a))", "BT1020"},
      {"(defaction a :returns success) (BehaviorTree (Action :ID a))",
       "BT1020"},
      {"(defaction a :returns (idle)) (BehaviorTree (Action :ID a))",
       "BT1020 BT1020"},
      {"(defaction a :returns (running)) (BehaviorTree (Action :ID a :SF))",
       "BT1020"},
      {"(defaction a :returns (success) :duration 2) (BehaviorTree (Action "
       ":ID a))",
       "BT1020"},
      {"(defcondition a :returns (running)) (BehaviorTree (Condition :ID a))",
       "BT1020 BT1020"},
      {"(defcondition a :duration 2) (BehaviorTree (Condition :ID a))",
       "BT1005"},
      {"(defaction a :on-success (x)) (BehaviorTree (Action :ID a))", "BT1020"},
      {"(defaction a :on-success x) (BehaviorTree (Action :ID a))", "BT1020"},
      {"(defaction a :requires (= q 1)) (BehaviorTree (Action :ID a))",
       "BT1012"},
      {"(defaction a :requires (= q 1)) (BehaviorTree (Action :ID b))",
       "BT1021 BT1012"},
      {"(defaction A) (BehaviorTree (Action :ID a))", "BT1007"},
      {"(defaction a) (defaction a) (BehaviorTree (Action :ID a))", "BT1011"},
      {"(BehaviorTree (Action :args (x \"y)))", "BT1001 BT1008 BT1003"},
      {"(BehaviorTree (Action :duration [2,5))", "BT1001 BT1006 BT1003"},
      {"(BehaviorTree (Action :ID a\x1b[2Jb))", "BT1003"},
      {"(BehaviorTree (Action :ID a\xE2\x80\xAEz))", "BT1003"},
  };
  for (const auto& each : kCases) {
    CAPTURE(each.text);
    CHECK(codes_of(each.text) == each.codes);
  }
}

TEST_CASE("a file that is not text is refused at once") {
  using namespace std::string_literals;
  CHECK(codes_of("\x7f"
                 "ELF\0\0"s) == "BT1000");
  CHECK(codes_of("(BehaviorTree \xFF)") == "BT1000");
}

TEST_CASE("an error says nothing about the rest twice, and ends nothing") {
  const std::string text =
      "(defsv fls :max 3) (BehaviorTree (Sequence"
      " (Eval (= x 1)) (Eval (= x 1)) (Bogus)"
      " (Parallel (Action)) (Eval (:= fls 9))))";
  CHECK(codes_of(text) == "BT1012 BT1012 BT1004 BT1006 BT1016");
  CHECK(!read_btf("t.btf", text).value);
}

TEST_CASE("the mistakes of a subtree are told once, however often it runs") {
  CHECK(codes_of("(BehaviorTree :name a (Sequence (SubTree :ID b) (SubTree "
                 ":ID b))) (BehaviorTree :name b (Eval (= x 1)))") == "BT1012");
}

TEST_CASE("at most 20 errors are shown, and a note says so") {
  std::string text = "(BehaviorTree (Sequence";
  for (int i = 0; i < 100; ++i) text += "\n(Bogus)";
  const auto result = read_btf("t.btf", text + "))");
  REQUIRE(result.diagnostics.size() == 21);
  CHECK(!result.value);
  CHECK(result.diagnostics.back().severity == Severity::Note);
}

TEST_CASE("at most 20 warnings are shown, and the tree is read") {
  std::string text = "(defsv v :states (A B)) (BehaviorTree (Sequence";
  for (int i = 0; i < 100; ++i) text += "\n(Eval (= v a))";
  const auto result = read_btf("t.btf", text + "))");
  REQUIRE(result.diagnostics.size() == 21);
  CHECK(result.value);
}

std::string repeated(std::string_view text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST_CASE("parentheses nest 500 deep and no deeper") {
  const auto nested = [](int depth) {
    return "(BehaviorTree " + repeated("(Inverter ", depth - 2) + "(Action" +
           repeated(")", depth);
  };
  CHECK(codes_of(nested(500)) == "");
  CHECK(codes_of(nested(501)) == "BT1002");
  CHECK(codes_of(repeated("(", 10'000)) == "BT1002");
  CHECK(codes_of(repeated("(", 10'000) + repeated(")", 10'000)) == "BT1002");
  CHECK(codes_of("(BehaviorTree (Eval " + repeated("(not ", 490) + "(= 1 1)" +
                 repeated(")", 492)) == "");
}

TEST_CASE("subtrees that double at each of 60 levels are cut off") {
  std::string text;
  for (int i = 0; i < 60; ++i) {
    const std::string next = std::to_string(i + 1);
    text += "(BehaviorTree :name t" + std::to_string(i) +
            " (Sequence (SubTree :ID t" + next + ") (SubTree :ID t" + next +
            ")))\n";
  }
  text += "(BehaviorTree :name t60 (Action))";
  CHECK(codes_of(text) == "BT1002");
}

TEST_CASE("a large file is read in a moment") {
  const std::string text = "(BehaviorTree (Sequence" +
                           repeated(" (Action :ID a :args (x 1))", 65'533) +
                           "))";
  CHECK(tree_of(text).nodes.size() == 65'535);
  CHECK(codes_of("(BehaviorTree (Sequence" + repeated(" (Action)", 65'534) +
                 "))") == "BT1002");
  CHECK(codes_of(repeated("a ", 1'000'001)) == "BT1002");
  CHECK(codes_of(std::string((16 << 20) + 1, ' ')) == "BT1002");
}

}  // namespace
}  // namespace btcheck::btf_errors_test
