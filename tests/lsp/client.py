"""A small client of the language server: messages as they are, and what came back."""
import json
import os
import queue
import subprocess
import threading
import time
from pathlib import Path

FEEDHOLD = os.environ["FEEDHOLD"]
LONGEST_WAIT = 60


def frame(message):
    body = json.dumps(message).encode() if not isinstance(message, bytes) else message
    return b"Content-Length: %d\r\n\r\n%s" % (len(body), body)


class Client:
    """Starts a server; `initialize` is sent unless `fresh`."""

    def __init__(self, folder, capabilities=None, options=None, fresh=False, arguments=("--no-cache",),
                 program=(FEEDHOLD,), environment=None):
        self.folder = Path(folder)
        self.process = subprocess.Popen([*program, "lsp", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, cwd=folder, env=environment)
        self.received = queue.Queue()
        self.kept = []  # everything that came, in order
        self.asked = {}  # methods of requests, by id
        self.last_id = 0
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()
        if not fresh:
            self.server = self.request("initialize", {
                "processId": None, "rootUri": self.uri(""), "capabilities": capabilities or {},
                "initializationOptions": options or {}, "workspaceFolders": [{"uri": self.uri(""), "name": "w"}]})
            self.notify("initialized", {})

    def _read(self):
        stream = self.process.stdout
        while line := stream.readline():
            length = int(line.split(b":")[1])
            assert stream.readline() == b"\r\n", "headers end with an empty line"
            self.received.put(json.loads(stream.read(length).decode("utf-8")))
        self.received.put(None)

    def drain(self):
        """What is still on its way when the server has ended."""
        self.process.wait(LONGEST_WAIT)
        self.reader.join(LONGEST_WAIT)
        while (late := self.received.get(timeout=LONGEST_WAIT)) is not None:
            self.kept.append(late)

    def uri(self, name):
        return (self.folder / name).as_uri()

    def raw(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        if isinstance(message, dict) and "method" in message and isinstance(message.get("id"), (int, str)):
            self.asked[message["id"]] = message["method"]
        self.raw(frame(message))

    def notify(self, method, params):
        self.send({"jsonrpc": "2.0", "method": method, "params": params})

    def ask(self, method, params):
        """Sends a request and returns its id."""
        self.last_id += 1
        self.send({"jsonrpc": "2.0", "id": self.last_id, "method": method, "params": params})
        return self.last_id

    def wait(self, wanted, seconds=LONGEST_WAIT):
        """The next message that `wanted` accepts; what is passed on the way is in `kept`."""
        until = time.monotonic() + seconds
        while True:
            message = self.received.get(timeout=max(0.001, until - time.monotonic()))
            if message is None:
                raise EOFError("the server is gone: " + self.process.stderr.read().decode())
            self.kept.append(message)
            if "method" in message and "id" in message:  # a request of the server
                self.send({"jsonrpc": "2.0", "id": message["id"], "result": None})
            if wanted(message):
                return message

    def answer(self, request, seconds=LONGEST_WAIT):
        return self.wait(lambda m: m.get("id") == request and "method" not in m, seconds)

    def request(self, method, params, seconds=LONGEST_WAIT):
        """The result; an error is returned as the whole message."""
        message = self.answer(self.ask(method, params), seconds)
        return message["result"] if "result" in message else message

    def error(self, method, params):
        message = self.answer(self.ask(method, params))
        return message["error"]["code"]

    def open(self, name, text, language="nc", version=1):
        uri = name if ":" in name else self.uri(name)
        self.notify("textDocument/didOpen",
                    {"textDocument": {"uri": uri, "languageId": language, "version": version, "text": text}})
        return uri

    def change(self, uri, version, *changes):
        self.notify("textDocument/didChange",
                    {"textDocument": {"uri": uri, "version": version}, "contentChanges": list(changes)})

    def settle(self, pause=1.5):
        """Takes whatever comes until nothing has come for a while."""
        try:
            while True:
                self.wait(lambda message: True, pause)
        except queue.Empty:
            pass

    def diagnostics(self, uri, version=None, count=1):
        """Of the `count`-th publication for this version."""
        def is_wanted(message):
            params = message.get("params") or {}
            return (message.get("method") == "textDocument/publishDiagnostics" and params["uri"] == uri and
                    (version is None or params.get("version") == version))
        for _ in range(count):
            message = self.wait(is_wanted)
        return message["params"]["diagnostics"]

    def all_findings(self, uri, version=None):
        """With those of the flow analysis: these come second."""
        return self.diagnostics(uri, version, count=2)

    def end(self):
        """At once, whatever it does."""
        self.process.kill()
        self.process.wait()
        self.reader.join()
        for stream in (self.process.stdin, self.process.stdout, self.process.stderr):
            try:
                stream.close()
            except BrokenPipeError:
                pass  # what was not sent yet

    def close(self):
        """The exit code after an orderly end."""
        self.request("shutdown", None)
        self.notify("exit", None)
        code = self.process.wait(LONGEST_WAIT)
        self.process.stdin.close()
        return code
