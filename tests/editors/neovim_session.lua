-- What a person does in Neovim, with its own commands; what they see goes to session.json.
local seen = {}

local function wait_for(what, condition)
  if not vim.wait(20000, condition, 10) then
    error('waited in vain for ' .. what)
  end
end

local function lines()
  return vim.api.nvim_buf_get_lines(0, 0, -1, true)
end

local function diagnostics()
  return vim.tbl_map(function(it)
    local line = vim.api.nvim_buf_get_lines(0, it.lnum, it.lnum + 1, true)[1]
    local marked = it.lnum == it.end_lnum and line:sub(it.col + 1, it.end_col) or line:sub(it.col + 1)
    local told = it.user_data.lsp
    return { line = it.lnum + 1, marked = marked, code = told.code, severity = it.severity, message = it.message }
  end, vim.diagnostic.get(0))
end

local function has(code)
  for _, it in ipairs(diagnostics()) do
    if it.code == code then
      return true
    end
  end
  return false
end

-- Puts the cursor on the first place of `text`, `behind` bytes further.
local function go_to(text, behind)
  for number, line in ipairs(lines()) do
    local column = line:find(text, 1, true)
    if column then
      vim.api.nvim_win_set_cursor(0, { number, column - 1 + (behind or 0) })
      return
    end
  end
  error('there is no ' .. text)
end

local function floating_text()
  for _, window in ipairs(vim.api.nvim_list_wins()) do
    if vim.api.nvim_win_get_config(window).relative ~= '' then
      local text = vim.api.nvim_buf_get_lines(vim.api.nvim_win_get_buf(window), 0, -1, true)
      vim.api.nvim_win_close(window, true)
      return table.concat(text, '\n')
    end
  end
end

local function session()
  vim.cmd('filetype plugin on')
  local client
  require('feedhold').setup({
    path = vim.env.FEEDHOLD,
    on_attach = function(it)
      client = it
    end,
  })
  vim.cmd('edit O1000.nc')
  wait_for('findings of the flow', function()
    return has('loop-without-progress')
  end)
  seen.diagnostics = diagnostics()

  go_to('#100+1')
  vim.lsp.buf.hover()
  wait_for('the text of the hover', function()
    seen.hover = floating_text()
    return seen.hover
  end)

  go_to('g01')
  vim.ui.select = function(actions, options, choose)
    for index, action in ipairs(actions) do
      if options.format_item(action):find('upper case', 1, true) then
        return choose(action, index)
      end
    end
    error('no such repair: ' .. vim.inspect(actions))
  end
  vim.lsp.buf.code_action()
  wait_for('the repair', function()
    return not has('lower-case')
  end)
  seen.repaired = lines()

  go_to('N30')
  vim.lsp.buf.rename('N50')
  wait_for('the new name', function()
    return vim.tbl_contains(lines(), 'N50 G00 Y5.')
  end)
  seen.renamed = lines()

  go_to('GOTO99', 4)
  vim.cmd('normal! cw50')
  wait_for('findings behind a change', function()
    return not has('goto-missing-label')
  end)
  seen.typed = lines()
  seen.left = diagnostics()

  go_to('P9010', 1)
  vim.cmd('write')
  vim.lsp.buf.definition()
  wait_for('another file', function()
    return vim.fn.expand('%:t') ~= 'O1000.nc'
  end)
  seen.definition = { vim.fn.expand('%:t'), vim.fn.line('.') }

  vim.cmd('edit O9020.nc')
  wait_for('what is refuted', function()
    return vim.diagnostic.get(0, { severity = vim.diagnostic.severity.ERROR })[1]
  end)
  seen.refuted = diagnostics()
  vim.cmd('%s/#1\\*3/#1*2/')
  vim.cmd('write')
  wait_for('the proof', function()
    return #vim.diagnostic.get(0) == 0
  end)
  seen.proved = diagnostics()

  client.stop()
  wait_for('the end of the server', function()
    return client.is_stopped()
  end)
end

local ok, problem = pcall(session)
seen.problem = not ok and tostring(problem) or nil
vim.fn.writefile({ vim.json and vim.json.encode(seen) or vim.fn.json_encode(seen) }, 'session.json')
vim.cmd('qa!')
