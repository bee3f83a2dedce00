// SPDX-License-Identifier: MIT
#include "model/btcpp/enumerators.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/numbers.hpp"

namespace btcheck::btcpp {

std::shared_ptr<const ScriptEnums> enumerators_of(
    const BtcppDocument& document) {
  const BtcppModel* told = document.model("");
  if (told == nullptr) return nullptr;
  auto all = std::make_shared<ScriptEnums>();
  for (const auto& [name, number] : told->metadata) {
    all->emplace(name, as_number<int>(number).value_or(0));
  }
  return all;
}

std::optional<int> add_enumerator(std::vector<BtcppModel>& models,
                                  std::string_view name, int number) {
  auto told = std::ranges::find(models, "", &BtcppModel::id);
  if (told == models.end()) told = models.emplace(told);
  auto& all = told->metadata;
  const auto same =
      std::ranges::find(all, name, &std::pair<std::string, std::string>::first);
  if (same == all.end()) {
    all.emplace_back(name, std::to_string(number));
    return std::nullopt;
  }
  const int first = as_number<int>(same->second).value_or(0);
  return first == number ? std::nullopt : std::optional(first);
}

Wording two_numbers_of(std::string_view name, int here, int elsewhere) {
  return {
      "BT1658",
      fmt::format("`{}` is {} here and {} elsewhere", name, here, elsewhere),
      "declared again here",
      "a program registers it with one number: delete the wrong one"};
}

}  // namespace btcheck::btcpp
