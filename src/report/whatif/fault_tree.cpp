// SPDX-License-Identifier: MIT
//
// A tree for each event that must not be: an OR over the single faults that
// make it happen, and over the pairs, each an AND. For people faults of a leaf
// are together; for programs each is an event of its own.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "report/text/report.hpp"
#include "report/whatif/files.hpp"
#include "report/whatif/groups.hpp"
#include "report/whatif/words.hpp"
#include "text/utf8.hpp"
#include "trace/pictures/pictures.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// What stands in a box: a gate with what is below it, or faults.
struct TreeBox {
  std::string_view gate;           // "OR", "AND"; "" for faults
  std::vector<std::string> lines;  // what is written in it
  std::vector<TreeBox> below;
};

// A picture with more of them nobody looks at.
constexpr std::size_t kMostDrawn = 60;

class Boxes {
 public:
  explicit Boxes(const WhatIfReport& report)
      : tree_(report.tree()), result_(report.result) {}

  std::vector<TreeBox> take() const {
    std::vector<TreeBox> tops;
    for (const CutSets& cut : result_.cut_sets) {
      if (!cut.sets.empty()) tops.push_back(top_of(cut));
    }
    return tops;
  }

 private:
  TreeBox top_of(const CutSets& cut) const {
    TreeBox top{"OR", {event_text(result_, cut.event)}, {}};
    const std::vector<std::string> said(cut.sets.size());
    std::size_t left_out = 0;
    const auto add = [&](TreeBox box, std::size_t sets) {
      if (top.below.size() < kMostDrawn) {
        top.below.push_back(std::move(box));
      } else {
        left_out += sets;
      }
    };
    for (const FaultGroup& group : grouped_singles(cut.sets, said)) {
      add(faults(group), group.places.size());
    }
    for (const PairGroup& group : grouped_pairs(cut.sets, said)) {
      add({"AND", {}, {faults(group.first), faults(group.second)}},
          group.places.size());
    }
    if (left_out > 0) {
      top.below.push_back(
          {"",
           {fmt::format("and {}", counted(left_out, "more set", "more sets"))},
           {}});
    }
    return top;
  }

  TreeBox faults(const FaultGroup& group) const {
    constexpr std::size_t kMostLeaves = 6;
    constexpr std::size_t kLongest = 60;
    TreeBox box;
    for (const NodeId leaf : group.leaves) {
      if (box.lines.size() == kMostLeaves) {
        box.lines.push_back(
            fmt::format("or {} more", group.leaves.size() - kMostLeaves));
        break;
      }
      box.lines.push_back(
          fmt::format("{}{}", box.lines.empty() ? "" : "or ",
                      shortened(one_line(short_name(tree_, leaf)), kLongest)));
    }
    box.lines.push_back(shortened(kinds_text(group.kinds), kLongest));
    return box;
  }

  const BehaviorTree& tree_;
  const WhatIf& result_;
};

// --- Graphviz
// -----------------------------------------------------------------

std::string dot_label(const TreeBox& box) {
  std::string label;
  const auto add = [&](std::string_view line) {
    const std::string part = btcheck::quoted(line);
    label += (label.empty() ? "" : "\\n") + part.substr(1, part.size() - 2);
  };
  for (const std::string& line : box.lines) add(line);
  if (!box.gate.empty()) add(box.gate);
  return label;
}

void add_dot(const TreeBox& box, std::size_t& next, std::string& text) {
  const std::size_t own = next++;
  const std::string_view look = box.gate.empty()    ? ", style=rounded"
                                : box.gate == "AND" ? ", shape=invhouse"
                                                    : ", style=bold";
  text += fmt::format("  n{} [label=\"{}\"{}];\n", own, dot_label(box), look);
  for (const TreeBox& below : box.below) {
    text += fmt::format("  n{} -> n{};\n", own, next);
    add_dot(below, next, text);
  }
}

// --- A picture
// ----------------------------------------------------------------

constexpr double kMargin = 16;
constexpr double kLine = 15;
constexpr double kPadding = 7;
constexpr double kGap = 10;
constexpr double kColumnGap = 36;

