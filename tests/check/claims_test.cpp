// SPDX-License-Identifier: MIT
//
// Properties as claims in three languages. That SPIN decides them as the
// engine does is compared in reference/exported_claims_cross_check_test.cpp.
#include "check/export/claims.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "check/checked.hpp"
#include "check/export/ltsmin.hpp"

namespace btcheck::claims_test {
namespace {

// A tree with its properties bound; it stays where it is.
struct Bound {
  explicit Bound(const std::string& written)
      : text(written), model(kWaitingTree), file(properties_of(text)) {
    auto made =
        bind_properties(model.tree, model.network, file,
                        SourceText("p.ltl", text), ExtraAssumption::None);
    INFO(shown(made.diagnostics));
    REQUIRE(made.value);
    bound = std::move(*made.value);
  }

  std::string text;
  Lowered model;
  PropertyFile file;
  BoundFile bound;
};

template <class Claim>
std::string told(const ExportedClaims<Claim>& exported) {
  std::string text;
  for (const Claim& claim : exported.claims) {
    text += claim.name + ": " + claim.formula + "\n";
  }
  for (const Diagnostic& finding : exported.left_out) {
    text += finding.message + "\n";
  }
  return text;
}

std::string promela(const std::string& properties) {
  const Bound all(properties);
  return told(promela_claims(all.bound, SourceText("p.ltl", all.text)));
}
std::string smv(const std::string& properties) {
  const Bound all(properties);
  return told(smv_claims(all.bound, SourceText("p.ltl", all.text)));
}
std::string fiacre(const std::string& properties) {
  const Bound all(properties);
  return told(fiacre_claims(all.bound, SourceText("p.ltl", all.text)));
}

std::string ltsmin(const std::string& properties) {
  const Bound all(properties);
  return told(ltsmin_claims(all.bound, SourceText("p.ltl", all.text)));
}

TEST_CASE("conditions on single states take the plainest form there is") {
  const std::string text =
      "property n is never a.running\nproperty i is always w = Calm\n"
      "property p is possible a.success\n";
  CHECK(promela(text) == "rule_n: [] (!p0)\nrule_i: [] p0\nrule_p: [] (!p0)\n");
  CHECK(smv(text) == "rule_n: !p0\nrule_i: p0\nrule_p: EF p0\n");
  CHECK(fiacre(text) == "n: absent p0\ni: always p0\np: absent p0\n");
  CHECK(ltsmin(text) == "rule_n: !p0\nrule_i: p0\nrule_p: !p0\n");
}

TEST_CASE("what is turned around says so") {
  const Bound all("property p is possible a.success\n");
  const auto claims =
      promela_claims(all.bound, SourceText("p.ltl", all.text)).claims;
  REQUIRE(claims.size() == 1);
  REQUIRE(claims[0].remarks.size() == 2);
  CHECK(claims[0].remarks[1] ==
        "the property holds exactly when this is violated");
}

TEST_CASE("linear time is spelled as each tool spells it") {
  const std::string text =
      "property f is [] (a.ticked => <> a.done)\n"
      "property w is (not a.ticked) W e.success\n";
  CHECK(promela(text) ==
        "rule_f: [] (p1 -> (<> p0))\nrule_w: p1 V (p0 || p1)\n");
  CHECK(smv(text) == "rule_f: G (p1 -> (F p0))\nrule_w: p1 V (p0 | p1)\n");
  CHECK(fiacre(text) ==
        "f: ltl [] (p1 => (<> p0))\nw: ltl (p1 release (p0 or p1))\n");
  CHECK(ltsmin(text) ==
        "rule_f: [] (p1 -> (<> p0))\nrule_w: p1 R (p0 || p1)\n");
}

TEST_CASE("what Fiacre's formulas lack is written by what they have") {
  const std::string text =
      "property e is <> a.done <=> <> e.success\n"
      "property c is true U a.done\n";
  CHECK(fiacre(text) ==
        "e: ltl (((<> p0) => (<> p1)) and ((<> p1) => (<> p0)))\n"
        "c: ltl (p1 until p0)\n");
  const Bound all("property c is true U a.done\n");
  const auto claims =
      fiacre_claims(all.bound, SourceText("p.ltl", all.text)).claims;
  REQUIRE(claims.size() == 1);
  CHECK(claims[0].propositions.at(1) == Expression::constant(1));
}

TEST_CASE("LTSmin has labels of states, and of steps those who take them") {
  const Bound all("property s is [] (enter (w = Storm) => w.moves)\n");
  const auto claims =
      ltsmin_claims(all.bound, SourceText("p.ltl", all.text)).claims;
  const std::string text = ltsmin_text("folder/my tree.btf", "'my tree.btf'",
                                       all.model.network, claims);
  CHECK(text.find("cat >my_tree_btf.btpins <<'END'\n'my tree.btf'\nEND\n") !=
        text.npos);
  CHECK(text.find("BTCHECK_PINS=--idle pins2lts-mc $load "
                  "--ltl='([] (<> progress == \"yes\")) -> ([] ((!rule_s_p0 "
                  "&& X rule_s_p0) -> (node == \"w\")))' "
                  "my_tree_btf.btpins\n") != text.npos);
  const auto labels = labels_of(claims);
  REQUIRE(labels.size() == 1);
  CHECK(labels[0].name == "rule_s_p0");
}

TEST_CASE("no two steps and no two movers have one name in LTSmin") {
  const Bound all("property s is never a.done\n");
  for (const auto& names :
       {action_names(all.model.network), mover_names(all.model.network)}) {
    CHECK(std::set(names.begin(), names.end()).size() == names.size());
    CHECK(names.back() == "time");
    for (const std::string& name : names) {
      CHECK(name.find_first_of(" ,\"'\\") == name.npos);
    }
  }
}

TEST_CASE("events of steps exist in SMV and LTSmin only") {
  const std::string text = "property s is [] (enter (w = Storm) => w.moves)\n";
  CHECK(smv(text) == "rule_s: G ((!p0 & X p0) -> p1)\n");
  CHECK(promela(text) ==
        "`s` is not exported to Promela: it speaks of steps\n");
  CHECK(fiacre(text) == "`s` is not exported to Fiacre: it speaks of steps\n");
}

TEST_CASE("branching time exists in SMV only") {
  const std::string text = "property b is AG (EF a.done)\n";
  CHECK(smv(text) == "rule_b: (AG (EF p0))\n");
  CHECK(promela(text) ==
        "`b` is not exported to Promela: it is branching time\n");
}

TEST_CASE("W and R of branching time are written by U") {
  CHECK(smv("property r is A[a.done R w = Calm]\n") ==
        "rule_r: (!E [(!p0) U (!p1)])\n");
  CHECK(smv("property w is E[a.done W w = Calm]\n") ==
        "rule_w: (!A [(!p1) U ((!p0) & (!p1))])\n");
}

TEST_CASE("real time exists in Fiacre only") {
  const std::string text =
      "property l is a.ticked leadsto a.done within [0,2]\n"
      "property b is a.ticked leadsto a.done within [0,2] before z.done\n"
      "property x is absent a.done after z.ticked for 3\n"
      "property g is a.ticked forbids a.done within [0,2]\n";
  CHECK(fiacre(text) ==
        "l: p0 leadsto p1 within [0,2]\n"
        "b: p0 leadsto p1 before p2 within [0,2]\n"
        "x: absent p0 after p1 within [0,3]\n"
        "`g` is not exported to Fiacre: Fiacre has no such pattern, or reads "
        "it in dense time only\n");
  CHECK(promela("property l is a.ticked leadsto a.done within [0,2]\n") ==
        "`l` is not exported to Promela: it speaks of real time\n");
}

TEST_CASE("a pattern that Fiacre's compiler does not have is left out") {
  const std::string text =
      "property f is present first a.done after z.done within [1,2]\n"
      "property e is a.ticked leadsto a.done within [1,...[\n";
  CHECK(fiacre(text) ==
        "`f` is not exported to Fiacre: frac 2.3.0 has no `first`\n"
        "`e` is not exported to Fiacre: frac 2.3.0 has no interval without an "
        "end\n");
  const Bound all(text);
  for (const Diagnostic& finding :
       fiacre_claims(all.bound, SourceText("p.ltl", all.text)).left_out) {
    CHECK(finding.code == "BT0008");
  }
}

TEST_CASE("the first answer is any answer where none can come too early") {
  CHECK(fiacre("property f is a.ticked leadsto first a.done within [0,2]\n") ==
        "f: p0 leadsto p1 within [0,2]\n");
}

TEST_CASE("dead states are known to SMV, and to Fiacre as its deadlock") {
  const std::string text = "property d is deadlockfree\n";
  CHECK(smv(text) == "rule_d: !p0\n");
  CHECK(fiacre(text) == "d: deadlockfree\n");
  CHECK(promela(text) ==
        "`d` is not exported to Promela: it asks for dead or stuck states\n");
}

TEST_CASE("assumptions stand before what they are assumed for") {
  const std::string text =
      "assume every action eventually ends\nproperty f is <> a.success\n";
  CHECK(promela(text) == "rule_f: (([] (<> p1)) -> ([] (<> p2))) -> (<> p0)\n");
  CHECK(fiacre(text) == "f: ltl ((([] (<> p1)) => ([] (<> p2))) => (<> p0))\n");
  CHECK(fiacre("assume calm: <> a.success\nproperty f is <> a.done\n") ==
        "f: ltl ((<> p0) => (<> p1))\n");
}

TEST_CASE("what would be too long to read is left out") {
  std::string nested = "a.done";
  for (int i = 0; i < 25; ++i) nested = "([] a.ticked W " + nested + ")";
  const std::string text = "property w is " + nested + "\n";
  CHECK(promela(text) ==
        "`w` is not exported to Promela: its formula would be too long\n");
  CHECK(smv(text) ==
        "`w` is not exported to SMV: its formula would be too long\n");
  CHECK(fiacre(text) ==
        "`w` is not exported to Fiacre: its formula would be too long\n");
}

TEST_CASE("names become identifiers and stay apart") {
  CHECK(smv("property \"a-b\" is never a.running\nproperty a_b is never "
            "a.done\n") == "rule_a_b: !p0\nrule_a_b_2: !p0\n");
  CHECK(fiacre("property \"value\" is never a.running\n") ==
        "value_: absent p0\n");
}

}  // namespace
}  // namespace btcheck::claims_test
