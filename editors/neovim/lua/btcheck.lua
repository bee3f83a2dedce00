-- SPDX-License-Identifier: MIT
--
-- btcheck in Neovim, from 0.7 on, without another plugin:
--   require("btcheck").setup()
--   require("btcheck").setup({ cmd = { "/opt/btcheck", "lsp" }, settings = { seconds = 5 } })
-- One server is started for each folder that has a btcheck.toml, or is a
-- repository, when the first tree, rule or contract in it is opened.
local M = {}

local LANGUAGES = { btf = true, ["btcheck-rules"] = true, ["btcheck-leaves"] = true }
local options = { cmd = { "btcheck", "lsp" }, settings = {}, on_attach = nil }
local clients = {} -- by folder

-- Most XML is no behavior tree, and none of our business.
local function is_ours(buffer)
  local filetype = vim.bo[buffer].filetype
  if LANGUAGES[filetype] then return true end
  if filetype ~= "xml" then return false end
  for _, line in ipairs(vim.api.nvim_buf_get_lines(buffer, 0, 2000, false)) do
    if line:find("<BehaviorTree%f[%W]") or line:find("<TreeNodesModel%f[%W]")
      or line:find("BTCPP_format") then
      return true
    end
  end
  return false
end

-- The nearest folder above that has one of the names, else the file's own.
local function root_of(buffer)
  local file = vim.api.nvim_buf_get_name(buffer)
  local own = vim.fn.fnamemodify(file ~= "" and file or vim.fn.getcwd(), ":p:h")
  for _, name in ipairs({ "btcheck.toml", ".git" }) do
    local folder = own
    while true do
      if vim.loop.fs_stat(folder .. "/" .. name) then return folder end
      local above = vim.fn.fnamemodify(folder, ":h")
      if above == folder then break end
      folder = above
    end
  end
  return own
end

local function start(folder)
  return vim.lsp.start_client({
    name = "btcheck",
    cmd = options.cmd,
    root_dir = folder,
    workspace_folders = { { uri = vim.uri_from_fname(folder), name = folder } },
    init_options = options.settings,
    on_attach = options.on_attach,
    get_language_id = function(_, filetype) return filetype end,
    on_exit = function() clients[folder] = nil end,
  })
end

function M.attach(buffer)
  if not is_ours(buffer) then return end
  local folder = root_of(buffer)
  if not clients[folder] then
    if vim.fn.executable(options.cmd[1]) == 0 then
      vim.notify_once("btcheck: the program `" .. options.cmd[1] .. "` is not found",
        vim.log.levels.WARN)
      return
    end
    clients[folder] = start(folder)
  end
  if clients[folder] then vim.lsp.buf_attach_client(buffer, clients[folder]) end
end

-- `given`: cmd, settings (profile, checkOnType, repairs, seconds), on_attach.
function M.setup(given)
  options = vim.tbl_extend("force", options, given or {})
  vim.api.nvim_create_autocmd({ "FileType" }, {
    group = vim.api.nvim_create_augroup("btcheck", { clear = true }),
    pattern = { "btf", "btcheck-rules", "btcheck-leaves", "xml" },
    callback = function(event) M.attach(event.buf) end,
  })
end

return M
