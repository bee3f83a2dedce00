// SPDX-License-Identifier: MIT
//
// Command lines, understood and refused.
#include "cli/options/options.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "cli/options/tables.hpp"

namespace btcheck::options_test {
namespace {

using Words = std::vector<std::string>;

std::variant<Options, Answer> parsed(const Words& words) {
  std::vector<const char*> argv = {"btcheck"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  return parse_options(static_cast<int>(argv.size()), argv.data());
}

Options options_of(const Words& words) {
  const auto result = parsed(words);
  if (const Answer* answer = std::get_if<Answer>(&result)) {
    FAIL(answer->text);
    return {};
  }
  return std::get<Options>(result);
}

Answer answer_to(const Words& words) {
  const auto result = parsed(words);
  REQUIRE(std::holds_alternative<Answer>(result));
  return std::get<Answer>(result);
}

TEST_CASE("explain takes a code, or a log and what goes with it") {
  CHECK(!options_of({"explain"}).explains_log);
  CHECK(!options_of({"explain", "BT1014"}).explains_log);
  CHECK(!options_of({"explain", "1014", "-q"}).explains_log);
  const Options log = options_of({"explain", "robot.btlog", "--tree", "t.xml",
                                  "--leaves", "t.leaves", "--format", "json"});
  CHECK(log.explains_log);
  CHECK(log.input == "robot.btlog");
  CHECK(log.trace.tree == "t.xml");
  CHECK(log.reports.at(0).format == ReportFormat::Json);
  CHECK(options_of({"explain", "logs/1"}).explains_log);
  CHECK(answer_to({"explain", "BT1014", "--tree", "t.xml"})
            .text.find("--tree goes with a log") != std::string::npos);
  CHECK(answer_to({"explain", "--format", "json"})
            .text.find("--format goes with a log") != std::string::npos);
  CHECK(answer_to({"explain", "r.btlog", "--format", "sarif"}).code ==
        ExitCode::BadInput);
  CHECK(answer_to({"explain", "a.btlog", "b.btlog"}).code ==
        ExitCode::BadInput);
}

TEST_CASE("a tree alone is checked with every default") {
  const Options options = options_of({"t.btf"});
  CHECK(options.command == Command::Check);
  CHECK(options.input == "t.btf");
  CHECK(options.properties.empty());
  CHECK(!options.ticks.has_value());
  CHECK(options.search == SearchOrder::BreadthFirst);
  CHECK(options.reduce == Reduction::Full);
  CHECK(options.store == StateSetKind::Compressed);
  CHECK(options.threads >= 1);
  CHECK(options.statistics == StatisticsFormat::Table);
  CHECK(options.max_states == UINT64_MAX);
  CHECK(options.max_bytes == 0);
  CHECK(options.timeout == 0);
  CHECK(options.trace_dir == "");
  CHECK(options.color == When::Auto);
  CHECK(!options.is_quiet);
  CHECK(!options.is_verbose);
}

TEST_CASE("space leaves nothing out unless it is told to") {
  CHECK(options_of({"space", "t.btf"}).reduce == Reduction::None);
  CHECK(!options_of({"space", "t.btf"}).modulo);
}

TEST_CASE("space has quotients, of all states") {
  const Options hidden =
      options_of({"space", "t.btf", "--reduce", "bisimulation"});
  CHECK(hidden.reduce == Reduction::None);
  CHECK(hidden.modulo == Equivalence::Branching);
  CHECK(!hidden.seen);
  const Options strong = options_of(
      {"space", "t.btf", "--reduce", "strong", "--observe", "leaves"});
  CHECK(strong.reduce == Reduction::None);
  CHECK(strong.modulo == Equivalence::Strong);
  CHECK(strong.seen == SeenAnswers::OfLeaves);
  CHECK(options_of({"space", "t.btf", "--export", "aut", "--observe", "root"})
            .seen == SeenAnswers::OfRoot);
  for (const Words& line : std::vector<Words>{
           {"t.btf", "--reduce", "bisimulation"},
           {"t.btf", "--observe", "all"},
           {"space", "t.btf", "--observe", "nobody"},
           {"space", "t.btf", "--observe", "all"},
           {"space", "t.btf", "--observe", "all", "--reduce", "live"},
           {"space", "t.btf", "--observe", "all", "--reduce", "full",
            "--export", "aut"}}) {
    CAPTURE(line.back());
    CHECK(answer_to(line).code == ExitCode::BadInput);
  }
}

TEST_CASE("the first word may be a command") {
  CHECK(options_of({"check", "t.btf"}).command == Command::Check);
  CHECK(options_of({"space", "t.btf"}).command == Command::Space);
  CHECK(options_of({"demo"}).command == Command::Demo);
  CHECK(options_of({"export", "t.btf", "--to", "dot"}).command ==
        Command::Export);
  CHECK(options_of({"export", "--to", "dot", "t.btf"}).input == "t.btf");
  CHECK(options_of({"./space"}).input == "./space");
}

TEST_CASE("each option sets what it says") {
  CHECK(options_of({"t.btf", "--tick", "nodes"}).ticks == TickSemantics::Nodes);
  CHECK(options_of({"t.btf", "--tick=none"}).ticks == TickSemantics::None);
  CHECK(options_of({"--tick", "root", "t.btf"}).ticks == TickSemantics::Root);
  CHECK(options_of({"t.btf", "--search", "dfs"}).search ==
        SearchOrder::DepthFirst);
  CHECK(options_of({"t.btf", "--search", "bfs"}).search ==
        SearchOrder::BreadthFirst);
  CHECK(options_of({"t.btf", "--reduce", "none"}).reduce == Reduction::None);
  CHECK(options_of({"t.btf", "--reduce", "live"}).reduce == Reduction::Live);
  CHECK(options_of({"space", "t.btf", "--reduce", "full"}).reduce ==
        Reduction::Full);
  CHECK(options_of({"space", "t.btf", "--store", "exact"}).store ==
        StateSetKind::Exact);
  CHECK(options_of({"space", "t.btf", "--store", "compressed"}).store ==
        StateSetKind::Compressed);
  CHECK(options_of({"t.btf", "--threads", "7"}).threads == 7);
  CHECK(options_of({"space", "t.btf", "--stats", "json"}).statistics ==
        StatisticsFormat::Json);
  CHECK(options_of({"t.btf", "--max-states", "5000"}).max_states == 5000);
  CHECK(options_of({"t.btf", "--timeout", "1.5"}).timeout == 1.5);
  CHECK(options_of({"t.btf", "--trace-dir", "runs"}).trace_dir == "runs");
  CHECK(options_of({"t.btf", "--color", "always"}).color == When::Always);
  CHECK(options_of({"t.btf", "--color", "never"}).color == When::Never);
  CHECK(options_of({"t.btf", "--color", "auto"}).color == When::Auto);
  CHECK(options_of({"-q", "t.btf"}).is_quiet);
  CHECK(options_of({"t.btf", "-v"}).is_verbose);
}

TEST_CASE("a model or a graph is exported to where it is wanted") {
  const auto format = [](const std::string& word) {
    return options_of({"export", "t.btf", "--to", word}).format;
  };
  CHECK(format("dot") == ExportFormat::Dot);
  CHECK(format("promela") == ExportFormat::Promela);
  CHECK(format("smv") == ExportFormat::Smv);
  CHECK(format("fiacre") == ExportFormat::Fiacre);
  CHECK(!options_of({"space", "t.btf"}).graph.has_value());
  const Options shown = options_of({"space", "t.btf", "--export", "dot"});
  CHECK(shown.graph == GraphFormat::Dot);
  CHECK(shown.graph_file == "");
  const Options kept = options_of({"space", "t.btf", "--export", "aut=t.aut"});
  CHECK(kept.graph == GraphFormat::Aldebaran);
  CHECK(kept.graph_file == "t.aut");
}

TEST_CASE("what this version has alone may be said all the same") {
  options_of({"space", "t.btf", "--stats", "table"});
  options_of({"t.btf", "--profile", "paper"});
  options_of({"t.btf", "--format", "text"});
}

TEST_CASE("results are told as text, or as is said") {
  const Options plain = options_of({"t.btf"});
  REQUIRE(plain.reports.size() == 1);
  CHECK(plain.reports[0].format == ReportFormat::Text);
  CHECK(plain.reports[0].file == "");
  const Options several =
      options_of({"t.btf", "--format", "json", "--format=sarif=out/t.sarif"});
  REQUIRE(several.reports.size() == 2);
  CHECK(several.reports[0].format == ReportFormat::Json);
  CHECK(several.reports[1].format == ReportFormat::Sarif);
  CHECK(several.reports[1].file == "out/t.sarif");
}

TEST_CASE("text goes to standard output unless another format does") {
  const auto targets = [](const Words& formats) {
    Words words = {"t.btf"};
    for (const std::string& format : formats) {
      words.push_back("--format");
      words.push_back(format);
    }
    return options_of(words).reports;
  };
  const auto json = targets({"json"});
  REQUIRE(json.size() == 1);
  CHECK(json[0].format == ReportFormat::Json);
  CHECK(json[0].file.empty());
  const auto files = targets({"sarif=out.sarif", "junit=a=b.xml"});
  REQUIRE(files.size() == 3);
  CHECK(files[0].format == ReportFormat::Text);
  CHECK(files[0].file.empty());
  CHECK(files[1].format == ReportFormat::Sarif);
  CHECK(files[1].file == "out.sarif");
  CHECK(files[2].format == ReportFormat::JUnit);
  CHECK(files[2].file == "a=b.xml");
  CHECK(targets({"github", "text=log.txt", "jsonl=log.jsonl"}).size() == 3);
}

TEST_CASE("several property files may be given, each by its --prop") {
  CHECK(options_of({"t.btf", "--prop", "a.ltl"}).properties == Words{"a.ltl"});
  CHECK(
      options_of({"t.btf", "--prop", "a.ltl", "--prop", "b.ltl"}).properties ==
      Words{"a.ltl", "b.ltl"});
  const Options before = options_of({"--prop", "a.ltl", "t.btf"});
  CHECK(before.properties == Words{"a.ltl"});
  CHECK(before.input == "t.btf");
}

TEST_CASE("memory is a number with a unit") {
  const auto bytes = [](const std::string& text) {
    return options_of({"t.btf", "--memory", text}).max_bytes;
  };
  CHECK(bytes("20000000") == 20'000'000);
  CHECK(bytes("20000k") == 20'000ull << 10);
  CHECK(bytes("20000K") == 20'000ull << 10);
  CHECK(bytes("500M") == 500ull << 20);
  CHECK(bytes("4G") == 4ull << 30);
  CHECK(bytes("1.5G") == 3ull << 29);
}

TEST_CASE("bad values are refused with the exit code of bad input") {
  const std::vector<Words> lines = {
      {"t.btf", "--tick", "leaf"},
      {"t.btf", "--search", "best"},
      {"t.btf", "--memory", "15M"},
      {"t.btf", "--reduce", "most"},
      {"t.btf", "--store", "lossy"},
      {"t.btf", "--threads", "0"},
      {"t.btf", "--threads", "many"},
      {"t.btf", "--threads", "257"},
      {"t.btf", "--stats", "json"},
      {"space", "t.btf", "--stats", "xml"},
      {"t.btf", "--max-states", "many"},
      {"t.btf", "--max-states", "-1"},
      {"t.btf", "--timeout", "-1"},
      {"t.btf", "--timeout", "soon"},
      {"t.btf", "--memory", "much"},
      {"t.btf", "--memory", "0"},
      {"t.btf", "--memory", "-4G"},
      {"t.btf", "--memory", "4X"},
      {"t.btf", "--memory", "nan"},
      {"t.btf", "--memory", "1e30G"},
      {"t.btf", "--memory", "0.1"},
      {"t.btf", "--color", "maybe"},
      {"t.btf", "--format", "xml"},
      {"t.btf", "--format", "json="},
      {"t.btf", "--format", "json", "--format", "sarif"},
      {"space", "t.btf", "--format", "json"},
      {"t.btf", "--nothing"},
      {"t.btf", "u.ltl"},
      {"t.btf", "--tick"},
      {"export", "t.btf"},
      {"export", "t.btf", "--to", "pdf"},
      {"space", "t.btf", "--export", "xml"},
      {"space", "t.btf", "--export", "aut="},
      {"t.btf", "--export", "aut"},
      {"space"},
      {"check"},
      {"-q"},
      {"--prop", "a.ltl"}};
  for (const Words& words : lines) {
    CAPTURE(words.back());
    const Answer answer = answer_to(words);
    CHECK(answer.code == ExitCode::BadInput);
    CHECK(answer.text.starts_with("error[BT0001]: "));
    CHECK(answer.text.find("  = help: ") != std::string::npos);
    CHECK(answer.text.ends_with("\n"));
  }
}

TEST_CASE("choices that there are not are refused by name") {
  const auto refused = [](const Words& words) {
    const Answer answer = answer_to(words);
    CHECK(answer.code == ExitCode::BadInput);
    return answer.text.substr(0, answer.text.find('\n'));
  };
  CHECK(refused({"t.xml", "--profile", "btcpp-5"}) ==
        "error[BT0001]: --profile btcpp-5: no such profile");
  CHECK(refused({"t.xml", "--tick-ms", "0"}) ==
        "error[BT0001]: --tick-ms 0: not a number that it takes");
  CHECK(refused({"trace", "r.btlog", "--to", "text", "--tick-gap", "0"}) ==
        "error[BT0001]: --tick-gap 0: not a number that it takes");
  CHECK(refused({"t.xml", "--tick-gap", "5"}) ==
        "error[BT0001]: --tick-gap needs --from LOG@TICK");
  CHECK(refused({"t.xml", "--from", "r.btlog", "--tick-gap", "5"}) ==
        "error[BT0001]: --tick-gap needs --from LOG@TICK");
  CHECK(refused({"conform", "r.btlog", "--tick-gap", "5"}) ==
        "error[BT0001]: --tick-gap needs --learn-leaves");
  CHECK(refused({"monitor", "t.xml", "--prop", "r.ltl", "--tick-gap", "5"})
            .starts_with("error[BT0001]: "));
  CHECK(options_of({"t.xml", "--from", "r.btlog@3", "--tick-gap", "5"})
            .tick_gap == 5);
  CHECK(options_of({"trace", "r.btlog", "--view", "--prop", "r.ltl"}).view);
  const Options of_xml =
      options_of({"t.xml", "--profile", "nav2-humble", "--tick-ms", "10",
                  "--models", "a.xml", "--models", "b.xml", "--loop",
                  "--leaves", "a.leaves", "--leaves", "b.leaves"});
  CHECK(of_xml.profile == Profile::Nav2Humble);
  CHECK(of_xml.tick_ms == 10);
  CHECK(of_xml.models == Words{"a.xml", "b.xml"});
  CHECK(of_xml.leaves == Words{"a.leaves", "b.leaves"});
  CHECK(of_xml.loops);
  CHECK(refused({"t.btf", "--assume", "all-ends"}) ==
        "error[BT0001]: --assume all-ends: no such assumption");
  CHECK(options_of({"t.btf", "--assume", "actions-end"}).assume ==
        ExtraAssumption::ActionsEnd);
}

TEST_CASE(
    "other numbers of rounds are asked of a tree at its beginning, once") {
  CHECK(options_of({"t.btf", "--any-count"}).any_count);
  CHECK_FALSE(options_of({"t.btf"}).any_count);
  for (const Words& words :
       {Words{"t.btf", "--any-count", "--from", "r.btlog"},
        Words{"t.xml", "--any-count", "--against", "nav2-jazzy"},
        Words{"--watch", "t.btf", "--any-count"},
        Words{"batch", "trees", "--any-count"}}) {
    const Answer answer = answer_to(words);
    CHECK(answer.code == ExitCode::BadInput);
    CHECK(answer.text.find("--any-count") != std::string::npos);
  }
}

TEST_CASE("fmt writes unless it is told to show or to check") {
  const FormattingPlan plain = options_of({"fmt", "a.xml", "b"}).formatting;
  CHECK(plain.writes());
  CHECK_FALSE(plain.verifies);
  CHECK_FALSE(options_of({"fmt", "--check", "a"}).formatting.writes());
  CHECK_FALSE(options_of({"fmt", "--diff", "a"}).formatting.writes());
  CHECK(options_of({"fmt", "--verify", "a"}).formatting.verifies);
  const Options standard = options_of({"fmt", "-", "--stdin-name", "t.xml"});
  CHECK(standard.input == kStandardInput);
  CHECK(standard.formatting.stdin_name == "t.xml");
}

TEST_CASE("a refusal says what was meant, or where an option belongs") {
  struct Refusal {
    Words words;
    std::string message, help;
  };
  const std::vector<Refusal> refusals = {
      {{"exprt", "t.btf"},
       "no command and no file `exprt`",
       "did you mean `btcheck export`?"},
      {{"-q", "space", "t.btf"},
       "`space` is not the first word",
       "btcheck space ...: the command comes first, then its options"},
      {{"space", "t.btf", "u.btf"},
       "one word too many: `u.btf`",
       "btcheck space TREE"},
      {{"t.btf", "--tik", "root"},
       "unknown option --tik",
       "did you mean --tick?"},
      {{"space", "t.btf", "--scrip=f"},
       "unknown option --scrip",
       "did you mean --script of simulate and run?"},
      {{"t.btf", "--stats", "json"},
       "--stats belongs to `btcheck space`",
       "btcheck space TREE --stats json"},
      {{"simulate", "t.btf", "--prop", "p.ltl"},
       "--prop belongs to check, lint, export, trace, run, monitor, watch, "
       "whatif and diff",
       "btcheck TREE --prop RULES.ltl"},
      {{"watch"}, "no robot", "btcheck watch groot2://robot --prop RULES.ltl"},
      {{"watch", "groot2://r", "--inject", "a fails"},
       "--inject changes what the robot does",
       "where that is safe, add --allow-inject"},
      {{"watch", "groot2://r", "--break", "a"},
       "--break changes what the robot does",
       "where that is safe, add --allow-inject"},
      {{"watch", "groot2://r", "--break-for", "5"},
       "--break-for goes with --break",
       "btcheck watch groot2://robot --break NODE --break-for 500"},
      {{"watch", "groot2://r", "--allow-inject"},
       "--allow-inject goes with --inject or --break",
       "without it the robot is left alone"},
      {{"watch", "groot2://r", "-o", "run.log"},
       "-o run.log: a log is called FILE.btlog",
       "Groot2 opens no other"},
      {{"whatif"}, "no tree", "btcheck whatif TREE"},
      {{"whatif", "t.btf", "--order", "3"},
       "whatif --order 3: no such number",
       "--order takes 1 or 2"},
      {{"whatif", "t.btf", "--late", "0"},
       "--late 0: not a number that it takes",
       "write a whole number from 1 to 1000000"},
      {{"whatif", "t.btf", "--format", "sarif"},
       "whatif --format sarif: no such format",
       "write text, json, csv, html, dot, svg or opsa, or FORMAT=FILE"},
      {{"whatif", "t.btf", "--format", "csv", "--format", "json"},
       "two formats on standard output",
       "give one of them a file: --format json=FILE"},
      {{"whatif", "t.btf", "--format", "csv=f", "--format", "json=f"},
       "two formats in the file `f`",
       "give one of them a file: --format json=FILE"},
      {{"whatif", "t.btf", "--faults", "breaks"},
       "whatif --faults breaks: no such kind",
       "--faults takes fails, fails-once, fails-for-ever, says-yes, "
       "never-ends, late, "
       "inverted, flips-once, halted, writes-nothing, writes-other or throws"},
      {{"diff"}, "no trees", "btcheck diff OLD.xml NEW.xml"},
      {{"diff", "a.xml"},
       "diff compares two trees, not 1",
       "btcheck diff OLD.xml NEW.xml"},
      {{"diff", "a.xml", "b.xml", "c.xml"},
       "diff compares two trees, not 3",
       "btcheck diff OLD.xml NEW.xml"},
      {{"diff", "--git", "main", "a.xml", "b.xml"},
       "--git compares one tree with what it was",
       "btcheck diff --git main TREE.xml"},
      {{"diff", "a.xml", "b.xml", "c.xml", "--against", "nav2-main"},
       "diff compares two trees, not 3",
       "btcheck diff OLD.xml NEW.xml"},
      {{"diff", "--git=-x", "a.xml"},
       "--git -x: no revision",
       "btcheck diff --git main TREE.xml"},
      {{"diff", "a.xml", "b.xml", "--caller", "twice"},
       "diff --caller twice: no such caller",
       "--caller takes any or once"},
      {{"diff", "a.xml", "b.xml", "--format", "csv"},
       "diff --format csv: no such format",
       "write text, json, markdown or html, or FORMAT=FILE"},
      {{"watch", "-"},
       "watch does not read standard input",
       "name a file: btcheck watch groot2://robot --prop RULES.ltl"},
      {{"export", "t.btf", "--threads", "2"},
       "--threads belongs to check, batch, space, whatif, explain, demo, init "
       "and "
       "answer",
       "btcheck export --help lists what export takes"},
      {{"t.btf", "--tick"},
       "--tick needs a value",
       "--tick SEMANTICS: where time passes"},
      {{"t.btf", "--tick="},
       "--tick needs a value",
       "--tick SEMANTICS: where time passes"},
      {{"t.btf", "--tick", "root", "--tick", "none"},
       "--tick is given twice",
       "leave out one of them"},
      {{"t.btf", "--tick", "rot"},
       "--tick rot: no such semantics",
       "did you mean `root`? --tick takes root, leaves, nodes or none"},
      {{"t.btf", "-q=3"},
       "`=3` follows an option that takes no value",
       "leave it out"},
      {{"t.btf", "--threads", "257"},
       "--threads 257: not a number that it takes",
       "write a whole number from 1 to 256"},
      {{"t.btf", "--max-states", "18446744073709551616"},
       "--max-states 18446744073709551616: not a number that it takes",
       "write a whole number from 1 on, below 2^64"},
      {{"t.btf", "--format", "xml"},
       "--format xml: no such format",
       "write text, json, jsonl, sarif, junit, github or gitlab, or "
       "FORMAT=FILE"},
      {{"t.btf", "--format="},
       "--format needs a value",
       "--format FORMAT: how results are written"},
      {{"t.btf", "--format", "json="},
       "--format json=: no such format",
       "write text, json, jsonl, sarif, junit, github or gitlab, or "
       "FORMAT=FILE"},
      {{"t.btf", "--format", "JSON"},
       "--format JSON: no such format",
       "write text, json, jsonl, sarif, junit, github or gitlab, or "
       "FORMAT=FILE"},
      {{"lint", "t.btf", "--format", "junit"},
       "lint --format junit: no such format",
       "write text, json, sarif, github or gitlab, or FORMAT=FILE"},
      {{"t.btf", "--format", "json", "--format", "sarif"},
       "two formats on standard output",
       "give one of them a file: --format sarif=FILE"},
      {{"t.btf", "--format", "text", "--format", "github"},
       "two formats on standard output",
       "give one of them a file: --format github=FILE"},
      {{"t.btf", "--format", "json=a", "--format", "sarif=a"},
       "two formats in the file `a`",
       "give one of them a file: --format sarif=FILE"}};
  for (const auto& [words, message, help] : refusals) {
    const Answer answer = answer_to(words);
    CHECK(answer.code == ExitCode::BadInput);
    CHECK(answer.text ==
          "error[BT0001]: " + message + "\n  = help: " + help + "\n");
  }
  CHECK(options_of({"t.btf", "--max-states", "18446744073709551615"})
            .max_states == UINT64_MAX);
}

TEST_CASE("no arguments at all get a short help of a dozen lines") {
  const Answer answer = answer_to({});
  CHECK(answer.code == ExitCode::Met);
  CHECK(answer.text.find("btcheck demo") != std::string::npos);
  CHECK(std::count(answer.text.begin(), answer.text.end(), '\n') <= 12);
}

TEST_CASE("--help is a screen, of the program and of each command") {
  std::vector<Words> asked = {{"--help"}, {"-h"}};
  for (const CommandRow& row : command_rows()) {
    asked.push_back({std::string(row.word), "--help"});
  }
  for (const Words& words : asked) {
    const Answer answer = answer_to(words);
    CAPTURE(answer.text);
    CHECK(answer.code == ExitCode::Met);
    const auto lines = std::count(answer.text.begin(), answer.text.end(), '\n');
    CHECK(lines <= (words[0].starts_with('-') ? 25 : 30));
    CHECK(answer.text.find("--help all") != std::string::npos);
  }
  const std::string first = answer_to({"--help"}).text;
  for (const CommandRow& row : shown_commands()) {
    CAPTURE(row.word);
    CHECK(first.find(row.word) != std::string::npos);
  }
}

TEST_CASE("--help all names every option, default and exit code") {
  const Answer answer = answer_to({"--help", "all"});
  CHECK(answer.code == ExitCode::Met);
  for (const char* word :
       {"--prop",      "--tick",    "--search",       "--reduce",
        "--threads",   "--store",   "--stats",        "--max-states",
        "--memory",    "--timeout", "--profile",      "--format",
        "--trace-dir", "--to",      "--color",        "-q",
        "-v",          "--version", "(default: bfs)", "4  internal error"}) {
    CAPTURE(word);
    CHECK(answer.text.find(word) != std::string::npos);
  }
}

TEST_CASE("a batch has options of its own, and shares the cores out") {
  const Options plain = options_of({"batch", "a", "b.toml"});
  CHECK(plain.batch.sources == Words{"a", "b.toml"});
  CHECK(plain.batch.jobs >= 1);
  CHECK(plain.threads >= 1);
  CHECK(!plain.batch.resumes);
  const Options told =
      options_of({"batch", "a", "--jobs", "200", "--shard", "2/3",
                  "--fail-fast", "--resume", "--report", "r.html"});
  CHECK(told.batch.jobs == 200);
  CHECK(told.threads == 1);
  CHECK(told.batch.shard.index == 2);
  CHECK(told.batch.shard.count == 3);
  CHECK(told.batch.stops_early);
  CHECK(told.batch.resumes);
  CHECK(told.batch.page == "r.html");
  CHECK(options_of({"batch", "a", "--jobs", "200", "--threads", "3"}).threads ==
        3);
  for (const Words& words :
       {Words{"batch"}, Words{"batch", "a", "--shard", "3"},
        Words{"batch", "a", "--prop", "p.ltl"},
        Words{"batch", "a", "--jobs", "0"}, Words{"t.btf", "--jobs", "2"},
        Words{"t.btf", "--resume"}}) {
    CHECK(answer_to(words).code == ExitCode::BadInput);
  }
}

TEST_CASE("what breaks is asked for by kinds, and told in several ways") {
  const Options options = options_of(
      {"whatif",   "t.xml",    "--order",     "2",        "--faults",
       "fails",    "--faults", "throws",      "--late",   "50",
       "--others", "contract", "--only",      "Dock",     "--against",
       "old.json", "--format", "html=f.html", "--format", "csv=f.csv"});
  CHECK(options.command == Command::WhatIf);
  const FaultPlan& plan = options.faults;
  CHECK(plan.order == 2);
  CHECK(plan.choices.kinds == std::vector{FaultKind::Fails, FaultKind::Throws});
  CHECK(plan.choices.late == 50);
  CHECK(plan.choices.others == Others::AsContract);
  CHECK(plan.only == "Dock");
  CHECK(plan.against == "old.json");
  // Text goes to standard output where no other format does.
  REQUIRE(plan.outputs.size() == 3);
  CHECK(plan.outputs[0].format == FaultFormat::Text);
  CHECK(plan.outputs[0].file == "");
  CHECK(plan.outputs[1].format == FaultFormat::Html);
  CHECK(plan.outputs[1].file == "f.html");
  CHECK(plan.outputs[2].format == FaultFormat::Csv);
  const Options other = options_of({"whatif", "t.xml", "--format", "json"});
  REQUIRE(other.faults.outputs.size() == 1);
  CHECK(other.faults.outputs[0].format == FaultFormat::Json);
  CHECK(options_of({"whatif", "t.xml"}).faults.outputs.size() == 1);
}

TEST_CASE("which trees are compared, and as whom") {
  const Options plain = options_of({"diff", "a.xml", "b.xml"});
  CHECK(plain.command == Command::Diff);
  CHECK(plain.inputs == std::vector<std::string>{"a.xml", "b.xml"});
  CHECK(plain.diff.observe.empty());
  CHECK(plain.diff.caller == Caller::Any);
  CHECK(plain.diff.revision.empty());
  REQUIRE(plain.diff.outputs.size() == 1);
  CHECK(plain.diff.outputs[0].format == DiffFormat::Text);
  const Options options =
      options_of({"diff", "--git", "HEAD~1", "a.xml", "--observe", "root",
                  "--observe", "Dock", "--caller", "once", "--format",
                  "html=d.html", "--format", "markdown"});
  CHECK(options.diff.revision == "HEAD~1");
  CHECK(options.diff.observe == std::vector<std::string>{"root", "Dock"});
  CHECK(options.diff.caller == Caller::Once);
  REQUIRE(options.diff.outputs.size() == 2);
  CHECK(options.diff.outputs[0].format == DiffFormat::Html);
  CHECK(options.diff.outputs[0].file == "d.html");
  CHECK(options.diff.outputs[1].format == DiffFormat::Markdown);
  const Options profiles =
      options_of({"diff", "a.xml", "--against", "nav2-main"});
  CHECK(profiles.inputs == std::vector<std::string>{"a.xml"});
  CHECK(profiles.against == Profile::Nav2Main);
  // What is written of a check does not go with another profile.
  CHECK(options_of(
            {"diff", "a.xml", "--against", "nav2-main", "--format", "markdown"})
            .diff.outputs[0]
            .format == DiffFormat::Markdown);
}

TEST_CASE("a watch refuses by name what ends, or is kept once") {
  CHECK(options_of({"--watch", "t.btf"}).watches);
  CHECK(!options_of({"t.btf"}).watches);
  CHECK(options_of({"batch", "a", "--watch", "--jobs", "2"}).watches);
  CHECK(options_of({"--watch", "t.btf", "--view=80"}).view == 80);
  CHECK(options_of({"--watch", "t.btf", "--format", "sarif=f"}).watches);
  CHECK(options_of({"--watch", "t.btf", "--format", "jsonl"}).watches);
  const std::vector<Words> refused = {
      {"t.xml", "--watch", "--against", "nav2-main"},
      {"t.btf", "--watch", "--from", "run.itf.json"},
      {"t.btf", "--watch", "--write-baseline", "b.json"},
      {"batch", "a", "--watch", "--fail-fast"},
      {"batch", "a", "--watch", "--results", "r"},
      {"batch", "a", "--watch", "--join", "r"}};
  for (const Words& words : refused) {
    const std::string& name =
        *std::ranges::find_if(words, [](const std::string& word) {
          return word.starts_with("--") && word != "--watch";
        });
    const Answer answer = answer_to(words);
    CHECK(answer.code == ExitCode::BadInput);
    CHECK(answer.text.starts_with("error[BT0001]: --watch and " + name +
                                  " do not go together\n"));
  }
  for (const char* format : {"sarif", "junit", "github", "gitlab"}) {
    const Answer answer = answer_to({"t.btf", "--watch", "--format", format});
    CHECK(answer.text.starts_with(
        std::string("error[BT0001]: --watch and --format ") + format +
        " on standard output do not go together\n"));
  }
  CHECK(answer_to({"t.btf", "--view"})
            .text.starts_with("error[BT0001]: --view goes with --watch\n"));
  CHECK(answer_to({"--watch", "-"})
            .text.starts_with("error[BT0001]: --watch: `-` is no file"));
  CHECK(answer_to({"lint", "a", "--watch"})
            .text.find("belongs to check and "
                       "batch") != std::string::npos);
}

TEST_CASE("--version says which") {
  const Answer answer = answer_to({"--version"});
  CHECK(answer.code == ExitCode::Met);
  CHECK(answer.text.starts_with("btcheck "));
}

// Of what cmake/sources.txt names, in its order.
TEST_CASE("--licenses has the text of each licence") {
  const Answer answer = answer_to({"--licenses"});
  CHECK(answer.code == ExitCode::Met);
  std::size_t place = 0;
  for (const char* part :
       {"== btcheck: MIT",
        "the btcheck authors",
        "== fmt: MIT",
        "Victor Zverovich",
        "== tinyxml2: Zlib",
        "freely, subject to",
        "== oneTBB: Apache-2.0",
        "END OF TERMS AND CONDITIONS",
        "== zstd: BSD-3-Clause",
        "Facebook",
        "== lz4: BSD-2-Clause",
        "Yann Collet",
        "== SQLite: blessing",
        "May you do good",
        "== Boost: BSL-1.0",
        "Boost Software License",
        "== nlohmann-json: MIT",
        "Niels Lohmann",
        "== CLI11: BSD-3-Clause",
        "University of Cincinnati",
        "== toml++: MIT",
        "Mark Gillard",
        "== xxHash: BSD-2-Clause",
        "== glibc: LGPL-2.1-or-later",
        "GNU LESSER GENERAL PUBLIC LICENSE",
        "== libstdc++: GPL-3.0-or-later WITH GCC-exception-3.1",
        "GCC RUNTIME LIBRARY EXCEPTION",
        "GNU GENERAL PUBLIC LICENSE"}) {
    CAPTURE(part);
    place = answer.text.find(part, place);
    REQUIRE(place != std::string::npos);
  }
}

}  // namespace
}  // namespace btcheck::options_test
