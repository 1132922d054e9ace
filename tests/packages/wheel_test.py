"""The wheel, by pip from a folder, in an environment of its own."""
from packaged import DIST, Packaged, main


class Wheel(Packaged):
    def test_install_use_and_remove(self):
        self.run_clean("python3", "-m", "venv", self.folder / "venv")
        programs = self.folder / "venv/bin"
        self.run_clean(programs / "pip", "install", "--no-index", "--find-links", DIST, "feedhold")
        self.use(programs / "feedhold")
        shown = self.run_clean(programs / "pip", "show", "--files", "feedhold").stdout
        self.assertIn("License: Apache-2.0", shown)
        self.run_clean(programs / "pip", "check")
        self.run_clean(programs / "pip", "uninstall", "-y", "feedhold")
        self.assertFalse((programs / "feedhold").exists())


if __name__ == "__main__":
    main()
