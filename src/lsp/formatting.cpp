// SPDX-License-Identifier: MIT
#include "lsp/features.hpp"

namespace btcheck::lsp {

Json formatted(const View&) { return Json::null(); }

}  // namespace btcheck::lsp
