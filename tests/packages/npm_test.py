"""The packages for npm, from local archives: npx, exit codes, and what is said without the package of the platform."""
from packaged import BAD, VERSION, Packaged, main


class Npm(Packaged):
    def npm(self, *words, **more):
        return self.run_clean("npm", *words, "--offline", "--no-audit", "--no-fund", **more)

    def setUp(self):
        super().setUp()
        (self.folder / "package.json").write_text('{"name": "shop", "private": true}\n')
        self.starter = self.artifact(f"feedhold-{VERSION}.tgz")
        self.program = self.artifact("feedhold-linux-x64-*.tgz")

    def test_install_and_use(self):
        self.npm("install", self.program, self.starter)
        self.use(self.folder / "node_modules/.bin/feedhold")
        self.use("npx", "--offline", "feedhold")

    def test_without_the_program(self):
        self.npm("install", "--omit=optional", self.starter)
        (self.folder / "O1001.nc").write_text(BAD)
        told = self.run_clean("npx", "--offline", "feedhold", "check", "O1001.nc", code=2)
        self.assertIn("@feedhold/linux-x64 is not installed", told.stderr)


if __name__ == "__main__":
    main()
