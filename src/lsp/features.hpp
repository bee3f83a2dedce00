// SPDX-License-Identifier: MIT
//
// What an editor asks of a document. All answer at once, by what is known: a
// text that cannot be read is taken as far as it goes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lsp/workbench.hpp"
#include "text/json.hpp"

namespace btcheck::lsp {

// Answers are what the protocol calls the result; null where there is nothing.
Json hover(const View& view, Position at);
Json completions(const View& view, Position at, bool takes_snippets);

Json definitions(const View& view, Position at);
Json references(const View& view, Position at, bool with_declaration);
Json highlights(const View& view, Position at);
// Null where nothing here has a name to change.
Json rename_place(const View& view, Position at);
// Throws RpcError for a name that cannot be one.
Json renamed(const View& view, Position at, const std::string& name);

Json actions(const View& view, const Range& range);
Json lenses(const View& view);
Json hints(const View& view, const Range& range);

Json symbols(const View& view);
Json foldings(const View& view);
Json selections(const View& view, const std::vector<Position>& places);

// What kinds of tokens there are, and those of a document.
Json token_legend();
Json tokens(const View& view);

// Runs that can be shown: [{"name", "title"}].
Json runs(const View& view);

// What a check has come to, in a line.
std::string summary(const View& view);

// Edits that write the document in one style; null where it cannot be read.
Json formatted(const View& view);

}  // namespace btcheck::lsp
