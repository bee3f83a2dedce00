-- SPDX-License-Identifier: MIT
--
-- editors/neovim in Neovim itself, without a window: a finding in Nav2's default
-- tree is heard of, asked about and repaired. In a folder with navigate.xml,
-- package.xml, drone3.btf and drone3.ltl:
--   BTCHECK=… nvim --headless --clean --cmd "set rtp^=…/editors/neovim"
--     -c "luafile neovim_test.lua"
local PATIENCE = 60000
local failed = false

local function fail(text)
  failed = true
  error(text, 0)
end
local function check(is_so, what)
  if not is_so then fail(what) end
  io.stdout:write("ok - " .. what .. "\n")
end
local function wait_for(is_so, what)
  check(vim.wait(PATIENCE, is_so, 100), what)
end

local function finding(line, code)
  for _, one in ipairs(vim.diagnostic.get(0, { lnum = line })) do
    if one.code == code or (one.user_data and one.user_data.lsp
        and one.user_data.lsp.code == code) then
      return one
    end
  end
end

local function ask(method, parameters)
  local answers = vim.lsp.buf_request_sync(0, method, parameters, PATIENCE) or {}
  for _, answer in pairs(answers) do
    if answer.result then return answer.result end
  end
end

local function test()
  require("btcheck").setup({ cmd = { vim.env.BTCHECK, "lsp" }, settings = { seconds = 60 } })

  vim.cmd("edit package.xml")
  vim.wait(1000)
  check(#vim.lsp.get_active_clients() == 0, "other XML starts no server")

  vim.cmd("edit navigate.xml")
  wait_for(function() return finding(49, "BT2208") ~= nil end, "the finding of line 50 is told")
  local found = finding(49, "BT2208")
  check(found.message:find("RecoveryActions") ~= nil, "it names the node")
  check(found.severity == vim.diagnostic.severity.WARN, "it is a warning")

  local here = { textDocument = vim.lsp.util.make_text_document_params(),
                 position = { line = 49, character = 14 } }
  local hover = ask("textDocument/hover", here)
  check(hover and vim.inspect(hover.contents):find("RoundRobin"), "hover tells of the node")

  here.range = { start = here.position, ["end"] = here.position }
  here.context = { diagnostics = {} }
  local edit
  local is_there = function()
    for _, action in ipairs(ask("textDocument/codeAction", here) or {}) do
      if action.edit and action.title:find("wrap_around") then
        edit = action.edit
        return true
      end
    end
  end
  wait_for(is_there, "the repair is offered")
  vim.lsp.util.apply_workspace_edit(edit, "utf-16")
  local line = vim.api.nvim_buf_get_lines(0, 49, 50, true)[1]
  check(line == '          <RoundRobin name="RecoveryActions" wrap_around="true">', "it is applied")
  wait_for(function() return finding(49, "BT2208") == nil end, "the finding goes")
  wait_for(function() return finding(48, "BT2209") ~= nil end, "the others stay")

  vim.cmd("edit! drone3.btf")
  check(vim.bo.filetype == "btf", "a .btf file is known")
  vim.cmd("syntax on")
  local group = function(row, column)
    return vim.fn.synIDattr(vim.fn.synID(row, column, 1), "name")
  end
  check(group(1, 3) == "btfForm" and group(12, 3) == "btfType" and group(1, 50) == "btfComment"
    and group(2, 4) == "btfKeyword" and group(21, 13) == "btfOperator", "it is highlighted")
  wait_for(function() return #vim.lsp.buf_get_clients(0) == 1 end, "the server hears of it")
  check(#vim.lsp.get_active_clients() == 1, "one server is enough for a folder")
  local symbols = ask("textDocument/documentSymbol",
    { textDocument = vim.lsp.util.make_text_document_params() })
  check(symbols and vim.inspect(symbols):find("measure_battery"), "it has an outline")

  vim.cmd("edit drone3.ltl")
  check(vim.bo.filetype == "btcheck-rules", "rules are known")
  vim.api.nvim_buf_set_lines(0, -1, -1, true, { "property x: nevver land@23.ticked" })
  wait_for(function()
    return #vim.diagnostic.get(0, { severity = vim.diagnostic.severity.ERROR }) > 0
  end, "a mistake in a rule is told")
end

local is_well, why = pcall(test)
if not is_well then io.stdout:write("not ok - " .. tostring(why) .. "\n") end
vim.lsp.stop_client(vim.lsp.get_active_clients())
vim.cmd(is_well and not failed and "qall!" or "cquit 1")
