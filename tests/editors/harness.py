"""What the tests of the editors share."""
import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FEEDHOLD = os.environ["FEEDHOLD"]
ORACLES = os.environ.get("FEEDHOLD_ORACLES") == "1"
SKIPPED = 77  # ctest's word for a test that could not run here
EXTENSION = ROOT / "editors" / "vscode"
NODE = EXTENSION / "node_modules" / ".bin" / "node"
