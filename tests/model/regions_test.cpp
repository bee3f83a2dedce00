// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "model/automata/regions.hpp"
#include "model/lowering.hpp"
#include "model/sampling.hpp"

namespace btcheck::regions_test {
namespace {

// The regions of x, the first variable, of a tree with these leaves.
Regions regions_in(const std::string& variables, const std::string& leaves,
                   const std::vector<Expression>& asked = {}) {
  const std::string text =
      variables + " (BehaviorTree :name t (Sequence " + leaves + "))";
  const auto tree = read_btf("t.btf", text);
  REQUIRE(tree.value.has_value());
  const Network network =
      lower_to_bind(*tree.value, lowering(*tree.value, TickSemantics::Root));
  const StateVariableId x{0};
  return regions_of(network, {&x, 1}, asked);
}

using Values = std::vector<int>;

Values samples_in(const std::string& leaves,
                  const std::vector<Expression>& asked = {}) {
  const Regions regions =
      regions_in("(defsv x :init 5 :min 0 :max 1000000) (defsv y :max 9)",
                 "(SetSV :sv x) " + leaves, asked);
  REQUIRE(regions.unsplit.empty());
  return regions.samples.at(0);
}

}  // namespace

TEST_CASE("a number is split where it is compared") {
  CHECK(samples_in("(Action)") == Values{5});
  CHECK(samples_in("(Eval (> x 20))") == Values{5, 21});
  CHECK(samples_in("(Eval (= x 20))") == Values{5, 20});
  CHECK(samples_in("(Eval (and (< x 3) (~ (= x 500))))") == Values{2, 5, 500});
  CHECK(samples_in("(Eval (> (- (* 3 x) 7) 50))") == Values{5, 20});
  CHECK(samples_in("(Eval (> (* x x) 99))") == Values{5, 10});
}

TEST_CASE("values that come out alike are one region, wherever they are") {
  CHECK(samples_in("(Eval (= (mod (/ x 100000) 2) 1))") == Values{5, 100000});
}

TEST_CASE("rules split as the tree does") {
  const Expression rule = Expression::binary(
      Operation::LessEqual, Expression::variable(0), Expression::constant(700));
  CHECK(samples_in("(Eval (> x 20))", {rule}) == Values{5, 21, 701});
}

TEST_CASE("a value that is assigned stands for its region") {
  CHECK(samples_in("(Eval (> x 20)) (Eval (:= x 100))") == Values{5, 100});
  // The initial one goes before.
  CHECK(samples_in("(Eval (> x 20)) (Eval (:= x 7))") == Values{5, 21});
}

TEST_CASE("regions are kept by assignments") {
  CHECK(samples_in("(Eval (> x 20)) (Eval (:= x (/ x 2)))").size() == 17);
  // To y, which is compared as well, or runs out of its range.
  CHECK(samples_in("(Eval (:= y (/ x 100000))) (Eval (> y 3))") ==
        Values{5, 400000, 1000000});
}

TEST_CASE("a divisor must be told from zero") {
  CHECK(samples_in("(Eval (> (/ 8 (- x 6)) 0))") == Values{5, 6, 7});
}

TEST_CASE("numbers that are compared with each other are not split") {
  const Regions regions =
      regions_in("(defsv x :max 1000000) (defsv y :max 1000000)",
                 "(SetSV :sv x) (Eval (> x y))");
  REQUIRE(regions.unsplit.size() == 1);
  CHECK(regions.unsplit[0].variable == StateVariableId{0});
  CHECK(regions.unsplit[0].beside == VariableId{1});
  CHECK(regions.samples.at(0).empty());
}

TEST_CASE("a number that counts tells all its values apart") {
  const Regions few =
      regions_in("(defsv x :max 40)", "(SetSV :sv x) (Eval (:= x (- x 1)))");
  CHECK(few.samples.at(0).size() == 41);
  const Regions many = regions_in("(defsv x :max 1000000)",
                                  "(SetSV :sv x) (Eval (:= x (- x 1)))");
  REQUIRE(many.unsplit.size() == 1);
  CHECK_FALSE(many.unsplit[0].beside.has_value());
}

TEST_CASE("ranges of 32 bits are split to the last value") {
  const Regions regions = regions_in(
      "(defsv x :min -2147483647 :max 2147483647)",
      "(SetSV :sv x) (Eval (> x 2147483646)) (Eval (< x -2147483646))");
  CHECK(regions.samples.at(0) == Values{-2147483647, -2147483646, 2147483647});
}

}  // namespace btcheck::regions_test
