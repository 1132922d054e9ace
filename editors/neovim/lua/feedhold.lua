-- Feedhold for Neovim 0.7 and newer: require('feedhold').setup{}
local M = {}

local settings = {
  path = 'feedhold', -- the program: its name, found on the PATH, or where it is
  proofs = 'onSave', -- 'off', 'onSave' (on opening and saving) or 'onType'
  on_attach = nil, -- function(client, buffer): key maps and such
}

local function root_of(file)
  local folder = vim.fn.fnamemodify(file, ':p:h')
  local config = vim.fn.findfile('feedhold.toml', folder .. ';')
  return config ~= '' and vim.fn.fnamemodify(config, ':p:h') or folder
end

local function client_config(buffer)
  return {
    name = 'feedhold',
    cmd = { settings.path, 'lsp' },
    root_dir = root_of(vim.api.nvim_buf_get_name(buffer)),
    init_options = { proofs = settings.proofs },
    settings = { feedhold = { proofs = settings.proofs } },
    on_attach = settings.on_attach,
  }
end

-- vim.lsp.start, which came with 0.8, does the same: one server for each root.
local clients_by_root = {}
local function start_as_0_7(config, buffer)
  local id = clients_by_root[config.root_dir]
  if not id or vim.lsp.client_is_stopped(id) then
    id = vim.lsp.start_client(config)
    clients_by_root[config.root_dir] = id
  end
  if id then
    vim.lsp.buf_attach_client(buffer, id)
  end
end

local function attach(buffer)
  if vim.fn.executable(settings.path) == 0 then
    vim.notify_once(
      'feedhold: `' .. settings.path .. "` was not found; install it, or say where it is: require('feedhold').setup{path = ...}",
      vim.log.levels.ERROR
    )
  elseif vim.lsp.start then
    vim.lsp.start(client_config(buffer), { bufnr = buffer })
  else
    start_as_0_7(client_config(buffer), buffer)
  end
end

function M.setup(wishes)
  settings = vim.tbl_extend('force', settings, wishes or {})
  vim.api.nvim_create_autocmd('FileType', {
    group = vim.api.nvim_create_augroup('feedhold', {}),
    pattern = { 'macrob', 'macrobcontract' },
    callback = function(event)
      attach(event.buf)
    end,
  })
end

return M
