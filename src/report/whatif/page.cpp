// SPDX-License-Identifier: MIT
//
// The page is a form with gaps, and says all but the runs without its script.
// All runs together are packed as one: of a tree with forty leaves there are
// two hundred, and most steps come again in all of them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "report/text/report.hpp"
#include "report/whatif/files.hpp"
#include "report/whatif/groups.hpp"
#include "report/whatif/words.hpp"
#include "text/json.hpp"
#include "text/utf8.hpp"
#include "trace/viewer/html.hpp"
#include "trace/viewer/packed.hpp"

namespace btcheck {
namespace {

// So many pairs have their run on the page, the worst.
constexpr std::size_t kMostPairRuns = 100;

constexpr std::array<std::string_view, kHarms> kSigns = {
    "S", "N", "R", "L", "X", "F", "M", "✓", "–", "?"};
std::string_view sign_of(Harm harm) {
  return kSigns[static_cast<std::size_t>(harm)];
}

class HtmlPage {
 public:
  explicit HtmlPage(const WhatIfReport& report)
      : report_(report), tree_(report.tree()), result_(report.result) {}

  std::string take() const {
    const std::string title =
        fmt::format("what breaks · {}", unbroken(harmless(tree_.file)));
    return filled(
        kWhatIfPage,
        {{"{{title}}", with_entities(title)},
         {"{{style}}", std::string(kWhatIfStyle)},
         {"{{heading}}",
          with_code(fmt::format(
              "{}: what the mission does when something breaks", tree_.file))},
         {"{{score}}", with_code(score_text(result_.score()))},
         {"{{about}}", about()},
         {"{{legend}}", legend()},
         {"{{matrix}}", matrix()},
         {"{{rows}}", list(1, result_.rows.size())},
         {"{{pairs}}", pairs()},
         {"{{events}}", events()},
         {"{{parts}}", parts()},
         {"{{data}}", data()},
         {"{{script}}", std::string(kWhatIfScript)}});
  }

 private:
  static std::string paragraph(std::string_view text) {
    return fmt::format("<p class=\"about\">{}</p>\n", with_code(text));
  }

  std::string about() const {
    std::string text = paragraph(healthy_text(result_));
    const auto& guessed = result_.possible.guessed;
    if (!guessed.empty()) {
      text +=
          paragraph(fmt::format("Taken for conditions, by their names: {}.",
                                names_in_text(tree_, guessed, guessed.size())));
    }
    for (const OmittedFaults& each : result_.possible.left_out) {
      text += paragraph(fmt::format(
          "Left out, as {}: {} of {}.", each.why, kind_words(each.kinds),
          names_in_text(tree_, each.leaves, each.leaves.size())));
    }
    if (result_.stopped != StopReason::None) {
      text += paragraph(
          "UNDECIDED: a limit was reached before all was "
          "searched.");
    }
    return text;
  }

  static std::string sign(Harm harm) {
    return fmt::format("<span class=\"sign {}\" aria-hidden=\"true\">{}</span>",
                       facts_of(harm).word, sign_of(harm));
  }

  std::string legend() const {
    const Score score = result_.score();
    std::string text;
    for (std::size_t h = 0; h < kHarms; ++h) {
      const auto harm = static_cast<Harm>(h);
      if (score.of_harm(harm) == 0) continue;
      text += fmt::format("<li>{} {} ({})</li>", sign(harm),
                          with_code(heading_of(harm)), score.of_harm(harm));
    }
    return text;
  }

  std::string matrix() const {
    std::map<NodeId, std::map<FaultKind, std::size_t>> numbers;
    std::map<FaultKind, bool> used;
    for (std::size_t i = 0; i < result_.rows.size(); ++i) {
      const InjectedFault& fault = result_.rows[i].faults[0];
      numbers[fault.leaf][fault.fault.kind] = i + 1;
      used[fault.fault.kind] = true;
    }
    std::string text =
        "<table class=\"matrix\"><thead><tr><th scope=\"col\"><span>leaf"
        "</span></th>";
    for (const auto& [kind, is_used] : used) {
      text += fmt::format("<th scope=\"col\" title=\"{}\"><span>{}</span></th>",
                          facts_of(kind).told, facts_of(kind).word);
    }
    text += "</tr></thead>\n<tbody>";
    for (const auto& [leaf, of_leaf] : numbers) {
      text += fmt::format("<tr><th scope=\"row\" title=\"{}\">{}</th>",
                          with_entities(harmless(path_name(tree_, leaf))),
                          with_code(name_in_text(tree_, leaf)));
      for (const auto& [kind, is_used] : used) {
        const auto found = of_leaf.find(kind);
        text += found == of_leaf.end()
                    ? "<td></td>"
                    : fmt::format("<td>{}</td>", field(found->second));
      }
      text += "</tr>\n";
    }
    return text + "</tbody></table>";
  }

