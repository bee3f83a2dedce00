// SPDX-License-Identifier: MIT
//
// Scripts run on single values, as BehaviorTree.CPP 4.10 does it: the naive
// twin of what src/model/btcpp/entries/run.cpp does on all values at once. It
// shares neither the parser nor the operators: scripts are trees of their own
// here, which can print themselves.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace btcheck::script_engine {

struct Thrown : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Nothing, an integer, a real number or a text.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;
using Blackboard = std::map<std::string, Value>;  // absent: no entry

// "name" reads kids[0]'s text; "lit" is `value`; "?" has three kids; a chain of
// comparisons is "cmp" with its signs; all others are signs of operators.
struct Script {
  std::string sign;
  Value value;
  std::string name;
  std::vector<Script> kids;
  std::vector<std::string> chain;

  std::string text() const;
};

inline Script literal(Value value) {
  return {"lit", std::move(value), {}, {}, {}};
}
inline Script named(std::string name) {
  return {"name", {}, std::move(name), {}, {}};
}
inline Script joined(std::string sign, std::vector<Script> kids) {
  return {std::move(sign), {}, {}, std::move(kids), {}};
}

inline bool is_text(const Value& v) {
  return std::holds_alternative<std::string>(v);
}
inline bool is_number(const Value& v) {
  return v.index() == 1 || v.index() == 2;
}

inline double as_double(const Value& v) {
  if (const auto* i = std::get_if<std::int64_t>(&v)) {
    if (std::abs(*i) > (std::int64_t{1} << 53) - 1) throw Thrown("precision");
    return static_cast<double>(*i);
  }
  if (const auto* d = std::get_if<double>(&v)) return *d;
  if (const auto* s = std::get_if<std::string>(&v)) {
    double out = 0;
    const auto read = std::from_chars(s->data(), s->data() + s->size(), out);
    if (read.ec != std::errc()) throw Thrown("no number");
    return out;
  }
  throw Thrown("empty");
}

inline std::int64_t as_integer(const Value& v) {
  if (const auto* i = std::get_if<std::int64_t>(&v)) return *i;
  const double d = as_double(v);
  if (d != std::nearbyint(d) || d < -0x1p63 || d >= 0x1p63) {
    throw Thrown("fraction");
  }
  return static_cast<std::int64_t>(d);
}

inline bool as_truth(const Value& v) {
  if (const auto* i = std::get_if<std::int64_t>(&v)) {
    if (*i != 0 && *i != 1) throw Thrown("no truth");
    return *i == 1;
  }
  const auto* d = std::get_if<double>(&v);
  if (d == nullptr || *d < 0) throw Thrown("no truth");
  return *d != 0;
}

inline std::string as_text(const Value& v) {
  if (const auto* i = std::get_if<std::int64_t>(&v)) return std::to_string(*i);
  if (const auto* d = std::get_if<double>(&v)) return std::to_string(*d);
  return std::get<std::string>(v);
}

// Of a text beside a number.
inline double beside_number(const Value& v) {
  if (is_text(v) && std::get<std::string>(v) == "true") return 1;
  if (is_text(v) && std::get<std::string>(v) == "false") return 0;
  return as_double(v);
}

template <class T>
bool ordered(const std::string& sign, const T& l, const T& r, bool same) {
  if (sign == "==") return same;
  if (sign == "!=") return !same;
  if (sign == "<") return !(l >= r);
  if (sign == ">") return !(l <= r);
  if (sign == "<=") return !(l > r);
  return !(l < r);
}

inline bool compared(const std::string& sign, const Value& l, const Value& r) {
  if (l.index() == 0 || r.index() == 0) throw Thrown("empty");
  if (is_text(l) && is_text(r)) {
    return ordered(sign, as_text(l), as_text(r), l == r);
  }
  const double one = beside_number(l);
  const double other = beside_number(r);
  return ordered(
      sign, one, other,
      std::abs(one - other) <= std::numeric_limits<float>::epsilon());
}

inline Value binary(const std::string& sign, const Value& l, const Value& r) {
  if (l.index() == 0 || r.index() == 0) throw Thrown("empty");
  if (is_number(l) && is_number(r)) {
    const double one = as_double(l);
    const double other = as_double(r);
    if (sign == "+") return one + other;
    if (sign == "-") return one - other;
    if (sign == "*") return one * other;
    if (sign == "/") return one / other;
    const auto bits = [&](auto f) {
      return static_cast<double>(f(as_integer(l), as_integer(r)));
    };
    if (sign == "&") return bits([](auto a, auto b) { return a & b; });
    if (sign == "|") return bits([](auto a, auto b) { return a | b; });
    if (sign == "^") return bits([](auto a, auto b) { return a ^ b; });
    if (sign == "..") throw Thrown("two numbers");
    const bool p = as_truth(l);
    const bool q = as_truth(r);
    return sign == "&&" ? double(p && q) : double(p || q);
  }
  if (sign == "..") return as_text(l) + as_text(r);
  if (sign == "+" && is_text(l) && is_text(r)) return as_text(l) + as_text(r);
  throw Thrown("not permitted");
}

