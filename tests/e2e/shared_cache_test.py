"""`--cache-url`: what one machine has proved, another need not; what is not signed, or does not come, is proved anew.

With FEEDHOLD_ORACLES=1 the same on nginx, as docs/many-machines.md sets it up.
"""
import base64
import hashlib
import hmac
import os
import shutil
import socket
import subprocess
import sys
import threading
import time
import unittest
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from harness import FEEDHOLD, ORACLES, SKIPPED, Scratch

CURL = shutil.which("curl")
NGINX = shutil.which("nginx", path=f"{os.environ['PATH']}:/usr/sbin")
KEY = "a secret of the shop"
CLAIM = b"this alarm is never raised"
FORGED = b"this alarm is NEVER raised"
PROGRAM = "O{number}\n(@PARAM #21 DEPTH 0..5.)\nIF[#21GT5]GOTO90\nM99\nN90#3000=1(DEEP {number})\n"
NGINX_CONFIGURATION = """
daemon off; pid {folder}/nginx.pid; error_log {folder}/error.log; {user}
events {{ }}
http {{
  access_log off;
  client_body_temp_path {folder}/body; proxy_temp_path {folder}/1; fastcgi_temp_path {folder}/2;
  uwsgi_temp_path {folder}/3; scgi_temp_path {folder}/4;
  server {{
    listen 127.0.0.1:{port};
    root {folder}/files;
    location /feedhold/ {{
      dav_methods PUT;
      create_full_put_path on;
      client_max_body_size 16m;
    }}
  }}
}}
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def signed(name, entry, key=KEY):
    signature = hmac.new(key.encode(), name.encode() + b"\n" + entry, hashlib.sha256).hexdigest()
    return f"feedhold signature 1 {signature}\n".encode() + entry


def forged(body):
    """The entry in a body, with another record and the hash that it needs."""
    head, name, _, record = body.split(b"\n", 1)[1].split(b"\n", 3)
    record = record.replace(CLAIM, FORGED)
    return b"\n".join([head, name, hashlib.sha256(record).hexdigest().encode(), record])


class Server(ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, *_):
        pass  # a client that has gone


class Handler(BaseHTTPRequestHandler):
    """A folder in memory; `server.trouble(handler)` may answer instead, and says then that it did."""

    def do_GET(self):
        self.note(b"")
        if not self.server.trouble(self):
            body = self.server.files.get(self.path)
            self.answer(404 if body is None else 200, body or b"none\n")

    def do_PUT(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        self.note(body)
        if not self.server.trouble(self):
            self.server.files[self.path] = body
            self.answer(201, b"")

    def note(self, body):
        self.server.requests.append((self.command, self.path))
        self.server.heard += f"{self.requestline}\n{self.headers}".encode() + body

    def answer(self, status, body, headers=(), length=None):
        self.send_response(status)
        self.send_header("Content-Length", str(len(body) if length is None else length))
        for name, value in headers:
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


class Machines(Scratch):
    """Some machines, each with a cache of its own, and a server in this process."""

    def setUp(self):
        super().setUp()
        for number in (9101, 9102, 9103):
            self.write(f"nc/O{number}.nc", PROGRAM.format(number=number))
        self.expected = self.feedhold("prove", "--no-cache", "nc")
        self.assertExit(self.expected, 0)
        self.start()

    def start(self):
        self.server = Server(("127.0.0.1", 0), Handler)
        self.server.files, self.server.requests, self.server.heard = {}, [], b""
        self.server.trouble = lambda handler: False
        threading.Thread(target=self.server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(self.server.shutdown)
        self.url = f"http://127.0.0.1:{self.server.server_address[1]}/feedhold"

    def kept(self):
        """What the server has, by the names of the entries."""
        return {path.removeprefix("/feedhold/"): body for path, body in self.server.files.items()}

    def keep(self, name, body):
        self.server.files[f"/feedhold/{name}"] = body

    def remove(self, name):
        del self.server.files[f"/feedhold/{name}"]

    def prove(self, machine, *arguments, key=KEY, environment=None):
        """By a machine with a cache of its own."""
        words = [] if "--cache-url" in arguments else ["--cache-url", self.url]
        return self.feedhold("prove", "--cache-dir", self.cache / machine, *words, *(arguments or ["nc"]),
                             environment={"FEEDHOLD_CACHE_KEY": key, **(environment or {})})

    def fill(self, change=lambda name, body: signed(name, forged(body))):
        """Proves on a first machine, then changes what the server has: from now on a hit shows."""
        self.assertSame(self.prove("first"))
        kept = self.kept()
        self.assertEqual(len(kept), 3)
        for name, body in kept.items():
            self.keep(name, change(name, body))

    def forget(self):
        for machine in ("first", "second", "third"):
            shutil.rmtree(self.cache / machine, ignore_errors=True)
        for name in self.kept():
            self.remove(name)

    def assertSame(self, result, *told):
        """The verdicts of a run without any cache, and a line for each thing that is told."""
        self.assertEqual((result.stdout, result.returncode), (self.expected.stdout, self.expected.returncode))
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), len(told), result.stderr)
        for line, words in zip(lines, told):
            self.assertIn(words, line)

    def assertHits(self, result, hits):
        self.assertEqual(result.stdout.count(FORGED.decode()), hits)
        self.assertEqual(result.stdout.count(CLAIM.decode()), 3 - hits)
        self.assertExit(result, 0)


class SharedCache(Machines):
    # ---- hits ----

    def test_second_machine(self):
        self.fill()
        result = self.prove("second")
        self.assertHits(result, 3)
        self.assertEqual(result.stderr, "")
        self.assertHits(self.prove("third", "--jobs", "1", "nc"), 3)
        self.assertHits(self.prove("first"), 0)  # has verdicts of its own

    def test_same_bytes(self):
        self.prove("first")
        for words in ((), ("-v",), ("--format", "json"), ("--format", "sarif"), ("--statistics",)):
            machine = "second" + "".join(words)
            self.assertEqual(self.prove(machine, *words, "nc").stdout, self.feedhold("prove", *words, "nc").stdout)

    def test_what_came_is_kept(self):
        self.fill()
        self.prove("second")
        self.assertHits(self.prove("second", "--cache-url", "http://127.0.0.1:1/feedhold", "nc"), 3)

    def test_names_of_the_server(self):
        self.fill()
        self.assertHits(self.prove("second", "--cache-url", self.url + "//", "nc"), 3)
        self.assertHits(self.feedhold("prove", "nc", environment={"FEEDHOLD_CACHE_URL": self.url,
                                                                  "FEEDHOLD_CACHE_KEY": KEY}), 3)

    def test_shards(self):
        self.fill()
        for index in (1, 2):
            self.prove(f"machine {index}", "--shard", f"{index}/2", "--part", self.cache / f"{index}.part", "nc")
        result = self.feedhold("merge", self.cache / "1.part", self.cache / "2.part")
        self.assertHits(result, 3)

    def test_no_use_of_it(self):
        self.fill()
        environment = {"FEEDHOLD_CACHE_URL": self.url, "FEEDHOLD_CACHE_KEY": KEY}
        self.assertHits(self.feedhold("prove", "--no-cache", "nc", environment=environment), 0)
        self.assertHits(self.feedhold("prove", "--certificate", "proofs", "nc", environment=environment), 0)
        self.assertExit(self.feedhold("recheck", "proofs", environment=environment), 0)

    def test_machines_side_by_side(self):
        command = [FEEDHOLD, "prove", "--cache-url", self.url, "nc", "--cache-dir"]
        runs = [subprocess.Popen([*command, self.cache / str(number)],
                                 cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                 env=self.environment({"FEEDHOLD_CACHE_KEY": KEY})) for number in range(4)]
        self.assertEqual({run.communicate()[0] for run in runs}, {self.expected.stdout})
        self.assertEqual(len(self.kept()), 3)

    # ---- what is not believed ----

    def assertProvedAnew(self, change, count=3):
        self.fill(change)
        verb = "verdict of the shared cache is" if count == 1 else "verdicts of the shared cache are"
        self.assertSame(self.prove("second"), f"feedhold: {count} {verb} not signed with your key")
        for name, body in self.kept().items():  # and put right
            self.assertEqual(body, signed(name, body.split(b"\n", 1)[1]))
        self.assertSame(self.prove("third"))

    def test_altered_record(self):
        self.assertProvedAnew(lambda name, body: body.replace(CLAIM, FORGED))

    def test_altered_record_with_a_hash_that_fits(self):
        self.assertProvedAnew(lambda name, body: body.split(b"\n", 1)[0] + b"\n" + forged(body))

    def test_another_key(self):
        self.assertProvedAnew(lambda name, body: signed(name, forged(body), "another"))

    def test_no_signature(self):
        self.assertProvedAnew(lambda name, body: body.split(b"\n", 1)[1])

    def test_cut_entries(self):
        for size in (0, 10, 21, 85, 86, 200, -1):
            with self.subTest(size=size):
                self.forget()
                self.assertProvedAnew(lambda name, body, size=size: body[:size])

    def test_entry_under_another_name(self):
        """Signed, but for another program: the right verdict at the wrong place."""
        self.fill(lambda name, body: body)
        kept = self.kept()
        names = sorted(kept)
        self.keep(names[0], kept[names[1]])
        self.assertSame(self.prove("second"), "feedhold: 1 verdict of the shared cache is not signed with your key")

    def test_signed_nonsense(self):
        """Who has the key may still have a program of another build, or a disk that errs."""
        for entry in (b"", b"feedhold proof 6\n", b"nonsense", bytes(300)):
            with self.subTest(entry=entry):
                self.forget()
                self.fill(lambda name, body, entry=entry: signed(name, entry))
                self.assertSame(self.prove("second"))

    def test_key_of_the_other_machine(self):
        self.prove("first", key="theirs")
        self.assertSame(self.prove("second"), "3 verdicts of the shared cache are not signed")

    def test_key_is_not_told(self):
        self.write("bin/curl", f'#!/bin/sh\necho "$@" >> "{self.folder}/words"\nexec {CURL} "$@"\n').chmod(0o755)
        self.prove("first", environment={"PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"})
        self.assertEqual(len(self.kept()), 3)
        self.assertNotIn(KEY, (self.folder / "words").read_text())

    # ---- a server that does not do its part ----

    def test_gone(self):
        self.assertSame(self.prove("first", "--cache-url", f"http://127.0.0.1:{free_port()}/", "nc"),
                        "is not used any further: the server does not answer")

    def test_no_such_folder(self):
        self.assertSame(self.prove("first", "--cache-url", self.url.replace("/feedhold", "/feedhold/deeper"), "nc"))

    def test_addresses_that_are_none(self):
        for url in ("127.0.0.1/feedhold", "ftp://127.0.0.1/feedhold", "file:///tmp", "-o/tmp/x", "http//x"):
            with self.subTest(url=url):
                result = self.feedhold("prove", f"--cache-url={url}", "nc", environment={"FEEDHOLD_CACHE_KEY": KEY})
                self.assertExit(result, 2)
                self.assertIn("no address that begins with http", result.stderr)

    def test_no_key(self):
        for environment in ({}, {"FEEDHOLD_CACHE_KEY": ""}):
            for command in (("prove", "nc"), ("lsp",)):
                result = self.feedhold(*command, "--cache-url", self.url, environment=environment)
                self.assertExit(result, 2)
                self.assertIn("FEEDHOLD_CACHE_KEY", result.stderr)
        self.assertExit(self.feedhold("prove", "nc", environment={"FEEDHOLD_CACHE_URL": self.url}), 2)
        self.assertExit(self.feedhold("prove", "--no-cache", "nc", environment={"FEEDHOLD_CACHE_URL": self.url}), 0)
        self.assertExit(self.feedhold("check", "nc", environment={"FEEDHOLD_CACHE_URL": self.url}), 0)

    def test_no_curl(self):
        self.assertSame(self.prove("first", environment={"PATH": str(self.folder)}), "needs the program `curl`")
        self.assertSame(self.prove("first", environment={"PATH": str(self.folder)}))  # kept on the machine


class Troubled(Machines):
    """What nginx does not do on demand."""

    def trouble(self, answer, method=None):
        def act(handler):
            if method not in (None, handler.command):
                return False
            answer(handler)
            return True

        self.server.trouble = act

    def quickCurl(self):
        """With a time-out of a second."""
        self.write("bin/curl", f'#!/bin/sh\nexec {CURL} --no-progress-meter "$@" --max-time 1\n').chmod(0o755)
        return {"PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"}

    def test_status(self):
        for status in (400, 401, 403, 500, 503):
            with self.subTest(status=status):
                self.trouble(lambda handler: handler.answer(status, b"sorry\n"))
                self.assertSame(self.prove(f"machine {status}"), f"the server answers GET with status {status}")

    def test_reads_only(self):
        self.fill()
        self.trouble(lambda handler: handler.answer(405, b"sorry\n"), "PUT")
        self.assertHits(self.prove("second"), 3)
        self.keep(next(iter(self.kept())), b"")
        self.assertSame(self.feedhold("prove", "--no-cache", "nc"))
        result = self.prove("third")
        self.assertHits(result, 2)
        self.assertIn("the server answers PUT with status 405", result.stderr)

    def test_asked_no_more(self):
        self.trouble(lambda handler: handler.answer(500, b"sorry\n"))
        self.prove("first", "--jobs", "1", "nc")
        self.assertEqual(len(self.server.requests), 1)

    def test_asked_once_for_each(self):
        self.fill()
        self.server.requests.clear()
        self.prove("second")
        self.prove("second")
        self.assertEqual(sorted(self.server.requests), sorted(("GET", path) for path in self.server.files))

    def test_key_is_not_sent(self):
        self.prove("first")
        self.prove("second", key="another")
        self.assertIn(b"PUT /feedhold/", self.server.heard)
        self.assertNotIn(KEY.encode(), self.server.heard)

    def test_body_that_stops(self):
        self.fill()
        self.trouble(lambda handler: handler.answer(200, self.server.files[handler.path][:300], length=5000), "GET")
        self.assertSame(self.prove("second"), "the server does not answer, or not to the end")

    def test_connection_that_is_closed(self):
        self.trouble(lambda handler: handler.wfile.close())
        self.assertSame(self.prove("first"), "the server does not answer")

    def test_silence(self):
        self.trouble(lambda handler: time.sleep(20))
        start = time.monotonic()
        self.assertSame(self.prove("first", environment=self.quickCurl()), "the server does not answer")
        self.assertLess(time.monotonic() - start, 15)

    def test_slow_drops(self):
        def drip(handler):
            handler.answer(200, b"", length=1000)
            try:
                for _ in range(50):
                    handler.wfile.write(b"x")
                    time.sleep(0.2)
            except OSError:
                pass  # the other side has gone

        self.trouble(drip, "GET")
        start = time.monotonic()
        self.assertSame(self.prove("first", environment=self.quickCurl()), "shared cache")
        self.assertLess(time.monotonic() - start, 15)

    def test_much_more_than_an_entry(self):
        self.trouble(lambda handler: handler.answer(200, bytes(50_000_000)), "GET")
        self.assertSame(self.prove("first"), "3 verdicts of the shared cache are not signed")

    def test_elsewhere(self):
        self.fill()
        def send_on(handler):
            if not handler.path.startswith("/old"):
                return False
            handler.answer(302, b"", [("Location", handler.path[4:])])
            return True

        self.server.trouble = send_on
        self.assertHits(self.prove("second", "--cache-url", self.url.replace("/feedhold", "/old/feedhold"), "nc"), 3)

    def test_password(self):
        def ask(handler):
            expected = "Basic " + base64.b64encode(b"shop:pass word").decode()
            if handler.headers["Authorization"] == expected:
                return False
            handler.answer(401, b"", [("WWW-Authenticate", "Basic")])
            return True

        self.server.trouble = ask
        self.assertSame(self.prove("first", environment={"HOME": str(self.cache)}), "GET with status 401")
        netrc = self.cache / ".netrc"
        netrc.write_text('machine 127.0.0.1 login shop password "pass word"\n')
        netrc.chmod(0o600)
        self.assertSame(self.prove("second", environment={"HOME": str(self.cache)}))
        self.assertEqual(len(self.kept()), 3)


class Nginx(SharedCache):
    def start(self):
        holder = self.cache / "nginx"
        (holder / "files/feedhold").mkdir(parents=True)
        self.files = holder / "files/feedhold"
        port = free_port()
        user = "user root;" if os.geteuid() == 0 else ""
        (holder / "nginx.conf").write_text(NGINX_CONFIGURATION.format(folder=holder, port=port, user=user))
        server = subprocess.Popen([NGINX, "-p", holder, "-e", holder / "error.log", "-c", holder / "nginx.conf"],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        self.url = f"http://127.0.0.1:{port}/feedhold"
        for _ in range(100):
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", port)) == 0:
                    return
            time.sleep(0.05)
        self.fail((holder / "error.log").read_text())

    def kept(self):
        files = [path for path in self.files.rglob("*") if path.is_file()]
        return {path.relative_to(self.files).as_posix(): path.read_bytes() for path in files}

    def keep(self, name, body):
        (self.files / name).write_bytes(body)

    def remove(self, name):
        (self.files / name).unlink()

    def test_no_such_folder(self):
        self.assertSame(self.prove("first", "--cache-url", self.url.replace("/feedhold", "/other"), "nc"),
                        "the server answers PUT with status 405")


def load_tests(loader, _, pattern):
    classes = [SharedCache, Troubled] + ([Nginx] if ORACLES and NGINX else [])
    return unittest.TestSuite(loader.loadTestsFromTestCase(each) for each in classes)


if __name__ == "__main__":
    if not CURL:
        print("skipped: needs curl")
        sys.exit(SKIPPED)
    if not (ORACLES and NGINX):
        print("without nginx: run `./dev test --oracles`")
    unittest.main()
