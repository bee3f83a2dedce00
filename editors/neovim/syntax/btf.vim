" SPDX-License-Identifier: MIT
" Made by editors/vscode/script/grammars.mjs: btf.
if exists("b:current_syntax") | finish | endif
syntax case ignore
syntax iskeyword @,48-57,_,-,:
syntax match btfComment ";.*$" contains=@Spell
syntax region btfString start=+"+ end=+"+ oneline
syntax match btfNumber "\<[-+]\?\d[0-9.]*\(ms\|s\)\?\>"
syntax match btfVariable "\$[^ \t()\";]\+"
syntax match btfOperator "(\s*\zs\(and\|mod\|not\|!=\|\/=\|:=\|<=\|>=\|or\|\~=\|\*\|+\|-\|\/\|<\|=\|>\|\~\)\ze\s"
highlight default link btfComment Comment
highlight default link btfString String
highlight default link btfNumber Number
highlight default link btfVariable Identifier
highlight default link btfOperator Operator
syntax keyword btfForm BehaviorTree defcondition defaction Trees defsv defun
highlight default link btfForm Structure
syntax keyword btfType KeepRunningUntilFailure RetryUntilSuccessful SequenceWithMemory PipelineSequence ReactiveFallback ReactiveSequence RateController BehaviorTree ForceFailure ForceSuccess ParallelAll RoundRobin Condition Fallback Inverter Parallel Recovery Sequence SubTree Timeout Action Repeat SetSV Eval Wait
highlight default link btfType Type
syntax keyword btfKeyword :may-be-cut-off :succeeds-when :num_attempts :holds-while :may-be-lost :num_retries :transitions :asked-once :idempotent :on-failure :on-success :tells-only :undone-by :duration :may-stay :requires :answers :returns :success :repeat :states :moves :retry :args :halt :init :loop :name :step :wait :max :min :ID :SF :hz :sv
highlight default link btfKeyword Label
syntax keyword btfValue failure running sampled skipped success :all anew free once all inf yes no
highlight default link btfValue Constant
let b:current_syntax = "btf"
