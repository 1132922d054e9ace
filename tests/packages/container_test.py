"""The Containerfile, built and run by buildah without an engine."""
import os
import shutil
import sys

from packaged import BAD, ROOT, SKIPPED, Packaged, main


class Container(Packaged):
    def buildah(self, *words, code=0):
        store = self.folder / "store"
        return self.run_clean("buildah", "--root", store / "root", "--runroot", store / "run", "--storage-driver", "vfs",
                              *words, code=code)

    def test_build_and_use(self):
        self.run_clean("tar", "-xzf", self.artifact("*.tar.gz"))
        tree = next(self.folder.glob("feedhold-*"))
        self.buildah("bud", "--isolation", "chroot", "-t", "feedhold", "-f", ROOT / "packaging/Containerfile", tree)
        shop = self.folder / "shop"
        shop.mkdir()
        (shop / "O1001.nc").write_text(BAD)
        name = self.buildah("from", "--pull-never", "feedhold").stdout.strip()
        self.addCleanup(self.buildah, "rm", name)

        def run(*words, code=0):
            return self.buildah("run", "--isolation", "chroot", "-v", f"{shop}:/work", name, "--", "/feedhold", *words,
                                code=code).stdout
        self.assertIn("the self-check passed", run("self-check"))
        self.assertIn("missing-equals", run("check", ".", code=1))


if __name__ == "__main__":
    if os.geteuid() != 0 or not shutil.which("buildah"):
        print("containers are built by buildah, as root")
        sys.exit(SKIPPED)
    main()
