// SPDX-License-Identifier: MIT
#include "model/btcpp/script/tree.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace btcheck::btcpp {
namespace {

constexpr double kLargestExact = 9007199254740991;  // 2^53 - 1

template <class Rows>
auto named(const Rows& rows, std::string_view sign)
    -> std::optional<decltype(rows[0].second)> {
  for (const auto& [name, value] : rows) {
    if (name == sign) return value;
  }
  return std::nullopt;
}

template <class Row, std::size_t count>
using Signs = std::array<std::pair<std::string_view, Row>, count>;

bool begins_hexadecimal(std::string_view written) {
  return written.starts_with("0x") || written.starts_with("0X");
}

}  // namespace

std::optional<ScriptOperation> binary_operation(std::string_view sign) {
  using enum ScriptOperation;
  static constexpr Signs<ScriptOperation, 16> kSigns = {{{"+", Add},
                                                         {"-", Subtract},
                                                         {"*", Multiply},
                                                         {"/", Divide},
                                                         {"..", Join},
                                                         {"&", BitAnd},
                                                         {"|", BitOr},
                                                         {"^", BitXor},
                                                         {"&&", And},
                                                         {"||", Or},
                                                         {":=", Create},
                                                         {"=", Set},
                                                         {"+=", SetSum},
                                                         {"-=", SetDifference},
                                                         {"*=", SetProduct},
                                                         {"/=", SetQuotient}}};
  return named(kSigns, sign);
}

std::optional<ScriptComparison> comparison_named(std::string_view sign) {
  using enum ScriptComparison;
  static constexpr Signs<ScriptComparison, 6> kSigns = {{{"==", Equal},
                                                         {"!=", NotEqual},
                                                         {"<", Less},
                                                         {"<=", LessEqual},
                                                         {">", Greater},
                                                         {">=", GreaterEqual}}};
  return named(kSigns, sign);
}

bool is_integer_literal(std::string_view written) {
  return begins_hexadecimal(written) ||
         written.find_first_of(".eE") == written.npos;
}

std::optional<double> script_number(std::string_view written) {
  const char* end = written.data() + written.size();
  if (!is_integer_literal(written)) {
    double value = 0;
    const auto read = std::from_chars(written.data(), end, value);
    if (read.ec != std::errc() || !std::isfinite(value)) return std::nullopt;
    return value;
  }
  const bool is_hexadecimal = begins_hexadecimal(written);
  if (is_hexadecimal) written.remove_prefix(2);
  std::int64_t value = 0;
  const auto read =
      std::from_chars(written.data(), end, value, is_hexadecimal ? 16 : 10);
  const auto real = static_cast<double>(value);
  if (read.ec != std::errc() || real > kLargestExact) return std::nullopt;
  return real;
}

}  // namespace btcheck::btcpp
