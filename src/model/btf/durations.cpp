// SPDX-License-Identifier: MIT
//
// Durations are counted in ticks. One with a unit is as many ticks as it takes:
// a tick begins at whole multiples of its length, so what ends in between is
// noticed by the next one. XML trees count the same way.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "model/btf/forms.hpp"
#include "model/tree/expression.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck::btf {
namespace {

constexpr int kLongestDuration = 1'000'000;

// The one or two numbers of an interval as it is written.
std::vector<std::string_view> numbers_inside(std::string_view interval) {
  constexpr std::string_view kSeparators = "[], \t";
  std::vector<std::string_view> numbers;
  for (std::size_t at = 0; at < interval.size();) {
    const std::size_t begin = interval.find_first_not_of(kSeparators, at);
    if (begin == std::string_view::npos) break;
    at = std::min(interval.find_first_of(kSeparators, begin), interval.size());
    numbers.push_back(interval.substr(begin, at - begin));
  }
  return numbers;
}

class DurationReader {
 public:
  DurationReader(const Reading& reading, FormId form, std::string_view what)
      : reading_(reading), form_(reading.form(form)), what_(what) {}

  std::optional<Duration> read() {
    const auto words = words_of();
    if (words.empty() || words.size() > 2) return refuse_form();
    const auto least = ticks_of(words.front());
    const bool is_endless =
        words.size() == 2 && equal_ignoring_case(words.back(), "inf");
    const auto most = is_endless ? kEndless : ticks_of(words.back());
    if (has_fraction_) return refuse_fraction();
    if (!least || !most) return refuse_form();
    if (has_unit_ && has_ticks_) {
      return refuse("both ends need a unit, or none", "write `[500ms,2s]`");
    }
    if (*least > *most) {
      return refuse("the least number of ticks comes first",
                    "write `5`, `[2,5]` or `[2,inf]`");
    }
    tell_rounding({*least, *most});
    return Duration{*least, *most};
  }

 private:
  std::vector<std::string_view> words_of() const {
    if (form_.kind == FormKind::Interval) return numbers_inside(form_.text);
    if (!form_.is_list()) return {form_.text};
    std::vector<std::string_view> words;
    for (const FormId item : form_.items) {
      words.push_back(reading_.form(item).text);
    }
    return words;
  }

  std::optional<int> ticks_of(std::string_view word) {
    std::int64_t unit = 0;  // milliseconds
    for (const auto& [name, length] :
         {std::pair<std::string_view, int>{"ms", 1}, {"s", 1000}}) {
      const std::size_t before =
          word.size() - std::min(word.size(), name.size());
      if (unit > 0 || !equal_ignoring_case(word.substr(before), name)) continue;
      unit = length;
      word.remove_suffix(name.size());
    }
    const auto number = decimal_number(word);
    if (!number || number->digits < 0) return std::nullopt;
    (unit > 0 ? has_unit_ : has_ticks_) = true;
    has_fraction_ |= unit == 0 && number->decimals > 0;
    if (unit == 0) return within(number->digits);
    const std::int64_t tick = reading_.tick_ms * power_of_ten(number->decimals);
    const std::int64_t time = number->digits * unit;
    is_rounded_ |= time % tick != 0;
    return within(time / tick + (time % tick != 0 ? 1 : 0));
  }

  static std::optional<int> within(std::int64_t ticks) {
    if (ticks > kLongestDuration) return std::nullopt;
    return static_cast<int>(ticks);
  }

  void tell_rounding(const Duration& ticks) const {
    if (!is_rounded_) return;
    reading_.findings.note(
        form_.span,
        {"BT1025", "not a whole number of ticks",
         fmt::format("counted as {} tick{} of {} ms",
                     ticks.min == ticks.max ? std::to_string(ticks.min)
                                            : duration_text(ticks),
                     ticks.min == 1 && ticks.max == 1 ? "" : "s",
                     reading_.tick_ms),
         ""});
  }

  std::nullopt_t refuse_fraction() const {
    return refuse("ticks are whole",
                  "a time may be a fraction: `500ms`, `[0.5s,2.5s]`");
  }

  std::nullopt_t refuse_form() const {
    return refuse(
        fmt::format("ticks from 0 to {} are needed", kLongestDuration),
        "write `5`, `[2,5]` or `[2,inf]`; with a unit `500ms` or `[0.5s,2s]`");
  }

  std::nullopt_t refuse(std::string label, std::string help) const {
    reading_.error(
        form_.span, "BT1008",
        fmt::format("{} is not {}",
                    form_.is_list() ? std::string("a list")
                                    : fmt::format("`{}`", form_.text),
                    what_),
        std::move(label), std::move(help));
    return std::nullopt;
  }

  const Reading& reading_;
  const Form& form_;
  std::string_view what_;
  bool has_unit_ = false;
  bool has_ticks_ = false;
  bool has_fraction_ = false;  // of ticks
  bool is_rounded_ = false;
};

}  // namespace

std::optional<Duration> read_duration(const Reading& reading, FormId form,
                                      std::string_view what) {
  return DurationReader(reading, form, what).read();
}

}  // namespace btcheck::btf
