" SPDX-License-Identifier: MIT
" Made by editors/vscode/script/grammars.mjs: btcheck-rules.
if exists("b:current_syntax") | finish | endif
syntax case match
syntax match btruleComment "#.*$\|//.*$\|;.*$" contains=@Spell
syntax match btruleTitle "^\s*##[^#].*$" contains=@Spell
syntax region btruleComment start="/\*" end="\*/"
syntax region btruleString start=+"+ end=+"+ oneline
syntax match btruleNumber "\<\d\+\>"
syntax match btruleEvent "\.\s*\zs\(answered\|failure\|rstatus\|running\|skipped\|success\|active\|answer\|halted\|status\|ticked\|ended\|moves\|done\|ends\|passes\)\>"
highlight default link btruleComment Comment
highlight default link btruleTitle SpecialComment
highlight default link btruleString String
highlight default link btruleNumber Number
highlight default link btruleEvent Special
syntax keyword btruleLogic release until and not or F G R U V W X
highlight default link btruleLogic Operator
syntax keyword btrulePattern infinitelyOften deadlockfree eventually globally possible precedes requires whenever between forbids lasting leadsto present absent always before causes mortal within after enter false leave never since stuck dead live root then tick true for ltl in is T
highlight default link btrulePattern Statement
syntax keyword btruleItem property assert assume expect prove tree let
highlight default link btruleItem Structure
syntax keyword btruleVerdict violated holds
highlight default link btruleVerdict Constant
let b:current_syntax = "btcheck-rules"