double width_of(const TreeBox& box) {
  std::size_t longest = 3;
  for (const std::string& line : box.lines) {
    longest = std::max(longest, letter_count(line));
  }
  return 2 * kPadding + static_cast<double>(longest) * kLetterWidth;
}
double height_of(const TreeBox& box) {
  const std::size_t lines = box.lines.size() + (box.gate.empty() ? 0 : 1);
  return 2 * kPadding + static_cast<double>(lines) * kLine - 3;
}

class Picture {
 public:
  std::string take(const std::vector<TreeBox>& tops, std::string_view title) {
    for (const TreeBox& top : tops) measure(top, 0);
    double y = kMargin + kLine + kGap;
    for (const TreeBox& top : tops) y = place(top, 0, y).bottom + kLine;
    double width = kMargin;
    for (const double column : columns_) width += column + kColumnGap;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" "
        "height=\"{1:g}\" viewBox=\"0 0 {0:g} {1:g}\" role=\"img\" "
        "font-family=\"DejaVu Sans Mono, Menlo, Consolas, monospace\" "
        "font-size=\"11\" fill=\"#1b232c\">\n<title>{2}</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
        "<text x=\"{3:g}\" y=\"{4:g}\" font-weight=\"bold\">{2}</text>\n"
        "{5}</svg>\n",
        std::max(width, 2 * kMargin + static_cast<double>(letter_count(title)) *
                                          (kLetterWidth + 1)),
        y, xml_escaped(title), kMargin, kMargin + kLine - 4, drawn_);
  }

 private:
  struct Placed {
    double middle = 0;
    double bottom = 0;
  };

  void measure(const TreeBox& box, std::size_t depth) {
    if (columns_.size() <= depth) columns_.resize(depth + 1, 0);
    columns_[depth] = std::max(columns_[depth], width_of(box));
    for (const TreeBox& below : box.below) measure(below, depth + 1);
  }

  double left_of(std::size_t depth) const {
    double x = kMargin;
    for (std::size_t i = 0; i < depth; ++i) x += columns_[i] + kColumnGap;
    return x;
  }

  Placed place(const TreeBox& box, std::size_t depth, double y) {
    const double height = height_of(box);
    const double x = left_of(depth);
    std::vector<double> middles;
    double below = y;
    for (const TreeBox& child : box.below) {
      const Placed placed = place(child, depth + 1, below);
      middles.push_back(placed.middle);
      below = placed.bottom + kGap;
    }
    const double reach = middles.empty() ? 0 : below - kGap - y;
    const double top =
        middles.empty()
            ? y
            : std::max(y, (middles.front() + middles.back() - height) / 2);
    const double middle = top + height / 2;
    const double from = x + width_of(box);
    const double to = left_of(depth + 1);
    for (const double child : middles) {
      drawn_ += fmt::format(
          "<path d=\"M{0:g} {1:g}C{2:g} {1:g} {2:g} {3:g} {4:g} {3:g}\" "
          "fill=\"none\" stroke=\"#aab3bd\"/>\n",
          from, middle, (from + to) / 2, child, to);
    }
    draw(box, x, top, height);
    return {middle, y + std::max(reach, top - y + height)};
  }

  void draw(const TreeBox& box, double x, double y, double height) {
    const bool is_gate = !box.gate.empty();
    const std::string_view fill = !is_gate            ? "#ffffff"
                                  : box.gate == "AND" ? "#e4ecf7"
                                                      : "#fdecd2";
    drawn_ += fmt::format(
        "<rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" "
        "rx=\"{:g}\" fill=\"{}\" stroke=\"{}\"/>\n",
        x, y, width_of(box), height, is_gate ? 2.0 : 8.0, fill, kLineColor);
    double line = y + kPadding + kLine - 6;
    const auto write = [&](std::string_view text, std::string_view look) {
      drawn_ += fmt::format("<text x=\"{:g}\" y=\"{:g}\"{}>{}</text>\n",
                            x + kPadding, line, look, xml_escaped(text));
      line += kLine;
    };
    for (const std::string& text : box.lines) write(text, "");
    if (is_gate) write(box.gate, " font-weight=\"bold\"");
  }

  std::vector<double> columns_;
  std::string drawn_;
};

