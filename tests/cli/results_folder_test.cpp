// SPDX-License-Identifier: MIT
//
// A folder of results: what one has found the other has, and nothing else is
// believed.
#include "batch/results/results_folder.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "batch/results/kept_text.hpp"
#include "file_text.hpp"
#include "temporary_folder.hpp"

namespace btcheck::results_folder_test {
namespace {

namespace fs = std::filesystem;

using enum ResultsFolder::Role;

// One of several in a folder.
struct Member : ResultsFolder {
  explicit Member(const TemporaryFolder& folder, Role role = Works,
                  const std::string& secret = {})
      : ResultsFolder(folder.path(), role, 3600, secret) {}
};

bool is_held(KeptResults& kept, const std::string& key) {
  return kept.holder_of(key) != KeptResults::Holder::Nobody;
}

const std::string kKey = content_hash("a");
const std::string kOther = content_hash("b");

ReportedTree tree_named(const std::string& entry, double seconds = 0) {
  ReportedTree tree;
  tree.entry = entry;
  tree.seconds = seconds;
  tree.files.emplace_back();
  return tree;
}

void put(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

fs::path result_of(const TemporaryFolder& folder, const std::string& key) {
  return folder.path() / (key + ".result");
}

TEST_CASE("what one has found the other has") {
  const TemporaryFolder folder;
  Member one(folder);
  Member two(folder);
  CHECK(one.claim(kKey) == KeptResults::Claim::Ours);
  CHECK(two.claim(kKey) == KeptResults::Claim::Others);
  CHECK(is_held(two, kKey));
  CHECK(two.why_missing("e", kKey).starts_with("begun by "));
  one.add(kKey, tree_named("e"));
  CHECK(!is_held(two, kKey));
  CHECK(kept_text(two.find(kKey).tree.value()) == kept_text(tree_named("e")));
  CHECK(!two.find(kOther).tree.has_value());
  CHECK(one.complaint().empty());
}

TEST_CASE("wherever a file ends, and whatever byte is another one") {
  const TemporaryFolder folder;
  Member(folder).add(kKey, tree_named("e"));
  const fs::path file = result_of(folder, kKey);
  const std::string text = file_text(file);
  Member member(folder);
  for (std::size_t end = 0; end < text.size(); ++end) {
    put(file, text.substr(0, end));
    REQUIRE(!member.find(kKey).tree.has_value());
    REQUIRE(member.find(kKey).is_damaged);
  }
  for (std::size_t at = text.rfind('#'); at < text.size(); ++at) {
    std::string damaged = text;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    put(file, damaged);
    const KeptResults::Found found = member.find(kKey);
    // The lines for people are not sealed.
    if (found.tree) {
      REQUIRE(kept_text(*found.tree) == kept_text(tree_named("e")));
      REQUIRE(at < text.rfind('\n', text.size() - 2));
    } else {
      REQUIRE(found.is_damaged);
    }
  }
  for (const std::string& behind : {text + text, text + "x", text + "\n"}) {
    put(file, behind);
    CHECK(member.find(kKey).is_damaged);
  }
}

TEST_CASE("the result of another entry under its name is not believed") {
  const TemporaryFolder folder;
  Member member(folder);
  member.add(kKey, tree_named("e"));
  fs::copy(result_of(folder, kKey), result_of(folder, kOther));
  CHECK(member.find(kOther).is_damaged);
  CHECK(member.why_missing("f", kOther) ==
        "damaged or foreign result in `" + folder.path().string() + "`");
}

TEST_CASE("sealed with another key, a result is not believed") {
  const TemporaryFolder folder;
  Member member(folder, Works, "k3y");
  member.add(kKey, tree_named("e"));
  CHECK(member.find(kKey).tree.has_value());
  CHECK(Member(folder, Works).find(kKey).is_damaged);
  CHECK(Member(folder, Works, "other").find(kKey).is_damaged);
}

TEST_CASE("what is no file is not waited for, nor written to") {
  const TemporaryFolder folder;
  Member member(folder);
  const fs::path pipe = result_of(folder, kKey);
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  put(folder.path() / "mine", "as it was");
  fs::create_symlink("mine", result_of(folder, kOther));
  for (const std::string& key : {kKey, kOther}) {
    CHECK(member.find(key).is_damaged);
    member.add(key, tree_named("e"));
    CHECK(member.find(key).tree.has_value());
  }
  CHECK(fs::is_regular_file(fs::symlink_status(pipe)));
  CHECK(file_text(folder.path() / "mine") == "as it was");
}

TEST_CASE("what has failed is kept, and gives way to what has not") {
  const TemporaryFolder folder;
  Member member(folder);
  ReportedTree failed = tree_named("e");
  failed.files[0].stopped = StopReason::Memory;
  member.add(kKey, failed);
  CHECK(member.find(kKey).tree.has_value());
  member.add(kKey, tree_named("e"));
  member.add(kKey, failed);
  CHECK(may_be_kept(member.find(kKey).tree.value()));
  member.add(kOther, failed);
  member.drop_failed();
  CHECK(member.find(kKey).tree.has_value());
  CHECK(!member.find(kOther).tree.has_value());
}

TEST_CASE("a join checks nothing, and says why something is missing") {
  const TemporaryFolder folder;
  Member(folder).add(kKey, tree_named("e", 2.5));
  const std::string place = "`" + folder.path().string() + "`";
  Member join(folder, Joins);
  CHECK(join.claim(kOther) == KeptResults::Claim::Nobodys);
  CHECK(join.why_missing("f", kOther) == "no result in " + place);
  CHECK(join.why_missing("e", kOther) ==
        "result of other inputs or options in " + place);
  std::string text = file_text(result_of(folder, kKey));
  const std::size_t build = text.find("(build ") + 7;
  text[build] = text[build] == '0' ? '1' : '0';
  put(result_of(folder, kKey), text);
  CHECK(Member(folder, Joins).why_missing("e", kOther) ==
        "result of another build in " + place);
  // And leaves nothing behind.
  CHECK(fs::exists(result_of(folder, kKey)));
  CHECK(std::distance(fs::directory_iterator(folder.path()),
                      fs::directory_iterator()) == 1);
}

TEST_CASE("pages that are not here are not linked by a join") {
  const TemporaryFolder folder;
  ReportedTree tree = tree_named("e");
  tree.files[0].verdicts.emplace_back().page = "/nowhere/a.html";
  Member member(folder);
  member.add(kKey, tree);
  const auto page = [](const KeptResults& kept) {
    return kept.find(kKey).tree.value().files[0].verdicts[0].page;
  };
  CHECK(page(member) == "/nowhere/a.html");
  CHECK(page(Member(folder, Joins)).empty());
}

TEST_CASE("what an entry took is known of any earlier result") {
  const TemporaryFolder folder;
  Member first(folder);
  first.add(kKey, tree_named("e", 2.5));
  first.add(kOther, tree_named("e", 1.25));
  first.add(content_hash("c"), tree_named("a\nb", 0.5));
  put(folder.path() / "x.result", "# 7\n# 8 s\n# nothing");
  put(folder.path() / "y.result", "# (build \n# 1e999 s: g\n");
  const Member member(folder);
  CHECK(member.seconds_of("e") == 2.5);
  CHECK(member.seconds_of("a\nb") == 0.5);
  CHECK(std::isinf(member.seconds_of("f")));
  CHECK(std::isinf(member.seconds_of("g")));
}

TEST_CASE("where nothing can be written, everything else goes on") {
  ResultsFolder kept("/nowhere/at/all", Works, 60, {});
  CHECK(!kept.complaint().empty());
  CHECK(kept.claim(kKey) == KeptResults::Claim::Ours);
  kept.add(kKey, tree_named("e"));
  CHECK(!kept.find(kKey).tree.has_value());
}

}  // namespace
}  // namespace btcheck::results_folder_test
