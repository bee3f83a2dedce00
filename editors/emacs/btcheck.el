;;; btcheck.el --- Behavior trees, checked  -*- lexical-binding: t -*-

;; SPDX-License-Identifier: MIT
;; Package-Requires: ((emacs "28.1") (eglot "1.9"))

;;; Commentary:

;; Modes for .btf trees, rules (.ltl, .btp) and contracts of leaves (.leaves), and
;; btcheck's language server for them and for behavior trees in XML:
;;
;;   (add-to-list 'load-path "/usr/share/btcheck/editors/emacs")
;;   (require 'btcheck)
;;   (add-hook 'btcheck-btf-mode-hook #'eglot-ensure)
;;   (add-hook 'btcheck-rules-mode-hook #'eglot-ensure)
;;   (add-hook 'btcheck-leaves-mode-hook #'eglot-ensure)
;;   (add-hook 'nxml-mode-hook #'btcheck-ensure-in-tree)

;;; Code:

(require 'eglot)
(require 'btcheck-words)

(defgroup btcheck nil "Behavior trees, checked." :group 'tools)

(defcustom btcheck-command '("btcheck" "lsp")
  "The program of the language server, and its arguments."
  :type '(repeat string))

(defcustom btcheck-settings nil
  "What the server is told: a property list.
:profile, :checkOnType, :repairs, :seconds; booleans are t and :json-false."
  :type 'plist)

(defvar btcheck-btf-syntax-table
  (let ((table (make-syntax-table lisp-mode-syntax-table)))
    (modify-syntax-entry ?\; "<" table)
    (modify-syntax-entry ?\n ">" table)
    (modify-syntax-entry ?\[ "(]" table)
    (modify-syntax-entry ?\] ")[" table)
    (modify-syntax-entry ?| "_" table)
    table))

(defun btcheck-head-of (words)
  "An expression for a list of .btf that begins with one of WORDS."
  (concat "(\\s-*\\(" (regexp-opt words) "\\)\\_>"))

(defvar btcheck-btf-words
  `((,(concat (btcheck-head-of btcheck-words-forms)
              "\\s-*\\([^][ \t\n():;\"]+\\)?")
     (1 font-lock-keyword-face) (2 font-lock-function-name-face nil t))
    (,(btcheck-head-of btcheck-words-types) 1 font-lock-type-face)
    ("\\_<:[A-Za-z_-]+" . font-lock-builtin-face)
    ("\\$[^][ \t\n();\"]+" . font-lock-variable-name-face)))

;;;###autoload
(define-derived-mode btcheck-btf-mode prog-mode "BTF"
  "Behavior trees in .btf files."
  :syntax-table btcheck-btf-syntax-table
  (setq-local comment-start "; " comment-end "")
  (setq-local font-lock-defaults '(btcheck-btf-words nil t)))

;;;###autoload
(define-derived-mode btcheck-leaves-mode btcheck-btf-mode "Leaves"
  "Contracts of the leaves of behavior trees.")

(defvar btcheck-rules-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?# "<" table)
    (modify-syntax-entry ?\n ">" table)
    (modify-syntax-entry ?\" "\"" table)
    (modify-syntax-entry ?_ "w" table)
    table))

(defvar btcheck-rules-words
  `(("^\\s-*\\(property\\|prove\\|assert\\|let\\)\\s-+\\(\\sw+\\)"
     (1 font-lock-keyword-face) (2 font-lock-function-name-face))
    (,(concat "\\.\\s-*\\(" (regexp-opt btcheck-words-events) "\\)\\_>")
     1 font-lock-constant-face)
    (,(regexp-opt btcheck-words-items 'words) . font-lock-keyword-face)
    (,(regexp-opt btcheck-words-logic 'words) . font-lock-builtin-face)
    (,(regexp-opt btcheck-words-patterns 'words) . font-lock-keyword-face)))

;;;###autoload
(define-derived-mode btcheck-rules-mode prog-mode "Rules"
  "Rules about behavior trees."
  :syntax-table btcheck-rules-syntax-table
  (setq-local comment-start "# " comment-end "")
  (setq-local font-lock-defaults '(btcheck-rules-words)))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.btf\\'" . btcheck-btf-mode))
;;;###autoload
(add-to-list 'auto-mode-alist '("\\.leaves\\'" . btcheck-leaves-mode))
;;;###autoload
(add-to-list 'auto-mode-alist '("\\.\\(?:ltl\\|btp\\)\\'" . btcheck-rules-mode))
;;;###autoload
(add-to-list 'auto-mode-alist '("\\.btproj\\'" . nxml-mode))

(defclass btcheck-server (eglot-lsp-server) ()
  :documentation "The language server of btcheck.")

(cl-defmethod eglot-initialization-options ((_server btcheck-server))
  "What the user has set."
  (or btcheck-settings eglot--{}))

(defun btcheck-contact (_interactive)
  "How the server is started."
  (cons 'btcheck-server btcheck-command))

(add-to-list 'eglot-server-programs
             '((btcheck-btf-mode :language-id "btf") . btcheck-contact))
(add-to-list 'eglot-server-programs
             '((btcheck-leaves-mode :language-id "btcheck-leaves")
               . btcheck-contact))
(add-to-list 'eglot-server-programs
             '((btcheck-rules-mode :language-id "btcheck-rules")
               . btcheck-contact))
(add-to-list 'eglot-server-programs
             '((nxml-mode :language-id "xml") . btcheck-contact))

;;;###autoload
(defun btcheck-ensure-in-tree ()
  "Start the server where the XML of this buffer is a behavior tree."
  (when (save-excursion
          (goto-char (point-min))
          (re-search-forward
           "<\\(?:BehaviorTree\\|TreeNodesModel\\)\\_>\\|BTCPP_format"
           200000 t))
    (eglot-ensure)))

(provide 'btcheck)
;;; btcheck.el ends here
