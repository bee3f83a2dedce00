// SPDX-License-Identifier: MIT
//
// The page is a form with gaps. It says all but who is pointed at without its
// script; the run of each tree stands in a viewer of its own.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "model/tree/node_types.hpp"
#include "report/diff/told.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"
#include "trace/viewer/html.hpp"

namespace btcheck {
namespace {

// As many as the style sheet has.
constexpr std::size_t kHues = 24;
constexpr int kDepths = 20;

class PageOfTwo {
 public:
  explicit PageOfTwo(const DiffReport& report)
      : report_(report), diff_(report.diff) {
    const BehaviorTree& one = diff_.sides[0].tree;
    const BehaviorTree& other = diff_.sides[1].tree;
    pairs_ = paired(one, all_nodes(one), other, all_nodes(other));
    pair_roots(one, other);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (!pairs_[i].one || !pairs_[i].other) continue;
      pair_of_[0][*pairs_[i].one] = i;
      pair_of_[1][*pairs_[i].other] = i;
    }
    for (const WatchedPair& each : diff_.watched) {
      if (each.otherwise.empty()) continue;
      otherwise_.insert(*each.nodes.one);
    }
  }

  std::string take() const {
    const auto& [one, other] = report_.names;
    return filled(
        kDiffPage,
        {{"{{title}}", with_entities(unbroken(
                           harmless(fmt::format("{} beside {}", one, other))))},
         {"{{style}}", std::string(kDiffStyle)},
         {"{{heading}}", with_code(fmt::format("{} beside {}", one, other))},
         {"{{class}}", std::string(report_.verdict())},
         {"{{verdict}}", with_code(verdict_text(report_))},
         {"{{run}}", run()},
         {"{{changes}}", changes()},
         {"{{trees}}", tree(0) + tree(1)},
         {"{{viewers}}", viewers()},
         {"{{script}}", std::string(kDiffScript)}});
  }

 private:
  // Whatever they are called: in their order, as they are compared.
  void pair_roots(const BehaviorTree& one, const BehaviorTree& other) {
    const auto is_root = [](const BehaviorTree& tree,
                            const std::optional<NodeId>& node) {
      return node && tree.node(*node).is_root();
    };
    std::erase_if(pairs_, [&](const NodePair& pair) {
      return is_root(one, pair.one) || is_root(other, pair.other);
    });
    for (std::size_t i = 0; i < std::min(one.roots.size(), other.roots.size());
         ++i) {
      pairs_.insert(pairs_.begin() + static_cast<std::ptrdiff_t>(i),
                    {one.roots[i], other.roots[i]});
    }
  }

  static std::string section(std::string_view title, const std::string& body) {
    return fmt::format("<section><h2>{}</h2>\n{}</section>\n", with_code(title),
                       body);
  }

  std::string run() const {
    const std::vector<DiffRow> rows = rows_of(report_);
    if (rows.empty()) return "";
    std::string text = fmt::format(
        "<table><thead><tr><th scope=\"col\">tick</th><th scope=\"col\">{}</th>"
        "<th scope=\"col\">{}</th></tr></thead>\n<tbody>",
        with_code(report_.label(0)), with_code(report_.label(1)));
    int tick = 0;
    for (const DiffRow& row : rows) {
      text += fmt::format("<tr{}><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                          row.differs ? " class=\"differs\"" : "",
                          row.tick == tick ? "" : fmt::format("{}", row.tick),
                          with_code(row.cells[0]), with_code(row.cells[1]));
      tick = row.tick;
    }
    return section("What one has and the other has not",
                   text + "</tbody></table>");
  }

  std::string changes() const {
    std::string list;
    const auto add = [&](std::string_view line) {
      list += fmt::format("<li>{}</li>\n", with_code(line));
    };
    const std::string partners = partners_text(report_);
    for (std::size_t at = 0; at < partners.size();) {
      const std::size_t end = partners.find('\n', at);
      add(std::string_view(partners).substr(at, end - at));
      at = end + 1;
    }
    if (report_.changes) {
      for (const DiffChange& each : *report_.changes) add(change_text(each));
      if (report_.changes->empty()) add("no verdict and no finding differs");
    }
    if (list.empty()) return "";
    return section("What else is otherwise",
                   "<ul class=\"changes\">" + list + "</ul>");
  }

  std::string tree(std::size_t side) const {
    const BehaviorTree& own = diff_.sides[side].tree;
    std::string text = fmt::format("<div><h2>{}</h2>\n<ul class=\"tree\">\n",
                                   with_code(report_.names[side]));
    std::vector<int> depth(own.nodes.size(), 0);
    for (std::uint32_t n = 0; n < own.nodes.size(); ++n) {
      const Node& node = own.nodes[n];
      if (!node.is_root()) depth[n] = depth[index(node.parent)] + 1;
      const auto pair = pair_of_[side].find(NodeId{n});
      const bool is_alone = pair == pair_of_[side].end();
      std::string data;
      std::string look = fmt::format("d{}", std::min(depth[n], kDepths));
      if (is_alone) {
        look += " alone";
      } else {
        look += fmt::format(" h{}", pair->second % kHues);
        data = fmt::format(" data-pair=\"{}\" tabindex=\"0\"", pair->second);
      }
      const bool is_otherwise =
          !is_alone && otherwise_.contains(*pairs_[pair->second].one);
      text += fmt::format(
          "<li class=\"node {}{}\"{}><span>{}</span>"
          "<span class=\"type\">{}</span><span class=\"number\">{}</span>"
          "</li>\n",
          look, is_otherwise ? " otherwise" : "", data,
          with_code(stable_name(node)),
          with_code(node.id.empty() || node.id == node.name
                        ? type_name(node.type)
                        : std::string_view(node.id)),
          is_alone ? "only here" : fmt::format("{}", pair->second + 1));
    }
    return text + "</ul></div>\n";
  }

  std::string viewers() const {
    std::string text;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto run = run_of(report_, side);
      if (!run) continue;
      text += section(
          fmt::format("The run in {}", report_.names[side]),
          fmt::format("<iframe title=\"the run in {}\" srcdoc=\"{}\"></iframe>",
                      with_entities(unbroken(harmless(report_.names[side]))),
                      with_entities(html_text(*run))));
    }
    return text;
  }

  const DiffReport& report_;
  const Diff& diff_;
  std::vector<NodePair> pairs_;
  std::array<std::map<NodeId, std::size_t>, 2> pair_of_;
  std::set<NodeId> otherwise_;  // of the one tree
};

}  // namespace

std::string diff_page(const DiffReport& report) {
  return PageOfTwo(report).take();
}

}  // namespace btcheck
