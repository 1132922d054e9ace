" Colours of contracts beside a program.
if exists("b:current_syntax")
  finish
endif
runtime! syntax/macrob.vim
syntax match macrobContract "^\s*@[A-Z-]\+"
syntax match macrobComment ";.*$"
let b:current_syntax = "macrobcontract"
