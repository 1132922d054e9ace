"""What the tests of the language server share: a folder, and clients that end in order."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from client import Client  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]

SLIP = """%
O1001(SLIP)
#510-[0-1.5]
GOTO 99
M30
%
"""

# Its loop never ends for a step of 0, which its contract allows.
STEPS = """%
O9100(STEPS)
(@PARAM #21 DEPTH 0.5..50.)
(@PARAM #22 STEP 0..5.)
#1=0
WHILE[#1LT#21]DO1
#1=#1+#22
END1
M99
%
"""


class Session(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name).resolve()

    def client(self, folder=None, **options):
        client = Client(folder or self.folder, **options)
        self.addCleanup(client.end)
        return client

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def codes(self, diagnostics):
        return [diagnostic["code"] for diagnostic in diagnostics]


def at(line, begin, end=None):
    """A range within one line."""
    return {"start": {"line": line, "character": begin},
            "end": {"line": line, "character": begin if end is None else end}}
