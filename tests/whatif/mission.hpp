// SPDX-License-Identifier: MIT
//
// Missions whose faults are known, searched.
#pragma once

#include <doctest/doctest.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/whatif/whatif.hpp"
#include "report/whatif/runs.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// A picture that nobody misses, an upload that is tried three times, and a dock
// that is only asked where the other one fails.
inline constexpr std::string_view kPictures =
    R"(<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <Sequence>
      <Action ID="Undock"/>
      <ForceSuccess><Action ID="TakePicture"/></ForceSuccess>
      <RetryUntilSuccessful num_attempts="3"><Action ID="Upload"/></RetryUntilSuccessful>
      <Fallback><Action ID="DockFront"/><Action ID="DockBack"/></Fallback>
      <Timeout msec="1000"><Action ID="Charge"/></Timeout>
    </Sequence>
  </BehaviorTree>
  <TreeNodesModel>
    <Action ID="Undock"/><Action ID="TakePicture"/><Action ID="Upload"/>
    <Action ID="DockFront"/><Action ID="DockBack"/><Action ID="Charge"/>
  </TreeNodesModel>
</root>
)";

// It must not be moved from where it is made: the report points into it.
class SearchedMission {
 public:
  explicit SearchedMission(std::string_view tree, WhatIfOptions how = {},
                           const std::string& rules = "",
                           const std::string& name = "t.xml")
      : file_(InputFile{name, std::string(tree)}) {
    std::vector<InputFile> files;
    if (!rules.empty()) files.push_back({"t.ltl", rules});
    auto read = what_if_input(file_, files);
    for (const Diagnostic& each : read.diagnostics) INFO(render(each));
    REQUIRE(read.value.has_value());
    input_.emplace(std::move(*read.value));
    auto found = what_if(*input_, how);
    REQUIRE(found.value.has_value());
    result_.emplace(std::move(*found.value));
  }
  SearchedMission(const SearchedMission&) = delete;
  SearchedMission& operator=(const SearchedMission&) = delete;

  const BehaviorTree& tree() const { return input_->tree; }
  WhatIf& result() { return *result_; }
  WhatIfReport report() const { return {file_, *input_, *result_}; }

  // The number of the row of that fault; 0 where there is none.
  std::size_t number(std::string_view leaf, FaultKind kind) const {
    for (std::size_t i = 0; i < result_->rows.size(); ++i) {
      const InjectedFault& fault = result_->rows[i].faults[0];
      if (input_->tree.node(fault.leaf).name == leaf &&
          fault.fault.kind == kind) {
        return i + 1;
      }
    }
    return 0;
  }

 private:
  TreeInput file_;
  std::optional<WhatIfInput> input_;
  std::optional<WhatIf> result_;
};

inline WhatIfOptions with_pairs() {
  WhatIfOptions how;
  how.order = 2;
  return how;
}

}  // namespace btcheck
