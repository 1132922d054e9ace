" Names of programs and of contracts.  `set` and not `setf`: others claim *.nc, too.
autocmd BufNewFile,BufRead *.nc,*.cnc,*.tap,*.ngc,*.eia,*.ncd,*.prg set filetype=macrob
autocmd BufNewFile,BufRead [oO][0-9]\\\{4,8\} set filetype=macrob
autocmd BufNewFile,BufRead *.contract set filetype=macrobcontract
