" Colours of macro programs.
if exists("b:current_syntax")
  finish
endif
syntax case ignore

syntax match macrobAddress "[A-Z]\ze\s*[-+]\?\s*[-+0-9.#[]"
syntax match macrobNumber "\d\+\.\?\d*\|\.\d\+"
syntax match macrobCode "[GM]\s*\d\+\(\.\d\+\)\?"
syntax match macrobVariable "#\+\s*\(\d\+\|<[^>]*>\|\ze\[\)"
syntax match macrobOperator "[-+*/=]\|EQ\|NE\|GT\|GE\|LT\|LE\|XOR\|AND\|OR\|MOD"
syntax match macrobFunction "\(SIN\|COS\|TAN\|ASIN\|ACOS\|ATAN\|ATN\|SQRT\|SQR\|ABS\|ROUND\|RND\|FIX\|FUP\|LN\|EXP\|POW\|BIN\|BCD\|ADP\|PRM\|AXNUM\|AX\|EXISTS\)\ze\s*\["
syntax match macrobControl "ELSEIF\|ENDIF\|IF\|THEN\|ELSE\|WHILE\|DO\ze\s*\d\|END\ze\s*\d\|GOTO\|SETVN\|POPEN\|PCLOS\|[BD]PRNT"
syntax match macrobLabel "^\s*\(/\d\?\s*\)\?\zsN\s*\d\+"
syntax match macrobProgram "^\s*\zs[O:]\d\+"
syntax region macrobComment oneline start="(" end=")\|$"
syntax match macrobContract "(\s*@[^)]*)\?"

highlight default link macrobAddress Identifier
highlight default link macrobNumber Number
highlight default link macrobCode Keyword
highlight default link macrobVariable Special
highlight default link macrobOperator Operator
highlight default link macrobFunction Function
highlight default link macrobControl Statement
highlight default link macrobLabel Label
highlight default link macrobProgram Title
highlight default link macrobComment Comment
highlight default link macrobContract PreProc

let b:current_syntax = "macrob"
