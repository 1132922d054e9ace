;;; What a person does in Emacs, with its own commands; what they see goes to session.json.  -*- lexical-binding: t -*-
(require 'cl-lib)
(require 'eglot)
(require 'feedhold-mode)
(require 'json)
(require 'xref)

(setq eglot-sync-connect 20
      eglot-confirm-server-initiated-edits nil
      eglot-send-changes-idle-time 0.05
      flymake-no-changes-timeout 0.05
      make-backup-files nil
      feedhold-program (getenv "FEEDHOLD"))

(defvar seen nil)

(defun saw (what value) (push (cons what value) seen))

(defun wait-for (what condition)
  (let ((end (+ (float-time) 20)))
    (while (not (funcall condition))
      (when (> (float-time) end) (error "waited in vain for %s" what))
      (accept-process-output nil 0.02))))

(defun lines () (vconcat (split-string (string-trim-right (buffer-string) "\n") "\n")))

(defun finding (it)
  "What Flymake shows of IT: `feedhold [code]: message'."
  (let ((text (flymake-diagnostic-text it)))
    (string-match "\\[\\([a-z-]+\\)\\]: *\\(\\(?:.\\|\n\\)*\\)" text)
    `((line . ,(line-number-at-pos (flymake-diagnostic-beg it)))
      (marked . ,(buffer-substring-no-properties (flymake-diagnostic-beg it) (flymake-diagnostic-end it)))
      (code . ,(match-string 1 text))
      (severity . ,(cdr (assq (flymake-diagnostic-type it) '((eglot-error . 1) (eglot-warning . 2) (eglot-note . 3)))))
      (message . ,(match-string 2 text)))))

(defun findings () (vconcat (mapcar #'finding (flymake-diagnostics))))

(defun has (code) (cl-some (lambda (it) (equal (alist-get 'code it) code)) (findings)))

(defun go-to (text)
  "Puts point on the first place of TEXT."
  (goto-char (point-min))
  (search-forward text)
  (goto-char (match-beginning 0)))

(defun type (text)
  "Changes TEXT for the character at point, as keys would."
  (delete-char 1)
  (insert text)
  (eglot--signal-textDocument/didChange))

(defun session ()
  (find-file "O1000.nc")
  (unless (eq major-mode 'feedhold-mode) (error "the mode is %s" major-mode))
  (apply #'eglot--connect (eglot--guess-contact))
  (wait-for "findings of the flow" (lambda () (has "loop-without-progress")))
  (saw 'diagnostics (findings))

  (go-to "#100+1")
  (let (text)
    (eglot-hover-eldoc-function (lambda (told &rest _) (setq text (substring-no-properties told))))
    (wait-for "the text of the hover" (lambda () text))
    (saw 'hover text))

  (go-to "g01")
  (cl-letf ((last-nonmenu-event ?\r) ; or it would ask in a menu
            ((symbol-function 'completing-read)
             (lambda (_ titles &rest _) (cl-find-if (lambda (title) (string-match-p "upper case" title))
                                                    (mapcar (lambda (it) (if (consp it) (car it) it)) titles)))))
    (eglot-code-actions (point) (1+ (point)) "quickfix" t))
  (eglot--signal-textDocument/didChange)
  (wait-for "the repair" (lambda () (not (has "lower-case"))))
  (saw 'repaired (lines))

  (go-to "N30")
  (eglot-rename "N50")
  (eglot--signal-textDocument/didChange)
  (saw 'renamed (lines))

  (go-to "99")
  (type "5")
  (forward-char 0)
  (type "0")
  (wait-for "findings behind a change" (lambda () (not (has "goto-missing-label"))))
  (saw 'typed (lines))
  (saw 'left (findings))

  (go-to "9010")
  (save-buffer)
  (let ((server (eglot-current-server)))
    (xref-find-definitions "LSP identifier at point.")
    (saw 'definition (vector (file-name-nondirectory buffer-file-name) (line-number-at-pos)))

    (find-file "O9020.nc")
    (flymake-start) ; which a screen brings about
    (wait-for "what is refuted"
              (lambda () (cl-some (lambda (it) (eq (flymake-diagnostic-type it) 'eglot-error)) (flymake-diagnostics))))
    (saw 'refuted (findings))
    (go-to "3\nN10")
    (type "2")
    (save-buffer)
    (wait-for "the proof" (lambda () (null (flymake-diagnostics))))
    (saw 'proved (findings))

    (eglot-shutdown server)))

(condition-case problem (session)
  (error (saw 'problem (error-message-string problem))))
(let ((coding-system-for-write 'utf-8))
  (write-region (json-encode seen) nil "session.json"))
