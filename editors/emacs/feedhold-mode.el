;;; feedhold-mode.el --- CNC macro programs, with Feedhold  -*- lexical-binding: t -*-

;; Version: 0.1.0
;; Package-Requires: ((emacs "26.3"))
;; Keywords: languages

;;; Commentary:

;; A mode for macro programs (FANUC Custom Macro B and kin), and `feedhold lsp' as their server in Eglot:
;;
;;   (require 'feedhold-mode)
;;   (add-hook 'feedhold-mode-hook #'eglot-ensure)
;;
;; Eglot comes with Emacs 29; on Debian 12 it is the package elpa-eglot.

;;; Code:

(defgroup feedhold nil
  "CNC macro programs."
  :group 'languages)

(defcustom feedhold-program "feedhold"
  "The program: its name, found on the PATH, or where it is."
  :type 'string)

(defcustom feedhold-proofs "onSave"
  "When programs with a contract are proved."
  :type '(choice (const :tag "never" "off")
                 (const :tag "when they are opened and saved" "onSave")
                 (const :tag "whenever you stop typing" "onType")))

(defconst feedhold--functions
  '("SIN" "COS" "TAN" "ASIN" "ACOS" "ATAN" "ATN" "SQRT" "SQR" "ABS" "ROUND" "RND" "FIX" "FUP" "LN" "EXP" "POW" "BIN"
    "BCD" "ADP" "PRM" "AXNUM" "AX" "EXISTS"))

(defconst feedhold--control-words
  '("IF" "THEN" "ELSE" "ELSEIF" "ENDIF" "WHILE" "GOTO" "SETVN" "POPEN" "PCLOS" "DPRNT" "BPRNT"))

;; Words need no blanks between them (`IF[#1EQ#0]GOTO10'), so nothing here asks for the end of a word.
(defconst feedhold--font-lock
  `(("(\\s-*\\(@[A-Z-]+\\)" 1 font-lock-preprocessor-face t)
    ("^\\s-*/?[1-9]?\\s-*\\([O:][0-9]+\\)" 1 font-lock-function-name-face)
    ("^\\s-*/?[1-9]?\\s-*\\(N\\s-*[0-9]+\\)" 1 font-lock-constant-face)
    (,(regexp-opt feedhold--control-words) . font-lock-keyword-face)
    ("\\(DO\\|END\\)\\s-*[0-9]" 1 font-lock-keyword-face)
    (,(concat "\\(" (regexp-opt feedhold--functions) "\\)\\s-*\\[") 1 font-lock-builtin-face)
    ("#+\\s-*\\(?:[0-9]+\\|<[^>\n]*>\\)\\|#+" . font-lock-variable-name-face)
    ("\\(?:EQ\\|NE\\|G[TE]\\|L[TE]\\|XOR\\|AND\\|OR\\|MOD\\)" . font-lock-builtin-face)
    ("[GM]\\s-*[0-9]+\\(?:\\.[0-9]+\\)?" . font-lock-type-face)))

(defvar feedhold-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?\( "<" table)
    (modify-syntax-entry ?\) ">" table)
    (modify-syntax-entry ?\n "> " table) ; a comment that is not closed ends with its line
    (modify-syntax-entry ?\" "." table)
    (modify-syntax-entry ?# "_" table)
    table))

;;;###autoload
(define-derived-mode feedhold-mode prog-mode "Macro B"
  "Major mode for CNC macro programs."
  (setq-local comment-start "(")
  (setq-local comment-end ")")
  (setq-local comment-start-skip "(\\s-*")
  (setq-local font-lock-defaults '(feedhold--font-lock nil t)))

(defvar feedhold-contract-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?\; "<" table)
    (modify-syntax-entry ?\n ">" table)
    (modify-syntax-entry ?\" "." table)
    (modify-syntax-entry ?# "_" table)
    table))

;;;###autoload
(define-derived-mode feedhold-contract-mode prog-mode "Macro B contract"
  "Major mode for contracts beside a program."
  (setq-local comment-start ";")
  (setq-local comment-end "")
  (setq-local font-lock-defaults
              '((("^\\s-*\\(@[A-Z-]+\\)" . font-lock-preprocessor-face) ("#[0-9]+" . font-lock-variable-name-face)) nil t)))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.\\(?:nc\\|cnc\\|tap\\|ngc\\|eia\\|ncd\\|prg\\)\\'" . feedhold-mode))
;;;###autoload
(add-to-list 'auto-mode-alist '("/[Oo][0-9]\\{4,8\\}\\'" . feedhold-mode))
;;;###autoload
(add-to-list 'auto-mode-alist '("\\.contract\\'" . feedhold-contract-mode))

(defun feedhold--contact (&rest _)
  "How Eglot starts the server."
  (unless (executable-find feedhold-program)
    (user-error "`%s' was not found; install Feedhold, or set `feedhold-program'" feedhold-program))
  (list feedhold-program "lsp" :initializationOptions (list :proofs feedhold-proofs)))

(defvar eglot-server-programs)
(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs '(((feedhold-mode :language-id "macrob") (feedhold-contract-mode :language-id "macrob-contract"))
                 . feedhold--contact)))

(provide 'feedhold-mode)
;;; feedhold-mode.el ends here
