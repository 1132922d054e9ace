"""What goes with the program wherever it goes."""
from libraries import notices
from release import ROOT


def texts(built):
    return {"LICENSE": (ROOT / "LICENSE").read_bytes(), "CHANGELOG.md": (ROOT / "CHANGELOG.md").read_bytes(),
            "THIRD-PARTY-NOTICES": notices(built).encode()}
