// SPDX-License-Identifier: MIT
//
// The enumerators that a program registers for its scripts, as they are
// declared beside a tree. BehaviorTree.CPP has no form for them in XML, and
// takes no notice of ours.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"
#include "text/findings.hpp"

namespace btcheck::btcpp {

// Their numbers, by their names (BehaviorTreeFactory::registerScriptingEnum of
// BehaviorTree.CPP 4).
using ScriptEnums = std::map<std::string, int, std::less<>>;

// Those of a document; nullptr where there are none. They stand beside its
// models, as what is told of a model without an ID, which no node can have.
std::shared_ptr<const ScriptEnums> enumerators_of(
    const BtcppDocument& document);

// Adds one; the number that it has already, where that is another.
std::optional<int> add_enumerator(std::vector<BtcppModel>& models,
                                  std::string_view name, int number);

// What to say where it has another.
Wording two_numbers_of(std::string_view name, int here, int elsewhere);

}  // namespace btcheck::btcpp
