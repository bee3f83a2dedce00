// SPDX-License-Identifier: MIT
//
// The program against those who mean it ill, and against bad luck: names that
// rewrite the screen, files that are none, results that somebody else has
// written, trees that quote from where they should not, memory and threads that
// are not to be had.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "file_text.hpp"
#include "robust/child_process.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace btcheck {
namespace {

const std::string kProgram = BTCHECK_PROGRAM;
const std::string kDrone = BTCHECK_EXAMPLES "/drone3.btf";
const std::string kRules = BTCHECK_EXAMPLES "/demo.ltl";

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

Outcome btcheck_in(const fs::path& folder, const std::string& words) {
  return run_in(folder, "timeout 60 " + kProgram + " " + words);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// --- Texts ---------------------------------------------------------------

// Of names: ESC, C1's CSI, right-to-left override, line separator, byte order
// mark, DEL.
const std::string kEvil =
    "\x1b[2J \xc2\x9b"
    "1A \xe2\x80\xae \xe2\x80\xa8 \xef\xbb\xbf \x7f";

bool is_harmless(const std::string& text) {
  for (const char* part : {"\x1b", "\xc2\x9b", "\xe2\x80\xae", "\xe2\x80\xa8",
                           "\xef\xbb\xbf", "\x7f", "\r"}) {
    if (has(text, part)) return false;
  }
  return true;
}

TEST_CASE("no text of an input reaches the terminal as it is") {
  TemporaryFolder folder;
  const fs::path& here = folder.path();
  // XML cannot hold ESC, but all the others.
  const std::string name = kEvil.substr(5);
  write(here / "a.xml",
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><Sequence name=\"" +
            name + "\"><Action ID=\"a\" name=\"b" + name +
            "\"/></Sequence></BehaviorTree></root>\n");
  write(here / "a.btf", "(BehaviorTree :name t (Action :ID a)) ; " + kEvil);
  write(here / "a.ltl", "## HOLDS " + kEvil +
                            "\nproperty p: never a.success # " + kEvil +
                            "\nproperty q: never nothing." + name + "\n");
  write(here / "b.ltl",
        "## \x1b[1A\x1b[2KHOLDS  all is well\n"
        "property p: never a.success\n");
  const std::string evil_name = "e\x1b[31m\xe2\x80\xaevil.btf";
  write(here / evil_name, "(BehaviorTree :name t (Action :ID a))");
  for (const std::string& words : std::vector<std::string>{
           "a.xml", "a.xml -v", "a.btf --prop a.ltl", "a.btf --prop b.ltl",
           "a.btf --prop b.ltl -v", "a.btf --prop b.ltl --format github",
           "lint a.xml", "lint a.btf --prop a.ltl", "space a.xml",
           "simulate a.xml --seed 1", "export a.xml --to dot",
           "export a.xml --to promela", "export a.xml --to smv",
           "export a.btf --to fiacre --prop b.ltl",
           "\"$(printf 'e\\033[31m\\342\\200\\256vil.btf')\"",
           "\"$(printf 'none\\033[31m')\"", "batch .",
           "explain \"$(printf "
           "'BT1\\033[31m')\"",
           "\"$(printf -- '--x\\033[31m')\""}) {
    CAPTURE(words);
    const Outcome outcome = btcheck_in(here, words + " 2>&1");
    CHECK(outcome.code >= 0);
    CHECK(outcome.code < 4);
    CHECK(!outcome.text.empty());
    CHECK(is_harmless(outcome.text));
  }
  // Told, not hidden.
  const Outcome told = btcheck_in(here, "a.btf --prop b.ltl 2>&1");
  CHECK(told.code == 1);
  CHECK(has(told.text, "VIOLATED"));
}

TEST_CASE("formats that programs read keep what is in a text") {
  TemporaryFolder folder;
  write(folder.path() / "a.btf", "(BehaviorTree :name t (Action :ID a))");
  write(folder.path() / "a.ltl",
        "## \xe2\x80\xae\xc2\x9b title\nproperty p: never a.success\n");
  for (const std::string format :
       {"json", "sarif", "junit", "jsonl", "gitlab"}) {
    CAPTURE(format);
    const Outcome outcome = btcheck_in(
        folder.path(), "a.btf --prop a.ltl --format " + format + " 2>&1");
    CHECK(outcome.code == 1);
    CHECK(!has(outcome.text, "\\x"));
  }
}

// What a log of GitHub, or a person, would take for lines of btcheck.
const std::vector<std::string> kForged = {
    "HOLDS      safe  (every run)", "VIOLATED   safe  (after 1 tick)",
    "::add-mask::e", "\xc2\xa0::error::all is well",
    "1 property: 1 holds, 0 violated, 0 undecided"};

// Each with a line of its own, and orders that may stand anywhere.
std::string several_lines(const std::string& line_break) {
  std::string text = "x ##[add-mask]w ##vso[task.complete]v `q`";
  for (const std::string& line : kForged) text += line_break + line;
  return text;
}

// The first line that is not ours, or "".
std::string forged_line(const std::string& text, bool is_for_github = false) {
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (is_for_github && line.starts_with("::") && has(line, " file=") &&
        has(line, ",title=")) {
      continue;
    }
    if (has(line, "##[") || has(line, "##vso[")) return line;
    for (std::string blank : {" ", "\t", "\xc2\xa0"}) {
      while (line.starts_with(blank)) line.erase(0, blank.size());
    }
    if (line.starts_with("::") || line.starts_with(kForged[0]) ||
        line.starts_with(kForged[1]) || line == kForged[4]) {
      return line;
    }
  }
  return "";
}

// A tree in which each text that can be one of several lines is.
std::string forging_tree() {
  const std::string lines = several_lines("&#10;");
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"M" + lines + "\">" +
         "<BehaviorTree ID=\"M" + lines + "\"><Sequence name=\"s" + lines +
         "\">" + "<Script code=\"a := 'u" + lines + "'; b := 1\"/>" +
         "<Action ID=\"A" + lines + "\" name=\"a" + lines + "\" port=\"v" +
         lines + "\" out=\"{k" + lines + "}\"/>" + "<SetBlackboard value=\"v" +
         lines + "\" output_key=\"k" + lines + "\"/><SubTree ID=\"S" + lines +
         "\" p=\"q" + lines + "\"/>" + "<Switch2 variable=\"{a}\" case_1=\"u" +
         lines +
         "\" case_2=\"::error::c\"><Action ID=\"B\" name=\"::warning::b\"/>" +
         "<Action ID=\"B\"/><Action ID=\"B\"/></Switch2>" +
         "<Action ID=\"C\" _skipIf=\"b == 2 &#10;&amp;&amp; a != '" + lines +
         "'\"/></Sequence></BehaviorTree>" + "<BehaviorTree ID=\"S" + lines +
         "\"><Action ID=\"D\" x=\"{p}\"/></BehaviorTree><TreeNodesModel>" +
         "<Action ID=\"B\"><input_port name=\"n\" type=\"t" + lines +
         "\" default=\"d" + lines + "\">m" + lines +
         "</input_port></Action></TreeNodesModel></root>\n";
}

TEST_CASE("a text of several lines is one line wherever it is shown") {
  TemporaryFolder folder;
  const fs::path& here = folder.path();
  write(here / "t.xml", forging_tree());
  // Names are all that a tree needs to have; with an error in it, the same.
  write(here / "n.xml",
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"m\"><Sequence name=\"s" +
            several_lines("&#10;") + "\"><A name=\"a" + several_lines("&#10;") +
            "\"/><A name=\"::error::b\"/><A x=\"" + several_lines("&#10;") +
            "\"/></Sequence></BehaviorTree>" +
            "<TreeNodesModel><Action ID=\"A\"/></TreeNodesModel></root>\n");
  write(here / "e.xml",
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"m\">"
        "<Nothing name=\"a" +
            several_lines("&#10;") + "\" y=\"" + several_lines("&#10;") +
            "\"><A/></Nothing></BehaviorTree></root>\n");
  write(here / "r.ltl",
        "## HOLDS ##[add-mask]w and as long as it takes to break the line at "
        "the word\n## ::add-mask::e\nproperty p: never A.success\n## " +
            kForged[3] + "\nproperty q: possible root.success\n");
  write(here / "l.leaves", "(defaction A :returns (success ::error::e))\n");
  write(here / "c.toml", "profile = \"" + several_lines("\\n") + "\"\n");
  write(here / "m.toml", "[[entry]]\ntree = \"n.xml\"\nname = \"" +
                             several_lines("\\n") + "\"\n[[entry]]\ntree = \"" +
                             several_lines("\\n") + "\"\n");
  write(here / "events.jsonl",
        "{\"topic\": \"x\", \"event_log\": [{\"node_name\": \"" +
            several_lines("\\n") + "\"}]}\n" + "::add-mask::e\n" + kForged[0] +
            "\n");
  REQUIRE(btcheck_in(here, "simulate n.xml --seed 1 -o run.json").code == 0);
  REQUIRE(btcheck_in(here, "trace run.json --to btlog -o run.btlog").code == 0);
  std::vector<std::string> lines;
  for (const std::string tree : {"t.xml", "n.xml", "e.xml"}) {
    for (const std::string words :
         {"", "-v", "--prop r.ltl", "--prop r.ltl -v", "-e 'never A.failure'",
          "--format github", "--prop r.ltl --format github", "--format junit",
          "--prop r.ltl --format junit", "--format json", "--format jsonl",
          "--format sarif", "--format gitlab", "--leaves l.leaves",
          "--config c.toml", "--profile btcpp-4.5 --against btcpp-4.6",
          "--trace-dir runs", "--main-tree ::error::e", "--color always"}) {
      lines.push_back(tree + " " + words);
    }
    for (const std::string words :
         {"lint", "space", "init", "leaves", "leaves --to leaves", "batch",
          "batch -v", "space --export dot", "space --export aut",
          "simulate --seed 1", "simulate --seed 1 -v",
          "run --seed 1 --no-wait --ticks 3", "conform run.btlog",
          "run --seed 1 --no-wait --ticks 3 --prop r.ltl",
          "monitor --prop r.ltl <events.jsonl"}) {
      const std::size_t end = words.find(" --");
      lines.push_back(words.substr(0, end) + " " + tree +
                      (end == words.npos ? "" : words.substr(end)));
    }
    for (const std::string format :
         {"dot", "svg", "mermaid", "automata", "smv", "fiacre", "hfiacre",
          "xml", "btf", "monitor", "monitor-cpp", "ltsmin"}) {
      lines.push_back("export " + tree + " --prop r.ltl --to " + format);
    }
  }
  for (const std::string format : {"text", "html", "itf", "svg", "strip", "dot",
                                   "mermaid", "chrome", "substitution"}) {
    lines.push_back("trace run.json --to " + format);
  }
  for (const std::string words :
       {"batch m.toml", "batch .", ". -v", "trace run.btlog --to text",
        "trace run.btlog --prop r.ltl", "conform run.btlog --coverage",
        "explain run.btlog", "explain ::error::e", "::error::e", "--::error::e",
        "t.xml x ::y", "n.xml --from run.btlog", "batch . --format github"}) {
    lines.push_back(words);
  }
  for (const std::string& words : lines) {
    CAPTURE(words);
    const Outcome outcome = btcheck_in(here, words + " 2>&1");
    CHECK(outcome.code >= 0);
    CHECK(outcome.code < 4);
    CHECK(!outcome.text.empty());
    // What programs read keeps orders within a line, and has its own escapes.
    const bool is_of_programs =
        has(words, "json") || has(words, "sarif") || has(words, "junit") ||
        has(words, "gitlab") || has(words, "export") || has(words, "init") ||
        has(words, "leaves ") ||
        (has(words, "trace run.json") && !has(words, "--to text"));
    CAPTURE(outcome.text.substr(0, 3000));
    std::string text = outcome.text;
    if (is_of_programs) {
      for (std::size_t at; (at = text.find("##")) != text.npos;) {
        text.replace(at, 2, "+");
      }
    }
    CHECK(forged_line(text, has(words, "github")) == "");
    if (!is_of_programs && !has(words, "--color always")) {
      CHECK(is_harmless(text));
    }
  }
  // Told, not hidden, and the same name in a log and its tree.
  CHECK(has(btcheck_in(here, "n.xml -e 'never A.success' 2>&1").text,
            "\\u{a}HOLDS"));
  CHECK(btcheck_in(here, "conform run.btlog n.xml -q 2>&1").code == 0);
}

TEST_CASE("a file with a line break in its name is refused") {
  TemporaryFolder folder;
  const fs::path& here = folder.path();
  const std::string name = "d\n" + kForged[0] + "\n" + kForged[2] + ".xml";
  write(here / "in" / name,
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><AlwaysSuccess/>"
        "</BehaviorTree></root>\n");
  write(here / "in" / ("r" + name.substr(0, name.size() - 4) + ".ltl"),
        "property p: possible root.success\n");
  write(here / "in/a.btf", "(BehaviorTree :name t (Action :ID a))");
  for (const std::string& words : std::vector<std::string>{
           "in/d*.xml", "batch in", "in -v", "lint in", "leaves in",
           "batch in --format github", "batch in --format junit",
           "in/a.btf --prop in/r*.ltl", "space in/d*.xml",
           "export in/d*.xml --to dot", "conform in/d*.xml in/a.btf",
           "trace in/d*.xml --to text"}) {
    CAPTURE(words);
    const Outcome outcome = btcheck_in(here, words + " 2>&1");
    CHECK(outcome.code == 2);
    CHECK(has(outcome.text, "has a line break in its name"));
    CHECK(forged_line(outcome.text, has(words, "github")) == "");
  }
}

TEST_CASE("a kept run whose texts forge lines shows none") {
  TemporaryFolder folder;
  const fs::path& here = folder.path();
  write(here / "t.xml",
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"m\"><Sequence name=\"s\">"
        "<A name=\"aaa\"/></Sequence></BehaviorTree>"
        "<TreeNodesModel><Action ID=\"A\"/></TreeNodesModel></root>\n");
  REQUIRE(btcheck_in(here, "simulate t.xml --seed 1 -o run.json").code == 0);
  const std::string whole = file_text(here / "run.json");
  // Each text in turn, key or value.
  std::size_t count = 0;
  for (std::size_t at = 0; (at = whole.find('"', at)) != whole.npos;) {
    const std::size_t end = whole.find('"', at + 1);
    std::string forged = whole;
    forged.insert(end, several_lines("\\n"));
    at = end + 1;
    if (++count % 7 != 0) continue;  // some, or it takes a minute
    write(here / "forged.json", forged);
    CAPTURE(whole.substr(end - std::min<std::size_t>(end, 40), 60));
    for (const char* words : {"--to text", "-e 'never aaa.success'"}) {
      const Outcome outcome =
          btcheck_in(here, std::string("trace forged.json ") + words + " 2>&1");
      CHECK(outcome.code >= 0);
      CHECK(outcome.code < 4);
      CHECK(forged_line(outcome.text) == "");
    }
  }
  CHECK(count > 50);
}

// --- What standard error and output are ----------------------------------

TEST_CASE("a standard error that cannot be written changes no result") {
  TemporaryFolder folder;
  for (const char* where : {"2>/dev/full", "2>&-"}) {
    CAPTURE(where);
    const auto code = [&](const std::string& words) {
      return btcheck_in(folder.path(), words + " >/dev/null " + where).code;
    };
    CHECK(code(kDrone + " --prop " + kRules) == 1);
    CHECK(code(kDrone) == 0);
    CHECK(code("nowhere.btf") == 2);
    CHECK(code("--no-such-option") == 2);
    CHECK(code("space " + kDrone) == 0);
    CHECK(code("simulate " + kDrone + " --seed 1") == 0);
    CHECK(code("batch " BTCHECK_EXAMPLES "/nav2 --max-states 10") == 3);
  }
}

TEST_CASE("what is closed is not taken by a file") {
  TemporaryFolder folder;
  const Outcome outcome =
      btcheck_in(folder.path(), kDrone + " --prop " + kRules +
                                    " --format json=report.json 2>&- >&-");
  CHECK(outcome.code == 2);  // the text has nowhere to go
  const std::string report = file_text(folder.path() / "report.json");
  CHECK(report.starts_with("{"));
  CHECK(!has(report, "error["));
}

TEST_CASE("a dumb terminal gets no escape sequences") {
  TemporaryFolder folder;
  const Outcome outcome = run_in(
      folder.path(), "TERM=dumb script -qec '" + kProgram + " space " +
                         BTCHECK_EXAMPLES "/nav2.btf --timeout 1' /dev/null");
  if (outcome.code == 127) return;  // no `script` here
  CHECK(!has(outcome.text, "\x1b"));
  // Nor a message that is painted elsewhere.
  const Outcome refused =
      run_in(folder.path(), "TERM=dumb script -qec '" + kProgram +
                                " space none.btf' /dev/null");
  CHECK(has(refused.text, "BT0002"));
  CHECK(!has(refused.text, "\x1b"));
}

// --- Files that are none -------------------------------------------------

TEST_CASE("pipes and devices are refused, not waited for") {
  TemporaryFolder folder;
  const fs::path& here = folder.path();
  fs::create_directory(here / "many");
  for (const char* name : {"p.btf", "p.xml", "p.ltl", "p.txt", "p.itf.json",
                           "many/p.btf", "many/q.ltl", "many/batch.toml"}) {
    REQUIRE(::mkfifo((here / name).c_str(), 0600) == 0);
  }
  write(here / "include.xml",
        "<root BTCPP_format=\"4\"><include path=\"p.xml\"/>"
        "<BehaviorTree ID=\"M\"><AlwaysSuccess/></BehaviorTree></root>\n");
  write(here / "names.ltl", "tree \"p.btf\"\nproperty p: possible a.success\n");
  for (const std::string& words : std::vector<std::string>{
           "p.btf", "p.xml", "/dev/zero", "/dev/tty", kDrone + " --prop p.ltl",
           "include.xml", "include.xml --leaves p.txt",
           "include.xml --models p.xml", "names.ltl", "lint p.btf",
           "space p.xml", "export p.btf --to dot", "trace p.itf.json --to text",
           "simulate " + kDrone + " --script p.txt", "batch many",
           "batch many/batch.toml"}) {
    CAPTURE(words);
    const Outcome outcome = btcheck_in(here, words + " </dev/null 2>&1");
    CHECK(outcome.code == 2);
    CHECK(has(outcome.text, "error["));
  }
}

TEST_CASE("what the caller has opened is read") {
  TemporaryFolder folder;
  const Outcome by_pipe = btcheck_in(
      folder.path(), "/dev/stdin -q --prop " + kRules + " <" + kDrone);
  CHECK(has(by_pipe.text, "3 hold, 1 violated"));
  const Outcome by_number = btcheck_in(
      folder.path(), "/dev/fd/5 -q --prop " + kRules + " 5<" + kDrone);
  CHECK(has(by_number.text, "3 hold, 1 violated"));
}

TEST_CASE("a file that is too large is told with the limit") {
  TemporaryFolder folder;
  write(folder.path() / "large.btf", "");
  fs::resize_file(folder.path() / "large.btf", std::uintmax_t{65} << 20);
  const Outcome outcome = btcheck_in(folder.path(), "large.btf 2>&1");
  CHECK(outcome.code == 2);
  CHECK(has(outcome.text, "larger than 64 MiB, the most that is read"));
}

// --- Where files may lie -------------------------------------------------

TEST_CASE("a stranger's tree cannot quote files of the machine") {
  TemporaryFolder folder;
  const fs::path& here = folder.path();
  write(here / "secret/config", "password = hunter2\n");
  write(here / "secret/tree.btf", "(BehaviorTree :name t (Action :ID a))");
  const fs::path pr = here / "pr";
  write(pr / "own.btf", "(BehaviorTree :name t (Action :ID a))");
  write(pr / "own.ltl", "tree \"own.btf\"\nproperty p: possible a.success\n");
  write(pr / "a.ltl",
        "tree \"../secret/config\"\nproperty p: possible a.success\n");
  write(pr / "b.ltl",
        "tree \"../secret/tree.btf\"\nproperty p: possible a.success\n");
  write(pr / "c.ltl", "tree \"" + (here / "secret/config").string() +
                          "\"\nproperty p: possible a.success\n");
  write(pr / "d.xml",
        "<root BTCPP_format=\"4\"><include path=\"../secret/config\"/>"
        "<BehaviorTree ID=\"M\"><AlwaysSuccess/></BehaviorTree></root>\n");
  write(pr / "d.ltl", "tree \"d.xml\"\nproperty p: never dead\n");
  fs::create_symlink("../secret/config", pr / "e.btf");
  fs::create_symlink("../secret/config", pr / "f.ltl");
  fs::create_symlink("../secret", pr / "g");
  write(pr / "g.ltl", "tree \"g/config\"\nproperty p: possible a.success\n");
  const Outcome batch = btcheck_in(here, "batch pr 2>&1");
  CHECK(batch.code == 2);
  CHECK(has(batch.text, "1 met"));
  CHECK(has(batch.text, "error[BT0009]"));
  CHECK(!has(batch.text, "hunter2"));
  CHECK(!has(batch.text, "password"));
  for (const std::string& words : std::vector<std::string>{
           "pr/a.ltl", "pr/c.ltl", "pr/d.xml", "pr/e.btf", "pr/g.ltl",
           "pr/own.btf --prop pr/f.ltl", "lint pr/d.xml", "space pr/e.btf",
           "simulate pr/e.btf --seed 1", "export pr/d.xml --to dot"}) {
    CAPTURE(words);
    const Outcome outcome = btcheck_in(here, words + " --root pr 2>&1");
    CHECK(outcome.code == 2);
    CHECK(has(outcome.text, "error[BT0009]"));
    CHECK(!has(outcome.text, "hunter2"));
    CHECK(!has(outcome.text, "password"));
  }
  CHECK(btcheck_in(here, "pr/own.ltl --root pr -q").code == 0);
  CHECK(btcheck_in(here, "pr/b.ltl --root . -q").code == 0);
  CHECK(btcheck_in(pr, "own.ltl --root . -q").code == 0);
  CHECK(btcheck_in(pr, "own.ltl --root ../pr/ -q").code == 0);
}

// A repository, with a stranger's folder `trees`, beside somebody's secrets.
void make_repository(const fs::path& here) {
  write(here / "home/credentials", "password = \"hunter2\"\n");
  write(here / "home/tree.xml",
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Hunter2\"><AlwaysSuccess/>"
        "</BehaviorTree></root>\n");
  write(here / "repo/.git/config", "extraheader = password hunter2\n");
  write(here / "repo/.env", "password = hunter2\n");
  write(here / "repo/trees/own.btf", "(BehaviorTree :name t (Action :ID a))");
  write(
      here / "repo/trees/own.xml",
      "<root BTCPP_format=\"4\"><include path=\"../lib/part.xml\"/>"
      "<BehaviorTree ID=\"M\"><SubTree ID=\"Part\"/></BehaviorTree></root>\n");
  write(here / "repo/lib/part.xml",
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Part\"><AlwaysSuccess/>"
        "</BehaviorTree></root>\n");
}

TEST_CASE("no file that is found is read outside of the repository") {
  // Each is put in the folder of trees, and is a link to a secret or names it.
  const std::string xml = "<root BTCPP_format=\"4\"><include path=\"";
  const std::vector<std::pair<std::string, std::string>> traps = {
      {"batch.toml", ""},
      {"btcheck.toml", ""},
      {"a.ltl", ""},
      {"a.btf", ""},
      {"a.xml", ""},
      {"a.btproj", ""},
      {".btcheck-results", ""},
      {"a.ltl", "tree \"../../home/credentials\"\nproperty p: never dead\n"},
      {"btcheck.toml", "models = [\"../../home/credentials\"]\n"},
      {"btcheck.toml", "leaves = [\"../../home/credentials\"]\n"},
      {"batch.toml", "[[entry]]\ntree = \"../../home/credentials\"\n"},
      {"batch.toml",
       "[[entry]]\ntree = \"own.btf\"\nproperties = "
       "[\"../../home/credentials\"]\n"},
      {"batch.toml", "[[entry]]\nfolder = \"../../home\"\n"},
      {"a.ltl", "tree \"../.git/config\"\nproperty p: never dead\n"},
      {"a.xml", xml + "../.env\"/><BehaviorTree ID=\"A\"><AlwaysSuccess/>"
                      "</BehaviorTree></root>\n"},
      {"batch.toml",
       "[[entry]]\ntree = \"own.xml\"\nmodels = "
       "[\"../../home/credentials\"]\n"},
      {"a.btproj", xml + "../../home/tree.xml\"/></root>\n"},
      {"a.xml", xml + "../../home/credentials\"/><BehaviorTree ID=\"A\">"
                      "<AlwaysSuccess/></BehaviorTree></root>\n"},
      {"a.xml", xml + "../../home/tree.xml\"/><BehaviorTree ID=\"A\">"
                      "<SubTree ID=\"Hunter2\"/></BehaviorTree></root>\n"}};
  for (const auto& each : traps) {
    const std::string& name = each.first;  // Clang 14 captures no binding
    const std::string& text = each.second;
    TemporaryFolder folder;
    const fs::path& here = folder.path();
    make_repository(here);
    const fs::path trap = here / "repo/trees" / name;
    const bool is_xml = name.ends_with(".xml") || name.ends_with(".btproj");
    if (!text.empty()) {
      write(trap, text);
    } else {
      fs::create_symlink(
          is_xml ? "../../home/tree.xml" : "../../home/credentials", trap);
    }
    for (const std::string words :
         {"batch trees", "trees", "trees -v", "batch trees --resume",
          "lint trees", "leaves trees", "lint trees/own.xml", "trees/own.xml",
          "trees/own.btf", "space trees/own.xml", "batch trees/*"}) {
      CAPTURE(name);
      CAPTURE(text);
      CAPTURE(words);
      const Outcome outcome =
          run_in(here / "repo",
                 "strace -f -e trace=open,openat -o ../opened timeout "
                 "60 " +
                     kProgram + " " + words + " 2>&1");
      const bool has_strace = outcome.code != 127;
      const Outcome told =
          has_strace ? outcome : btcheck_in(here / "repo", words + " 2>&1");
      CHECK(told.code >= 0);
      CHECK(told.code < 4);
      CHECK(!has(told.text, "hunter2"));
      CHECK(!has(told.text, "Hunter2 "));
      CHECK(!has(told.text, "password"));
      if (!has_strace) continue;
      const std::string opened = file_text(here / "opened");
      CHECK(!has(opened, "credentials\""));
      CHECK(!has(opened, "home/tree.xml\""));
      CHECK(!has(opened, ".git/config\""));
      CHECK(!has(opened, ".env\""));
    }
  }
}

TEST_CASE("results are not written through what lies in their place") {
  for (const std::string kind : {"link", "pipe", "dangling"}) {
    TemporaryFolder folder;
    const fs::path& here = folder.path();
    make_repository(here);
    const fs::path results = here / "repo/trees/.btcheck-results";
    if (kind == "pipe") {
      REQUIRE(::mkfifo(results.c_str(), 0600) == 0);
    } else {
      fs::create_symlink(
          kind == "link" ? "../../home/credentials" : "../../home/new",
          results);
    }
    for (const char* words : {"batch trees --resume", "batch trees"}) {
      CAPTURE(kind);
      CAPTURE(words);
      CHECK(btcheck_in(here / "repo", words).code == 0);
      CHECK(fs::is_regular_file(fs::symlink_status(results)));
      CHECK(file_text(here / "home/credentials") == "password = \"hunter2\"\n");
      CHECK(!fs::exists(here / "home/new"));
    }
  }
}

TEST_CASE("what the command line names is its user's choice") {
  TemporaryFolder folder;
  const fs::path& here = folder.path();
  make_repository(here);
  write(here / "home/r.ltl", "property p: possible root.success\n");
  write(here / "home/m.toml", "[[entry]]\ntree = \"../repo/trees/own.btf\"\n");
  const fs::path repo = here / "repo";
  CHECK(btcheck_in(repo, "../home/tree.xml").code == 0);
  CHECK(btcheck_in(repo, "trees/own.btf --prop ../home/r.ltl").code == 0);
  CHECK(btcheck_in(repo, "lint trees ../home/tree.xml").code == 0);
  fs::create_symlink("../../home/tree.xml", repo / "trees/link.xml");
  CHECK(btcheck_in(repo, "trees/link.xml").code == 0);
  CHECK(btcheck_in(repo, "trees/own.btf --root trees --prop ../home/r.ltl")
            .code == 2);
}

TEST_CASE("files may lie in the repository that holds what is named") {
  TemporaryFolder folder;
  const fs::path& here = folder.path();
  make_repository(here);
  const fs::path repo = here / "repo";
  write(repo / "btcheck.toml", "tick-ms = 50\n");
  const std::string absolute = (repo / "trees").string();
  // From anywhere, and by a link.
  fs::create_symlink("repo/trees", here / "link");
  for (const auto& each : std::vector<std::pair<fs::path, std::string>>{
           {repo, "trees"},
           {repo, "batch trees"},
           {repo, "."},
           {repo, "batch trees/own.btf trees/own.xml"},
           {repo / "trees", "."},
           {repo / "trees", "own.xml"},
           {repo / "lib", "../trees"},
           {here, "repo/trees"},
           {here, "link/own.btf"},
           {"/", absolute},
           {"/", absolute + "/own.xml"},
           {"/", "lint " + absolute}}) {
    const fs::path& from = each.first;
    const std::string& words = each.second;
    CAPTURE(from);
    CAPTURE(words);
    const Outcome outcome = btcheck_in(from, words + " 2>&1");
    CAPTURE(outcome.text);
    CHECK(outcome.code == 0);
    CHECK(!has(outcome.text, "BT0009"));
  }
  // Hidden is what lies below the folder that is named.
  fs::create_directories(repo / ".robot");
  fs::copy_file(repo / "trees/own.xml", repo / ".robot/own.xml");
  CHECK(btcheck_in(repo, ".robot").code == 0);
  CHECK(btcheck_in(repo, ".robot/own.xml").code == 0);
  // A root that is given wins.
  CHECK(has(btcheck_in(repo, "trees --root trees 2>&1").text, "BT0009"));
  CHECK(btcheck_in(repo, "trees --root . -q").code == 0);
  // The folder of a btcheck.toml is a repository, where there is no other.
  fs::remove_all(repo / ".git");
  CHECK(btcheck_in(repo, "trees -q").code == 0);
  CHECK(btcheck_in(here, "repo/trees -q").code == 0);
  // Of a .git and a btcheck.toml below it, the .git.
  fs::create_directory(repo / ".git");
  fs::rename(repo / "btcheck.toml", repo / "trees/btcheck.toml");
  CHECK(btcheck_in(repo, "trees -q").code == 0);
}

TEST_CASE("a home is no repository, whatever is kept in it") {
  TemporaryFolder folder;
  const fs::path& home = folder.path();
  write(home / "ws/trees/own.xml",
        "<root BTCPP_format=\"4\"><include path=\"../../secret.xml\"/>"
        "<BehaviorTree ID=\"M\"><AlwaysSuccess/></BehaviorTree></root>\n");
  write(home / "secret.xml", "password = hunter2");
  write(home / "btcheck.toml", "tick-ms = 50\n");
  const std::string with_home = "HOME=" + home.string() + " " + kProgram + " ";
  for (const bool has_git : {false, true}) {
    CAPTURE(has_git);
    if (has_git) fs::create_directory(home / ".git");
    const Outcome outcome = run_in(home, with_home + "ws/trees -v 2>&1");
    CHECK(outcome.code == 2);
    CHECK(has(outcome.text, "error[BT0009]: `secret.xml` is outside of"));
    CHECK(has(outcome.text, "settings: btcheck.toml"));
    CHECK(!has(outcome.text, "hunter2"));
  }
}

// --- Results that are kept -----------------------------------------------

std::string kept_line(const std::string& file) {
  return file.substr(file.find('\n') + 1);
}

// A batch whose one entry is MISSED, and its results.
fs::path missed_batch(const fs::path& here) {
  write(here / "batch/a.btf", "(BehaviorTree :name t (Action :ID a))");
  write(here / "batch/a.ltl", "property p: never a.success\n");
  return here / "batch/.btcheck-results";
}

TEST_CASE("a forged result is not believed where there is a key") {
  TemporaryFolder folder;
  const fs::path& here = folder.path();
  const fs::path results = missed_batch(here);
  const std::string with_key = "BTCHECK_RESULTS_KEY=k3y ";
  const auto batch = [&](const std::string& key) {
    return run_in(here, key + kProgram + " batch batch --resume 2>&1");
  };
  CHECK(batch(with_key).code == 1);
  const Outcome again = batch(with_key);
  CHECK(again.code == 1);
  CHECK(has(again.text, "1 of them taken from an earlier run"));
  // Sealed as everybody can: without a key.
  CHECK(batch("").code == 1);
  const std::string unsealed = file_text(results);
  const Outcome other = batch(with_key);
  CHECK(other.code == 1);
  CHECK(has(other.text, "BT1508"));
  CHECK(!has(other.text, "taken from an earlier run"));
  // HMAC-SHA-1, as another program computes it.
  const Outcome seal = run_in(
      here,
      "python3 -c \"import hmac; line = open('batch/.btcheck-results')"
      ".read().splitlines()[1]; seal, rest = line.split(' ', 1); "
      "print(seal == hmac.new(b'k3y', rest.encode(), 'sha1').hexdigest())\"");
  CHECK(seal.text == "True\n");
  CHECK(kept_line(file_text(results)) != kept_line(unsealed));
}

TEST_CASE("results say where they were made, and are of one build") {
  TemporaryFolder folder;
  const fs::path results = missed_batch(folder.path());
  CHECK(btcheck_in(folder.path(), "batch batch -q").code == 1);
  const std::string first = file_text(results);
  CHECK(first.starts_with("# btcheck "));
  CHECK(has(first.substr(0, first.find('\n')), folder.path().string()));
  // Another program of the same version: a byte behind its end.
  fs::copy_file(kProgram, folder.path() / "other");
  std::ofstream(folder.path() / "other", std::ios::app) << ' ';
  const Outcome other =
      run_in(folder.path(), "./other batch batch --resume 2>&1");
  CHECK(other.code == 1);
  CHECK(!has(other.text, "taken from an earlier run"));
}

TEST_CASE("results that cannot be kept are told of") {
  TemporaryFolder folder;
  missed_batch(folder.path());
  const Outcome outcome =
      run_in(folder.path(), "ulimit -f 0; " + kProgram + " batch batch 2>&1");
  CHECK(has(outcome.text, "BT1509"));
}

// Puts something there that is no file of ours.
void put_trap(const fs::path& file, const std::string& kind) {
  fs::remove_all(file);
  if (kind == "pipe") {
    REQUIRE(::mkfifo(file.c_str(), 0600) == 0);
  } else if (kind == "link") {
    fs::create_symlink("../secret", file);
  } else if (kind == "folder") {
    fs::create_directory(file);
  } else {
    write(file, kind);
  }
}

TEST_CASE("nothing that lies in a shared folder is believed or waited for") {
  TemporaryFolder folder;
  const fs::path& here = folder.path();
  missed_batch(here);
  write(here / "secret", "password = hunter2\n");
  const std::string shared =
      "timeout 60 " + kProgram + " batch batch --lease 0.2 --results ";
  const std::string with_key = "BTCHECK_RESULTS_KEY=k3y " + shared;
  // Sealed as everybody can.
  CHECK(run_in(here, shared + "forged -q").code == 1);
  CHECK(run_in(here, with_key + "shared -q").code == 1);
  const fs::path found = fs::directory_iterator(here / "forged")->path();
  const fs::path result = here / "shared" / found.filename();
  REQUIRE(fs::exists(result));
  fs::path lease = result;
  lease.replace_extension(".1.lease");
  for (const std::string& kind :
       {file_text(found), std::string("pipe"), std::string("link"),
        std::string("folder"), std::string("../../secret\n"),
        std::string("\x1b[2Jhunter2")}) {
    CAPTURE(kind);
    for (const fs::path& place : {result, lease}) {
      fs::remove_all(result);
      put_trap(place, kind);
      const Outcome joined =
          run_in(here, "BTCHECK_RESULTS_KEY=k3y timeout 60 " + kProgram +
                           " batch batch --join shared 2>&1");
      CHECK(joined.code == 3);
      CHECK(has(joined.text, "BT1513"));
      const Outcome outcome = run_in(here, with_key + "shared 2>&1");
      CHECK(outcome.code == 1);
      CHECK(has(outcome.text, "MISSED "));
      CHECK(!has(outcome.text, "taken from"));
      CHECK(has(outcome.text, "BT1508") == (place == result));
      CHECK(!has(joined.text + outcome.text, "hunter2"));
      CHECK(is_harmless(joined.text + outcome.text));
      fs::remove_all(lease);
    }
  }
  CHECK(file_text(here / "secret") == "password = hunter2\n");
}

// --- Little memory, few threads ------------------------------------------

TEST_CASE("an entry that is killed takes no other with it") {
  TemporaryFolder folder;
  const fs::path& here = folder.path();
  for (const char* name : {"a", "c", "d"}) {
    write(here / "batch" / (std::string(name) + ".btf"),
          "(BehaviorTree :name t (Action :ID a))");
  }
  std::string wide = "(BehaviorTree :name t :loop 1 (ParallelAll";
  for (int i = 0; i < 14; ++i) {
    wide += " (Action :ID a" + std::to_string(i) + ")";
  }
  write(here / "batch/b.btf", wide + "))\n");
  write(here / "batch/b.ltl", "property p: AG EF root.running\n");
  ChildProcess child({kProgram, "batch", "batch", "--jobs", "2"},
                     here.string());
  // The worker of the large tree, by the time it has worked.
  Outcome killed;
  for (int tries = 0; tries < 300 && killed.code != 0; ++tries) {
    killed = run_in(here, "sleep 0.1; for p in $(pgrep -P " +
                              std::to_string(child.id()) +
                              "); do t=$(ps -o cputimes= -p $p); "
                              "[ ${t:-0} -ge 1 ] && kill -KILL $p && exit 0; "
                              "done; exit 1");
  }
  const Ending ending = child.wait();
  const std::string text = file_text(here / "stdout");
  CAPTURE(text);
  CHECK(ending.code == 3);
  CHECK(has(text, "1 undecided"));
  CHECK(has(text, "UNDECIDED"));
  CHECK(has(file_text(here / "stderr"), "killed, by the system"));
}

TEST_CASE("five thousand children are no more than five are") {
  TemporaryFolder folder;
  std::string wide = "(BehaviorTree :name t :loop 1 (Sequence";
  for (int i = 0; i < 5000; ++i) {
    wide += "\n (Condition :ID c" + std::to_string(i) + ")";
  }
  write(folder.path() / "wide.btf", wide + "))\n");
  write(folder.path() / "wide.ltl", "property p: never root.failure\n");
  // Under the sanitizers ten times as long, and then still far from a minute.
  const Outcome outcome = btcheck_in(
      folder.path(), "wide.btf --prop wide.ltl -q --timeout 40 2>&1");
  CHECK(outcome.code == 1);
  CHECK(has(outcome.text, "VIOLATED   p  (after 1 tick)"));
  CHECK(btcheck_in(folder.path(), "export wide.btf --to dot >/dev/null").code ==
        0);
}

// --- The binary ----------------------------------------------------------

TEST_CASE("the program is built to be hard to misuse") {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const Outcome file = run("readelf -hldW --dyn-syms " + kProgram + " 2>&1");
  if (has(file.text, "__asan_init") || has(file.text, "__tsan_init")) return;
  REQUIRE(file.code == 0);
  CHECK(has(file.text, "DYN (Position-Independent Executable file)"));
  CHECK(has(file.text, "GNU_RELRO"));
  CHECK(has(file.text, "BIND_NOW"));
  CHECK(!has(file.text,
             "GNU_STACK      0x000000 0x0000000000000000 "
             "0x0000000000000000 0x000000 0x000000 RWE"));
  CHECK(has(file.text, "__stack_chk_fail"));
#ifdef NDEBUG  // with optimization only
  CHECK(has(file.text, "_chk@GLIBC"));
#endif
#endif
}

// --- Long runs, odd numbers ----------------------------------------------

TEST_CASE("a run too long for `trace` is not written") {
  TemporaryFolder folder;
  write(folder.path() / "t.btf",
        "(BehaviorTree :name t :loop 1 (ReactiveSequence (Condition :ID c) "
        "(Sequence (Action :ID a) (Action :ID b))))\n");
  const Outcome outcome =
      btcheck_in(folder.path(),
                 "simulate t.btf --seed 1 --ticks 20000 -o r.json 2>&1 "
                 ">/dev/null");
  CHECK(outcome.code == 2);
  CHECK(has(outcome.text, "ask for fewer --ticks"));
  CHECK(!fs::exists(folder.path() / "r.json"));
}

TEST_CASE("settings of a hundred thousand levels are read, or refused") {
  TemporaryFolder folder;
  std::string levels = "[levels]\n";
  std::string paths;
  for (int i = 0; i < 100'000; ++i) {
    levels += "BT" + std::to_string(i + 30'000) + " = \"note\"\n";
    paths += "[[paths]]\nmatch = \"" + std::to_string(i) +
             "*a*b*c\"\nlevels = { BT2205 = \"note\" }\n";
  }
  write(folder.path() / "t.btf", "(BehaviorTree :name t (Action :ID a))\n");
  write(folder.path() / "btcheck.toml", levels);
  const Outcome refused = btcheck_in(folder.path(), "t.btf 2>&1");
  CHECK(refused.code == 2);
  CHECK(has(refused.text, "error[BT1510]: no code `BT30000`"));
  CHECK(refused.text.size() < 10'000);
  write(folder.path() / "btcheck.toml", paths);
  CHECK(btcheck_in(folder.path(), "t.btf").code == 0);
  std::string deep = "a";
  for (int i = 0; i < 100'000; ++i) deep += ".a";
  write(folder.path() / "btcheck.toml", deep + " = 1\n");
  CHECK(btcheck_in(folder.path(), "t.btf").code == 2);
}

TEST_CASE("settings that are no file are refused, not waited for") {
  TemporaryFolder folder;
  const fs::path settings = folder.path() / "btcheck.toml";
  write(folder.path() / "t.btf", "(BehaviorTree :name t (Action :ID a))\n");
  REQUIRE(::mkfifo(settings.c_str(), 0600) == 0);
  for (const char* command :
       {"t.btf", "lint t.btf", "space t.btf", "batch ."}) {
    const Outcome outcome =
        btcheck_in(folder.path(), std::string(command) + " 2>&1");
    CHECK(outcome.code == 2);
    CHECK(has(outcome.text, "is a pipe or a device"));
  }
  fs::remove(settings);
  fs::create_symlink("btcheck.toml", settings);  // to itself
  CHECK(btcheck_in(folder.path(), "t.btf").code == 2);
  fs::remove(settings);
  write(folder.path() / "secret.txt", "secret = hidden\n");
  write(folder.path() / "in/t.btf", "(BehaviorTree :name t (Action :ID a))\n");
  fs::create_symlink("../secret.txt", folder.path() / "in/btcheck.toml");
  const Outcome outcome = btcheck_in(folder.path(), "batch in 2>&1");
  CHECK(outcome.code == 2);
  CHECK(has(outcome.text, "BT0009"));
  CHECK(!has(outcome.text, "hidden"));
}

TEST_CASE("settings are found above a tree that lies deep") {
  TemporaryFolder folder;
  std::string place = "d";
  for (int i = 0; i < 200; ++i) place += "/d";
  write(folder.path() / place / "t.btf",
        "(BehaviorTree :name t (Action :ID a))\n");
  write(folder.path() / "btcheck.toml", "profil = 1\n");
  CHECK(btcheck_in(folder.path(), place + "/t.btf").code == 2);
  fs::create_directory_symlink(".", folder.path() / "d/here");
  std::string round = "d";
  for (int i = 0; i < 30; ++i) round += "/here";
  CHECK(btcheck_in(folder.path(), round + place.substr(1) + "/t.btf").code ==
        2);
}

TEST_CASE("a baseline of a hundred thousand lists in each other is refused") {
  TemporaryFolder folder;
  write(folder.path() / "t.btf", "(BehaviorTree :name t (Action :ID a))\n");
  write(folder.path() / "b.json", std::string(100'000, '['));
  const Outcome outcome =
      btcheck_in(folder.path(), "t.btf --baseline b.json 2>&1");
  CHECK(outcome.code == 2);
  CHECK(has(outcome.text, "error[BT1511]"));
}

TEST_CASE("a number of a manifest that is none is refused") {
  TemporaryFolder folder;
  write(folder.path() / "m.toml",
        "[[entry]]\ntree = \"t.btf\"\nthreads = 1e308\n");
  const Outcome outcome = btcheck_in(folder.path(), "batch m.toml 2>&1");
  CHECK(outcome.code == 2);
  CHECK(has(outcome.text, "a number from 1"));
}

}  // namespace
}  // namespace btcheck
