#!/usr/bin/env python3
"""lsp_seeds.py ROOT FOLDER: writes the recorded sessions of tests/lsp/, one message of each kind, and some that are malformed,
as seeds for the fuzzer of the language server: a byte of flags, then one message a line."""
import hashlib
import json
import sys
from pathlib import Path

FOLDER = "file:///feedhold-fuzz"  # the one that lsp_fuzz.cpp opens
DOCUMENT = {"uri": FOLDER + "/a.nc"}
UNFRAMED, CHECKED = 1, 16
TEXT = "%\nO1001(SLIP)\n(@PARAM #1 DEPTH 1..9)\n#510-[0-1.5]\nWHILE[#1LT3]DO1\n#1=#1+1\nEND1\nGOTO 99\nG65 P1001 A1.\nM30\n%\n"
BEHIND = ("hover", "definition", "references", "documentHighlight", "prepareRename", "rename", "completion",
          "signatureHelp", "prepareCallHierarchy", "semanticTokens/full", "foldingRange", "documentSymbol", "codeLens",
          "inlayHint", "codeAction", "formatting", "rangeFormatting", "diagnostic", "documentColor", "didSave", "didClose")
MALFORMED = ('{', '[]', '1', '{"id":{},"method":"shutdown"}', '{"id":7,"method":"textDocument/hover","params":3}',
             '{"method":"textDocument/didChange","params":{"textDocument":{"uri":"file:///feedhold-fuzz/a.nc"}}}',
             '{"method":"$/cancelRequest","params":{"id":1}}', '{"id":8,"result":null}')
HEADERS = ("Content-Length: 2\r\n\r\n{}", "Content-Length: -1\r\n\r\n", "content-length:9\r\nContent-Type: x\r\n\r\n{\"id\": 1}",
           "nonsense\r\n\r\nContent-Length: 99999999999999999999\r\n\r\n", "Content-Length: 4\r\n\r\n[")


def opening():
    return {"method": "textDocument/didOpen",
            "params": {"textDocument": {**DOCUMENT, "languageId": "nc", "version": 1, "text": TEXT}}}


def asking(method, line, character):
    """With whatever any method wants."""
    place = {"line": line, "character": character}
    return {"id": 1, "method": "textDocument/" + method, "params": {
        "textDocument": DOCUMENT, "position": place, "range": {"start": {"line": 0, "character": 0}, "end": place},
        "newName": "N20", "options": {"tabSize": 2, "insertSpaces": True},
        "context": {"diagnostics": [], "includeDeclaration": True}}}


def changing():
    ends = {"start": {"line": 3, "character": 4}, "end": {"line": 3, "character": 5}}
    return {"method": "textDocument/didChange",
            "params": {"textDocument": {**DOCUMENT, "version": 2}, "contentChanges": [{"range": ends, "text": "="}]}}


def lines(messages):
    return "\n".join(message if isinstance(message, str) else json.dumps(message) for message in messages)


def seeds(root):
    for path in sorted((root / "tests/lsp/sessions").glob("*.json")):
        if not path.name.endswith(".expected.json"):
            between = [m for m in json.loads(path.read_text()) if m["method"] not in ("initialize", "shutdown", "exit")]
            yield CHECKED, lines(between).replace("file:///folder", FOLDER)
    for method in BEHIND:
        yield 0, lines([opening(), asking(method, 5, 1), changing(), asking(method, 7, 6)])
    yield 0, lines([opening(), {"id": 1, "method": "workspace/symbol", "params": {"query": "O"}}])
    for message in MALFORMED:
        yield CHECKED, lines([opening(), message])
    for headers in HEADERS:
        yield UNFRAMED, headers


def main():
    root, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    for flags, text in seeds(root):
        seed = bytes([flags]) + text.encode()
        (folder / hashlib.sha1(seed).hexdigest()).write_bytes(seed)
    print(f"{len(list(folder.iterdir()))} seeds")


if __name__ == "__main__":
    main()
