// SPDX-License-Identifier: MIT
//
// Nothing is given back unless it says what was read: the same words, tags and
// values, the same comments, and those that allow findings at the same nodes.
#include "style/style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "check/findings/allowances.hpp"
#include "ltl/rules/property.hpp"
#include "model/btcpp/xml_text.hpp"
#include "model/btf/forms.hpp"
#include "model/foreign_format.hpp"
#include "model/tree_file.hpp"
#include "style/forms.hpp"
#include "style/rules.hpp"
#include "style/xml.hpp"
#include "text/findings.hpp"

namespace btcheck {
namespace {

Result<std::string> refused_style(Diagnostic why) {
  return {std::nullopt, {std::move(why)}};
}

// What comments allow at each line, however they are laid out: a number for all
// of it, 0 for nothing.
class Allowances {
 public:
  explicit Allowances(const SourceText& source) {
    const std::string_view text = source.text();
    if (text.find(kAllow) == text.npos) return;
    const auto lines = std::ranges::count(text, '\n') + 1;
    bool is_below_comment = false;
    for (int line = 1; line <= lines; ++line) {
      const std::string written = source.line(line);
      std::string_view allowed = allowed_in(written);
      allowed = allowed.substr(0, allowed.find("-->"));
      allowed = allowed.substr(0, allowed.find_last_not_of(" \t?") + 1);
      const std::size_t above = is_below_comment ? by_line_.back() : 0;
      by_line_.push_back(
          above +
          (allowed.empty() ? 0 : std::hash<std::string_view>()(allowed)));
      is_below_comment = is_comment_line(written);
    }
  }

  std::size_t at(const SourceSpan& span) const {
    const auto line = static_cast<std::size_t>(span.line) - 1;
    return line < by_line_.size() ? by_line_[line] : 0;
  }