// --- Open-PSA
// -----------------------------------------------------------------

class MefModel {
 public:
  explicit MefModel(const WhatIfReport& report)
      : tree_(report.tree()), result_(report.result) {}

  std::string take() {
    std::string trees;
    for (std::size_t i = 0; i < result_.cut_sets.size(); ++i) {
      const CutSets& cut = result_.cut_sets[i];
      if (!cut.sets.empty()) trees += fault_tree(cut, i + 1);
    }
    std::string data;
    for (const auto& [name, label] : events_) {
      data += fmt::format(
          "    <define-basic-event name=\"{}\">\n      <label>{}</label>\n"
          "    </define-basic-event>\n",
          name, label);
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<opsa-mef>\n"
        "  <label>{}: what makes the mission fail</label>\n{}"
        "  <model-data>\n{}  </model-data>\n</opsa-mef>\n",
        xml_escaped(tree_.file), trees, data);
  }

 private:
  std::string fault_tree(const CutSets& cut, std::size_t number) {
    const std::string name = fmt::format("event-{}", number);
    std::string top;
    std::string gates;
    std::size_t pairs = 0;
    for (const auto& set : cut.sets) {
      if (set.size() == 1) {
        top +=
            fmt::format("        <basic-event name=\"{}\"/>\n", event(set[0]));
        continue;
      }
      const std::string gate = fmt::format("{}-pair-{}", name, ++pairs);
      top += fmt::format("        <gate name=\"{}\"/>\n", gate);
      gates +=
          fmt::format("    <define-gate name=\"{}\">\n      <and>\n", gate);
      for (const InjectedFault& fault : set) {
        gates +=
            fmt::format("        <basic-event name=\"{}\"/>\n", event(fault));
      }
      gates += "      </and>\n    </define-gate>\n";
    }
    return fmt::format(
        "  <define-fault-tree name=\"{0}\">\n    <label>{1}</label>\n"
        "    <define-gate name=\"{0}-top\">\n      <label>{1}</label>\n"
        "      <or>\n{2}      </or>\n    </define-gate>\n{3}"
        "  </define-fault-tree>\n",
        name, xml_escaped(event_text(result_, cut.event)), top, gates);
  }

  // Letters, digits, `_`, and `-` between them: what the format takes.
  std::string event(const InjectedFault& fault) {
    const std::string name = fmt::format(
        "n{}_{}-{}", index(fault.leaf), plain_word(tree_.node(fault.leaf).name),
        facts_of(fault.fault.kind).word);
    events_.emplace(
        name, xml_escaped(fmt::format("{} {}", short_name(tree_, fault.leaf),
                                      facts_of(fault.fault.kind).told)));
    return name;
  }

  const BehaviorTree& tree_;
  const WhatIf& result_;
  std::map<std::string, std::string> events_;
};

std::string title_of(const WhatIfReport& report) {
  return fmt::format("{}: what makes the mission fail",
                     one_line(report.tree().file));
}

}  // namespace

std::string fault_tree_dot(const WhatIfReport& report) {
  std::string text = fmt::format(
      "digraph faults {{\n  rankdir=LR;\n  label={};\n  labelloc=t;\n"
      "  fontname=\"Helvetica\";\n"
      "  node [shape=box, fontname=\"Helvetica\", fontsize=10, height=0.3, "
      "color=\"{}\"];\n  edge [color=\"{}\", arrowsize=0.5];\n",
      btcheck::quoted(title_of(report)), kLineColor, kLineColor);
  std::size_t next = 0;
  for (const TreeBox& top : Boxes(report).take()) add_dot(top, next, text);
  return text + "}\n";
}

std::string fault_tree_svg(const WhatIfReport& report) {
  return Picture().take(Boxes(report).take(), title_of(report));
}

std::string fault_tree_xml(const WhatIfReport& report) {
  return MefModel(report).take();
}

}  // namespace btcheck