// What an entry that holds something holds after it is given something else.
inline Value stored(const Value& held, const Value& value) {
  if (held.index() == 0 || held.index() == value.index()) return value;
  if (is_number(held) && is_text(value)) return beside_number(value);
  if (!is_number(held) || !is_number(value)) throw Thrown("type");
  if (held.index() == 1) return as_integer(value);
  return as_double(value);
}

inline Value run(const Script& s, Blackboard& board);

inline Value assign(const Script& s, Blackboard& board) {
  const std::string& name = s.kids[0].name;
  if (!board.contains(name)) {
    if (s.sign != ":=") throw Thrown("no entry");
    board[name] = {};
  }
  const Value value = run(s.kids[1], board);
  if (value.index() == 0) throw Thrown("empty");
  Value& held = board[name];
  if (s.sign == ":=" || s.sign == "=") return held = stored(held, value);
  if (held.index() == 0) throw Thrown("empty");
  if (is_text(value)) {
    if (s.sign != "+=") throw Thrown("not for texts");
    const std::string joined = as_text(held) + as_text(value);
    if (!is_text(held)) throw Thrown("type");
    return held = joined;
  }
  if (!is_number(held)) throw Thrown("no number");
  return held = stored(held, binary(s.sign.substr(0, 1), as_double(held),
                                    as_double(value)));
}

inline Value run(const Script& s, Blackboard& board) {
  if (s.sign == "lit") return s.value;
  if (s.sign == "name") {
    const auto found = board.find(s.name);
    if (found == board.end()) throw Thrown("no entry");
    return found->second;
  }
  if (s.sign == "?") {
    const Value condition = run(s.kids[0], board);
    return run(s.kids[as_double(condition) != 0 ? 1 : 2], board);
  }
  if (s.sign == "cmp") {
    Value left = run(s.kids[0], board);
    for (std::size_t i = 0; i < s.chain.size(); ++i) {
      Value right = run(s.kids[i + 1], board);
      if (!compared(s.chain[i], left, right)) return 0.0;
      left = std::move(right);
    }
    return 1.0;
  }
  if (s.sign == ":=" || s.sign == "=" || s.sign == "+=" || s.sign == "-=" ||
      s.sign == "*=" || s.sign == "/=") {
    return assign(s, board);
  }
  const Value left = run(s.kids[0], board);
  if (s.kids.size() == 1) {
    if (!is_number(left)) throw Thrown("no number");
    const double number = as_double(left);
    if (s.sign == "-") return -number;
    if (s.sign == "!") return double(number == 0);
    if (std::abs(number) > 0x1p63) throw Thrown("out of range");
    return static_cast<double>(~static_cast<std::int64_t>(number));
  }
  const Value right = run(s.kids[1], board);
  return binary(s.sign, left, right);
}

inline std::string Script::text() const {
  if (sign == "name") return name;
  if (sign == "lit") {
    if (is_text(value)) return "'" + as_text(value) + "'";
    return as_text(value);
  }
  const auto inner = [](const Script& kid) {
    const bool is_atom = kid.kids.empty();
    return is_atom ? kid.text() : "(" + kid.text() + ")";
  };
  if (sign == "?") {
    return inner(kids[0]) + " ? " + inner(kids[1]) + " : " + inner(kids[2]);
  }
  if (kids.size() == 1) return sign + inner(kids[0]);
  std::string all = inner(kids[0]);
  for (std::size_t i = 1; i < kids.size(); ++i) {
    all += " " + (sign == "cmp" ? chain[i - 1] : sign) + " " + inner(kids[i]);
  }
  return all;
}

// "1", "0.5", "-1.0", "'idle'", or "nothing".
inline std::string shown(const Value& v) {
  if (is_text(v)) return "'" + as_text(v) + "'";
  if (const auto* i = std::get_if<std::int64_t>(&v)) return std::to_string(*i);
  const auto* d = std::get_if<double>(&v);
  if (d == nullptr) return "nothing";
  if (std::isnan(*d)) return "nan";
  std::array<char, 40> digits{};
  std::snprintf(digits.data(), digits.size(), "%.17g", *d);
  const std::string text = digits.data();
  return text.find_first_of(".en") == text.npos ? text + ".0" : text;
}

// What becomes of the statements, on a blackboard without entries: "throws", or
// whether the last value is "true", "false" or "no truth", and the entries.
inline std::string outcome(const std::vector<Script>& statements) {
  Blackboard board;
  std::string told;
  try {
    Value last;
    for (const Script& each : statements) last = run(each, board);
    try {
      told = as_truth(last) ? "true" : "false";
    } catch (const Thrown&) {
      told = "no truth";
    }
  } catch (const Thrown&) {
    return "throws";
  }
  for (const auto& [name, value] : board) {
    told += " " + name + "=" + shown(value);
  }
  return told;
}

}  // namespace btcheck::script_engine
