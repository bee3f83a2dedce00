;;; btcheck-words.el --- What btcheck reads  -*- lexical-binding: t -*-

;; SPDX-License-Identifier: MIT

;;; Commentary:

;; Made by editors/vscode/script/grammars.mjs.

;;; Code:

(defconst btcheck-words-forms
  '("BehaviorTree"
    "Trees"
    "defaction"
    "defcondition"
    "defenum"
    "defsv"
    "defun"))

(defconst btcheck-words-types
  '("Action"
    "BehaviorTree"
    "Condition"
    "Eval"
    "Fallback"
    "ForceFailure"
    "ForceSuccess"
    "Inverter"
    "KeepRunningUntilFailure"
    "Parallel"
    "ParallelAll"
    "PipelineSequence"
    "RateController"
    "ReactiveFallback"
    "ReactiveSequence"
    "Recovery"
    "Repeat"
    "RetryUntilSuccessful"
    "RoundRobin"
    "Sequence"
    "SequenceWithMemory"
    "SetSV"
    "SubTree"
    "Timeout"
    "Wait"))

(defconst btcheck-words-items
  '("assert"
    "assume"
    "expect"
    "let"
    "property"
    "prove"
    "tree"))

(defconst btcheck-words-logic
  '("F"
    "G"
    "R"
    "U"
    "V"
    "W"
    "X"
    "and"
    "not"
    "or"
    "release"
    "until"))

(defconst btcheck-words-patterns
  '("T"
    "absent"
    "after"
    "always"
    "before"
    "between"
    "causes"
    "dead"
    "deadlockfree"
    "enter"
    "eventually"
    "false"
    "for"
    "forbids"
    "globally"
    "in"
    "infinitelyOften"
    "is"
    "lasting"
    "leadsto"
    "leave"
    "live"
    "ltl"
    "mortal"
    "never"
    "possible"
    "precedes"
    "present"
    "requires"
    "root"
    "since"
    "stuck"
    "then"
    "tick"
    "true"
    "whenever"
    "within"))

(defconst btcheck-words-events
  '("active"
    "answer"
    "answered"
    "done"
    "ended"
    "failure"
    "halted"
    "moves"
    "rstatus"
    "running"
    "skipped"
    "status"
    "success"
    "ticked"))

(provide 'btcheck-words)
;;; btcheck-words.el ends here
