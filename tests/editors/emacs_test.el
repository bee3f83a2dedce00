;;; emacs_test.el --- editors/emacs in Emacs itself  -*- lexical-binding: t -*-

;; SPDX-License-Identifier: MIT
;;
;; Without a window: a finding in Nav2's default tree is heard of, asked about
;; and repaired.  In a folder with navigate.xml, package.xml and drone3.btf:
;;   BTCHECK=… emacs --batch -L …/editors/emacs -l emacs_test.el

(require 'btcheck)
(require 'flymake)

(defconst patience 60)

(defun check (is-so what)
  (unless is-so
    (princ (format "not ok - %s\n" what))
    (ignore-errors (eglot-shutdown-all))
    (kill-emacs 1))
  (princ (format "ok - %s\n" what)))

(defun wait-for (is-so what)
  (let ((end (+ (float-time) patience)))
    (while (and (not (funcall is-so)) (< (float-time) end))
      (accept-process-output nil 0.1)))
  (check (funcall is-so) what))

(defun finding (line code)
  "The finding of CODE at LINE, as Flymake has it."
  (seq-find (lambda (one)
              (and (= (line-number-at-pos (flymake-diagnostic-beg one)) line)
                   (string-match-p code (flymake-diagnostic-text one))))
            (flymake-diagnostics)))

(setq btcheck-command (list (getenv "BTCHECK") "lsp")
      btcheck-settings '(:seconds 60)
      eglot-sync-connect 60
      eglot-connect-timeout 60
      eglot-confirm-server-initiated-edits nil)

(find-file "package.xml")
(check (eq major-mode 'nxml-mode) "XML has its mode")
(btcheck-ensure-in-tree)
(check (null eglot--managed-mode) "other XML starts no server")

(find-file "navigate.xml")
(apply #'eglot (eglot--guess-contact))
(check (eglot-current-server) "the server starts")
(wait-for (lambda () (finding 50 "RecoveryActions.*fails"))
          "the finding of line 50 is told")
(goto-char (flymake-diagnostic-beg (finding 50 "RecoveryActions.*fails")))
(forward-char 2)

(let ((hover (jsonrpc-request (eglot--current-server-or-lose)
                              :textDocument/hover
                              (eglot--TextDocumentPositionParams)
                              :timeout patience)))
  (check (string-match-p "RoundRobin" (format "%S" hover))
         "hover tells of the node"))

(defvar repair nil)
(wait-for
 (lambda ()
   (setq repair
         (seq-find
          (lambda (action)
            (and (plist-get action :edit)
                 (string-match-p "wrap_around" (plist-get action :title))))
          (jsonrpc-request (eglot--current-server-or-lose)
                           :textDocument/codeAction
                           (list :textDocument (eglot--TextDocumentIdentifier)
                                 :range (list :start (eglot--pos-to-lsp-position)
                                              :end (eglot--pos-to-lsp-position))
                                 :context '(:diagnostics []))
                           :timeout patience))))
 "the repair is offered")
(eglot--apply-workspace-edit (plist-get repair :edit))
(goto-char (point-min))
(check (search-forward
        "<RoundRobin name=\"RecoveryActions\" wrap_around=\"true\">" nil t)
       "it is applied")
(eglot--signal-textDocument/didChange)
(wait-for (lambda () (not (finding 50 "RecoveryActions.*fails")))
          "the finding goes")

(find-file "drone3.btf")
(check (eq major-mode 'btcheck-btf-mode) "a .btf file is known")
(apply #'eglot (eglot--guess-contact))
(let ((symbols (jsonrpc-request
                (eglot--current-server-or-lose) :textDocument/documentSymbol
                (list :textDocument (eglot--TextDocumentIdentifier))
                :timeout patience)))
  (check (string-match-p "measure_battery" (format "%S" symbols))
         "it has an outline"))
(ignore-errors (eglot-shutdown-all))
(kill-emacs 0)
;;; emacs_test.el ends here