  std::string field(std::size_t number) const {
    const FaultRow& row = row_numbered(result_, number);
    const std::string told = with_entities(unbroken(harmless(fmt::format(
        "{}: {}: {}", number, faults_text(tree_, row), heading_of(row.harm)))));
    return fmt::format(
        "<button type=\"button\" class=\"sign {}\" data-row=\"{}\" "
        "title=\"{}\" aria-label=\"{}\">{}</button>",
        facts_of(row.harm).word, number, told, told, sign_of(row.harm));
  }

  // Of these rows.
  std::string list(std::size_t first, std::size_t last) const {
    std::string text =
        "<table class=\"list\"><thead><tr><th>row</th><th></th><th>fault</th>"
        "<th>the mission</th><th>noticed</th><th>and then</th></tr></thead>\n"
        "<tbody>";
    for (std::size_t n = first; n <= last; ++n) {
      const FaultRow& row = row_numbered(result_, n);
      const bool is_noticed = row.faults.size() == 1 && row.effect.strikes;
      text += fmt::format(
          "<tr id=\"row-{}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
          "<td>{}</td><td>{}</td></tr>\n",
          n, n, field(n), with_code(faults_text(tree_, row)),
          with_code(harm_text(tree_, result_, row)),
          is_noticed ? with_code(notice_text(tree_, row)) : "",
          with_code(recovery_text(tree_, row)));
    }
    return text + "</tbody></table>";
  }

  static std::string section(std::string_view title, const std::string& body) {
    return fmt::format(
        "<section><h2>{}</h2>\n<div class=\"wide\">{}</div>"
        "</section>",
        with_code(title), body);
  }

  std::string pairs() const {
    if (result_.order < 2) return "";
    const std::size_t before = result_.rows.size();
    return section(
        fmt::format("Pairs: {} of {} do what neither fault does alone",
                    result_.pairs.size(), grouped(result_.pairs_in_all)),
        list(before + 1, row_count(result_)));
  }

  std::string events() const {
    std::string text;
    for (const CutSets& cut : result_.cut_sets) {
      if (cut.sets.empty()) continue;
      const std::vector<std::string> said(cut.sets.size());
      text += fmt::format("<p><b>{}</b></p>\n<ul>",
                          with_code(event_text(result_, cut.event)));
      const auto told = [&](const FaultGroup& group) {
        return fmt::format(
            "{} ({})", names_in_text(tree_, group.leaves, group.leaves.size()),
            kind_words(group.kinds));
      };
      for (const FaultGroup& group : grouped_singles(cut.sets, said)) {
        text += fmt::format("<li>{}</li>\n", with_code(told(group)));
      }
      for (const PairGroup& group : grouped_pairs(cut.sets, said)) {
        text += fmt::format("<li>{} <b>and</b> {}</li>\n",
                            with_code(told(group.first)),
                            with_code(told(group.second)));
      }
      text += "</ul>\n";
    }
    return text.empty() ? ""
                        : section(
                              "What makes it happen: single points of "
                              "failure, then pairs",
                              text);
  }

  std::string parts() const {
    std::string text = "<table class=\"list\"><tbody>";
    std::size_t count = 0;
    for (const NodeId part : scored_parts(tree_)) {
      const Score score = result_.score_below(tree_, part);
      if (score.total() == 0) continue;
      ++count;
      text += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n",
                          with_code(name_in_text(tree_, part)),
                          with_code(score_text(score)));
    }
    return count == 0 ? "" : section("Part by part", text + "</tbody></table>");
  }

  // {"shared", "runs" by row, "viewer"}.
  std::string data() const {
    const std::size_t last =
        result_.rows.size() + std::min(result_.pairs.size(), kMostPairRuns);
    Json runs = Json::object();
    Json shared = Json::object();
    std::optional<RecordedRun> first;
    std::optional<RunPacker> packer;
    bool has_long = false;
    for (std::size_t n = 1; n <= last; ++n) {
      std::optional<RecordedRun> run = run_of_row(report_, n);
      if (!run) continue;
      has_long |= run->states.size() > kLongRun;
      const bool is_first = !packer;
      if (is_first) {
        first = std::move(run);
        packer.emplace(*first);
        shared = packer->shared();
      } else {
        packer->begin(*run);
      }
      Json document = Json::object();
      packer->add_own(document);
      packer->add(is_first ? first->states : run->states, document);
      runs.add(fmt::format("{}", n), document);
    }
    return safe_json(Json{
        {"shared", shared}, {"runs", runs}, {"viewer", viewer_form(has_long)}});
  }

  const WhatIfReport& report_;
  const BehaviorTree& tree_;
  const WhatIf& result_;
};

}  // namespace

std::string what_if_page(const WhatIfReport& report) {
  return HtmlPage(report).take();
}

}  // namespace btcheck