 private:
  std::vector<std::size_t> by_line_;
};

// The places where findings can be told.
std::vector<SourceSpan> places_in(
    const std::vector<btcpp::XmlElement>& elements) {
  std::vector<SourceSpan> places;
  for (const btcpp::XmlElement& element : elements) {
    places.push_back(element.span);
    // Their order is no matter.
    std::vector<const btcpp::XmlAttribute*> attributes;
    for (const auto& each : element.attributes) attributes.push_back(&each);
    std::ranges::sort(attributes, {}, &btcpp::XmlAttribute::name);
    for (const auto* each : attributes) places.push_back(each->name_span);
  }
  return places;
}

std::vector<SourceSpan> places_in(const btf::ParsedForms& parsed) {
  std::vector<SourceSpan> places;
  for (const btf::Token& token : parsed.forms.tokens) {
    places.push_back(token.span);
  }
  return places;
}

// The place where a comment would allow something else than before.
std::optional<SourceSpan> lost_allowance(
    const SourceText& before, const std::vector<SourceSpan>& places_before,
    const SourceText& after, const std::vector<SourceSpan>& places_after) {
  const Allowances allowed_before(before);
  const Allowances allowed_after(after);
  for (std::size_t i = 0; i < places_before.size(); ++i) {
    const SourceSpan& place = places_before[i];
    if (allowed_before.at(place) != allowed_after.at(places_after[i])) {
      return place;
    }
  }
  return std::nullopt;
}

Result<std::string> kept_or_refused(const SourceText& source, std::string text,
                                    bool is_kept,
                                    std::optional<SourceSpan> lost) {
  if (!is_kept) {
    return refused_style(file_error(
        "BT0013", std::string(source.name()),
        "this file would say something else in the style of `btcheck fmt`",
        "it is left as it is; please report this"));
  }
  if (!lost) return {std::move(text), {}};
  return refused_style(source.diagnostic(
      Severity::Error, "BT0013", *lost,
      "a comment would allow something else in the style of `btcheck fmt`",
      "other findings would be allowed here",
      "put the comment into a line of its own, right above what it is about"));
}

Result<std::string> styled_xml_file(const InputFile& file,
                                    const SourceText& source) {
  const auto parsed = file.text.parsed<btcpp::ParsedXml>();
  if (!parsed->value) {
    return {std::nullopt, named(parsed->diagnostics, file.name)};
  }
  const auto& elements = *parsed->value;
  const Allowances allowed(source);
  const auto keeps_lines = [&](const btcpp::XmlElement& element) {
    if (allowed.at(element.span) != 0) return true;
    return std::ranges::any_of(element.attributes,
                               [&](const btcpp::XmlAttribute& each) {
                                 return allowed.at(each.name_span) != 0;
                               });
  };
  std::string text = style::styled_xml(source.text(), elements, keeps_lines);
  const btcpp::ParsedXml again(text);
  if (!again.value) return kept_or_refused(source, {}, false, {});
  const SourceText after(file.name, text);
  const bool is_kept = style::said_in_xml(source.text(), elements) ==
                       style::said_in_xml(text, *again.value);
  const auto lost = is_kept ? lost_allowance(source, places_in(elements), after,
                                             places_in(*again.value))
                            : std::nullopt;
  return kept_or_refused(source, std::move(text), is_kept, lost);
}

Result<std::string> styled_forms_file(const InputFile& file,
                                      const SourceText& source) {
  const auto parsed = file.text.parsed<btf::ParsedForms>();
  if (parsed->findings.has_error()) {
    return {std::nullopt, Findings(source, parsed->findings).take()};
  }
  std::string text = style::styled_forms(*parsed);
  const btf::ParsedForms again(text);
  const SourceText after(file.name, text);
  const bool is_kept =
      style::words_and_comments(*parsed) == style::words_and_comments(again);
  const auto lost = is_kept ? lost_allowance(source, places_in(*parsed), after,
                                             places_in(again))
                            : std::nullopt;
  return kept_or_refused(source, std::move(text), is_kept, lost);
}

Result<std::string> styled_rules_file(const InputFile& file,
                                      const SourceText& source) {
  auto read = read_properties(file.name, file.text);
  if (!read.value) return {std::nullopt, std::move(read.diagnostics)};
  std::string text = style::styled_rules(source);
  const auto again = read_properties(file.name, text);
  const auto titles_of = [](const Result<PropertyFile>& rules) {
    std::vector<std::string> titles;
    for (const Property& each : rules.value->properties) {
      titles.push_back(each.title);
    }
    return titles;
  };
  const bool is_kept = again.value && titles_of(again) == titles_of(read) &&
                       style::words_of_rules(source) ==
                           style::words_of_rules(SourceText(file.name, text));
  return kept_or_refused(source, std::move(text), is_kept, std::nullopt);
}

bool is_named_otherwise(const InputFile& file) {
  return is_tree_name(file.name) || file.name.ends_with(".leaves");
}

bool holds_rules(const InputFile& file) {
  if (is_property_file(file.name)) return true;
  return !is_named_otherwise(file) && begins_item(file.text.text());
}

bool holds_forms(const InputFile& file) {
  if (is_named_otherwise(file)) return true;
  const auto& tokens = file.text.parsed<btf::ParsedForms>()->forms.tokens;
  return !tokens.empty() && tokens.front().kind == btf::FormKind::List;
}

}  // namespace

Result<std::string> styled(const InputFile& file) {
  const SourceText source(file.name, file.text.text());
  if (auto binary = source.refuse_binary()) return refused_style(*binary);
  if (holds_rules(file)) return styled_rules_file(file, source);
  if (!file.name.ends_with(".leaves")) {
    if (auto foreign = refusal_of_foreign(file.name, file.text)) {
      return refused_style(std::move(*foreign));
    }
    if (is_xml(file.name, file.text)) return styled_xml_file(file, source);
  }
  if (!holds_forms(file)) {
    return refused_style(file_error(
        "BT1652", file.name,
        fmt::format("`{}` is no tree, no contracts and no rules", file.name),
        "trees end in .xml, .btproj or .btf, rules in .ltl or .btp, contracts "
        "in .leaves"));
  }
  return styled_forms_file(file, source);
}

}  // namespace btcheck
