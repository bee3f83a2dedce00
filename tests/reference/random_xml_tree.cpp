// SPDX-License-Identifier: MIT
#include "reference/random_xml_tree.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "reference/random_tree.hpp"
#include "reference/random_xml_nodes.hpp"

namespace btcheck::reference {
namespace {

class Writer {
 public:
  Writer(std::uint64_t seed, Profile profile)
      : random_(seed),
        profile_(profile),
        inner_(inner_nodes(profile, World::Open)),
        left_(3 + random_.below(9)) {}

  std::string text() {
    // Compact tags with their models: some releases refuse the explicit form
    // directly in a ReactiveSequence.
    const std::string tree = node(0);
    std::string models;
    for (int i = 1; i <= actions_; ++i) {
      models += fmt::format("<Action ID=\"a{}\"/>", i);
    }
    for (int i = 1; i <= conditions_; ++i) {
      models += fmt::format("<Condition ID=\"c{}\"/>", i);
    }
    return fmt::format(
        "<root BTCPP_format=\"{}\">\n<BehaviorTree ID=\"T\">\n{}"
        "</BehaviorTree>\n<TreeNodesModel>{}</TreeNodesModel>\n</root>\n",
        is_release_3(profile_) ? 3 : 4, tree, models);
  }

 private:
  std::string node(int depth) {
    --left_;
    if (depth > 0 && (left_ <= 0 || depth >= 5 || random_.percent(30))) {
      return leaf();
    }
    const InnerNode& inner = inner_[static_cast<std::size_t>(
        random_.below(static_cast<int>(inner_.size())))];
    std::string ports(inner.ports);
    for (char& c : ports) {
      if (c == '#') c = static_cast<char>('1' + random_.below(2));
      if (c == '?') c = 'p';
      if (c == '$') c = 'e';
    }
    std::string text = fmt::format("<{}{}{}>\n", inner.id, ports, conditions());
    const int count = inner.least + random_.below(inner.most - inner.least + 1);
    for (int i = 0; i < count; ++i) text += node(depth + 1);
    return text + fmt::format("</{}>\n", inner.id);
  }

  std::string leaf() {
    const int kind = random_.below(has_nav2(profile_) ? 10 : 8);
    if (kind < 5) {
      return fmt::format("<a{}{}/>\n", ++actions_, conditions());
    }
    if (kind < 8 && !is_release_3(profile_) && random_.percent(25)) {
      const int duration = 1 + random_.below(2);
      return fmt::format("<Sleep msec=\"{}00\"{}/>\n", duration, conditions());
    }
    if (kind < 8) {
      return fmt::format("<c{}{}/>\n", ++conditions_, conditions());
    }
    constexpr std::array<std::string_view, 4> kNav2 = {
        "GoalUpdated", "GlobalUpdatedGoal", "PathExpiringTimer",
        "TransformAvailable"};
    return fmt::format(
        "<{}/>\n",
        kNav2[static_cast<std::size_t>(random_.below(kNav2.size()))]);
  }

  std::string conditions() {
    if (is_release_3(profile_) || !random_.percent(25)) return "";
    constexpr std::array<std::string_view, 4> kNames = {
        "_failureIf", "_successIf", "_skipIf", "_while"};
    std::string text;
    for (const std::string_view name : kNames) {
      const bool is_skip = name == "_skipIf" || name == "_while";
      if (random_.percent(is_skip ? 50 : 15)) {
        text += fmt::format(" {}=\"x{}\"", name, ++entries_);
      }
    }
    return text;
  }

  SplitMix64 random_;
  Profile profile_;
  std::vector<InnerNode> inner_;
  int left_;
  int actions_ = 0;
  int conditions_ = 0;
  int entries_ = 0;
};

}  // namespace

std::string random_xml_tree(std::uint64_t seed, Profile profile) {
  return Writer(seed, profile).text();
}

}  // namespace btcheck::reference
