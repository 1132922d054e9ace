"""The Debian package: what lintian says, and an installation into an empty root."""
import gzip
import os
import unittest

from packaged import Packaged, main


class Debian(Packaged):
    def setUp(self):
        super().setUp()
        self.package = self.artifact("feedhold_*_amd64.deb")

    def test_lintian_finds_no_errors(self):
        told = self.run_clean("lintian", "--fail-on", "error,warning", "--allow-root", self.package, code=None)
        self.assertEqual((told.returncode, told.stdout), (0, ""), told.stderr)

    @unittest.skipUnless(os.geteuid() == 0, "only root may install")
    def test_install_use_and_remove(self):
        root = self.folder / "root"
        state = root / "var/lib/dpkg"
        for name in ("info", "updates"):
            (state / name).mkdir(parents=True)
        (state / "status").touch()
        self.run_clean("dpkg", f"--root={root}", "-i", self.package)
        self.use(root / "usr/bin/feedhold")
        self.assertIn("the self-check passed", self.run_clean("chroot", root, "/usr/bin/feedhold", "self-check").stdout)
        page = gzip.decompress((root / "usr/share/man/man1/feedhold.1.gz").read_bytes()).decode()
        self.assertIn(".TH", page)
        for name in ("bash-completion/completions/feedhold", "zsh/vendor-completions/_feedhold",
                     "fish/vendor_completions.d/feedhold.fish"):
            self.assertIn("self-check", (root / "usr/share" / name).read_text())
        self.run_clean("dpkg", f"--root={root}", "--purge", "feedhold")
        self.assertEqual([path for path in (root / "usr").rglob("*") if path.is_file()], [])


if __name__ == "__main__":
    main()
