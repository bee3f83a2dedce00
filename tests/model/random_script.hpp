// SPDX-License-Identifier: MIT
//
// Random scripts of BehaviorTree.CPP 4, which say what they need themselves.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "script_engine.hpp"

namespace btcheck::script_engine {

// In a well-typed script `a`, `b`, `c` are numbers and `s`, `t` texts, what is
// asked for is a number, and nothing divides. In a wild one anything goes.
class Writer {
 public:
  Writer(std::mt19937& random, bool is_wild)
      : random_(random), is_wild_(is_wild) {}

  // Gives every entry a value.
  std::vector<Script> first() {
    std::vector<Script> all;
    for (const char* name : {"a", "b", "c"}) {
      all.push_back(
          joined(":=", {named(name), literal(std::int64_t{below(3)})}));
    }
    for (const char* name : {"s", "t"}) {
      all.push_back(joined(
          ":=", {named(name), literal(one_of<std::string>({"idle", "3"}))}));
    }
    return all;
  }

  std::vector<Script> statements() {
    std::vector<Script> all;
    const int count = 1 + below(3);
    for (int i = 0; i < count; ++i) {
      all.push_back(below(4) > 0 ? assignment(2) : number(3));
    }
    return all;
  }

 private:
  int below(int end) {
    return static_cast<int>(random_() % static_cast<unsigned>(end));
  }
  template <class T>
  T one_of(std::initializer_list<T> all) {
    return *(all.begin() + below(static_cast<int>(all.size())));
  }
  std::string number_name() {
    if (is_wild_) return one_of<std::string>({"a", "b", "s", "t", "free"});
    return one_of<std::string>({"a", "b", "c"});
  }
  std::string text_name() { return one_of<std::string>({"s", "t"}); }

  Script assignment(int depth) {
    if (below(3) == 0) return text_assignment(depth);
    const auto sign = one_of<std::string>(
        {":=", ":=", "=",
         "+=", "-=", below(3) == 0 ? "*=" : "+=", is_wild_ ? "/=" : "-="});
    std::string name = number_name();
    if (name == "free") name = "a";
    return joined(sign, {named(name), number(depth)});
  }

  Script text_assignment(int depth) {
    const auto sign = is_wild_ && below(6) == 0 ? "+=" : ":=";
    return joined(sign, {named(text_name()), text(depth)});
  }

  Script text(int depth) {
    if (is_wild_ && below(5) == 0) return number(depth - 1);
    if (is_wild_ && depth > 0 && below(6) == 0) {
      return joined(one_of<std::string>({"..", "+"}),
                    {text(depth - 1), text(depth - 1)});
    }
    if (depth > 0 && below(5) == 0) {
      return joined("?", {number(depth - 1), text(depth - 1), text(depth - 1)});
    }
    if (below(3) == 0) return named(text_name());
    if (is_wild_) {
      return literal(one_of<std::string>(
          {"", "idle", "busy", "1", "2.5", "true", "-1", "7x"}));
    }
    return literal(one_of<std::string>({"idle", "busy", "", "3"}));
  }

  Script number(int depth) {
    if (is_wild_ && below(8) == 0) return text(depth - 1);
    if (depth <= 0 || below(4) == 0) {
      if (below(2) == 0) return named(number_name());
      if (is_wild_ && below(4) == 0) return literal(one_of({0.5, 2.0, -1.25}));
      return literal(std::int64_t{below(4)});
    }
    switch (below(8)) {
      case 0:
        return joined(one_of<std::string>({"&&", "||"}),
                      {truth_or_number(depth - 1), truth(depth - 1)});
      case 1:
        return joined("!", {truth(depth - 1)});
      case 2:
        return joined("?",
                      {truth(depth - 1), branch(depth - 1), branch(depth - 1)});
      case 3:
        return joined("-", {number(depth - 1)});
      case 4:
        if (is_wild_) return unusual(depth);
        return joined("+", {number(depth - 1), number(depth - 1)});
      case 5:
        return joined(one_of<std::string>({"+", "-", "*"}),
                      {number(depth - 1), number(depth - 1)});
      default:
        return truth(depth);
    }
  }

  // A number as a truth value: below 0 it is none, and other integers than 0
  // and 1 are none.
  Script truth_or_number(int depth) {
    return below(5) == 0 ? number(depth) : truth(depth);
  }

  Script unusual(int depth) {
    if (below(6) == 0) return joined("~", {number(depth - 1)});
    return joined(one_of<std::string>({"&", "|", "^", "/", "..", "&&", "+"}),
                  {number(depth - 1), number(depth - 1)});
  }

  Script branch(int depth) {
    return below(4) == 0 ? assignment_to_number(depth) : number(depth);
  }
  Script assignment_to_number(int depth) {
    return joined(one_of<std::string>({":=", "+="}),
                  {named(one_of<std::string>({"a", "b"})), number(depth)});
  }

  Script truth(int depth) {
    if (is_wild_ && below(4) == 0) return number(depth - 1);
    const bool of_texts = below(3) == 0;
    Script chain = joined("cmp", {});
    const int count = of_texts ? 1 : 1 + below(2);
    for (int i = 0; i <= count; ++i) {
      chain.kids.push_back(of_texts ? text(depth - 1) : number(depth - 1));
      if (i == 0) continue;
      chain.chain.push_back(
          one_of<std::string>({"==", "!=", "<", "<=", ">", ">="}));
    }
    return chain;
  }

  std::mt19937& random_;
  bool is_wild_;
};

inline std::string text_of(const std::vector<Script>& statements) {
  std::string all;
  for (const Script& each : statements) {
    all += (all.empty() ? "" : "; ") + each.text();
  }
  return all;
}

}  // namespace btcheck::script_engine
