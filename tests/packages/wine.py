"""What the tests of the program for Windows share: Wine with a drive C: of its own, and runs beside the program for Linux.
The folder of a test is on drive Z:, as all of this system is."""
import atexit
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import packaged
from packaged import DIST, SKIPPED, VERSION, Packaged

WINE = shutil.which("wine64") or "/usr/lib/wine/wine64"  # Debian has it outside of the PATH
DRIVE = "Z:"
LONGEST_RUN = 300


def on_windows(path):
    """As outputs show it: with `/`."""
    return DRIVE + str(path)


@dataclass(frozen=True)
class Place:
    """Made once for all tests of a file: making a drive C: takes long."""
    prefix: Path   # of Wine
    program: Path  # for Windows, out of its archive
    linux: Path    # the other one

    @property
    def environment(self):
        """No solver is on the PATH of either program."""
        return {"PATH": "/nowhere", "HOME": str(self.prefix), "WINEPREFIX": str(self.prefix), "WINEDEBUG": "-all",
                "WINEDLLOVERRIDES": "mscoree=;mshtml=", "LC_ALL": "C.UTF-8"}


@cache
def made_place():
    holder = tempfile.TemporaryDirectory()
    atexit.register(holder.cleanup)
    top = Path(holder.name)
    with zipfile.ZipFile(DIST / f"feedhold-{VERSION}-windows-x86_64.zip") as archive:
        archive.extractall(top)
    place = Place(top / "wine", next(top.glob("*/feedhold.exe")), packaged.linux_program())
    atexit.register(at_server, place, "-k")
    # Makes drive C:.  Then a server and services for all runs: those that a run starts keep its pipes open, and the run
    # seems not to end.
    nothing = (WINE, "cmd.exe", "/c", "exit")
    quietly(place, *nothing).check_returncode()
    at_server(place, "-w")
    at_server(place, "-p")
    quietly(place, *nothing).check_returncode()
    return place


def at_server(place, option):
    quietly(place, Path(WINE).with_name("wineserver"), option)


def quietly(place, *command):
    return subprocess.run(command, env=place.environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, timeout=LONGEST_RUN)


class Windows(Packaged):
    @classmethod
    def setUpClass(cls):
        place = made_place()
        cls.prefix, cls.program, cls.linux = place.prefix, place.program, place.linux

    def environment(self):
        return made_place().environment

    def setUp(self):
        super().setUp()
        self.folder = self.folder.resolve()

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def start(self, *words, **options):
        return subprocess.Popen([WINE, self.program, *map(str, words)], cwd=self.folder, env=self.environment(),
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)

    def run_in(self, command, words, code):
        result = subprocess.run([*command, *map(str, words)], cwd=self.folder, env=self.environment(),
                                capture_output=True, timeout=LONGEST_RUN, stdin=subprocess.DEVNULL)
        if code is not None:
            self.assertEqual(result.returncode, code, f"{words}\n{result.stdout.decode()}\n{result.stderr.decode()}")
        return result

    def feedhold(self, *words, code=0):
        """The program for Windows."""
        return self.run_in([WINE, self.program], words, code)

    def on_linux(self, *words, code=0):
        return self.run_in([self.linux], words, code)

    def mapped(self, data):
        """An output of the program for Windows as the one for Linux would say it."""
        here = os.fsencode(self.folder)
        return data.replace(b"file:///" + DRIVE.encode() + here, b"file://" + here).replace(DRIVE.encode() + here, here)

    def assertSame(self, *words, code=0):
        """Both programs say the same, byte for byte; what it was."""
        ours, theirs = self.on_linux(*words, code=code), self.feedhold(*words, code=None)
        self.assertEqual(self.mapped(theirs.stdout).decode(), ours.stdout.decode(), words)
        self.assertEqual(self.mapped(theirs.stderr).decode(), ours.stderr.decode(), words)
        self.assertEqual(theirs.returncode, ours.returncode, words)
        return ours.stdout.decode()


def main():
    if not Path(WINE).exists() and os.environ.get("FEEDHOLD_PACKAGES") == "1":
        print("the program for Windows runs under wine64, which is not installed")
        sys.exit(SKIPPED)
    packaged.main()


