"""The commands of docs/install.md, each block in a folder of its own with the packages.  Left out: what asks for root, and
`podman`, which needs an engine (container_test.py builds the same image)."""
import re

from packaged import DIST, ROOT, Packaged, main

LEFT_OUT = ("sudo ", "podman ")


class InstallPage(Packaged):
    def test_blocks(self):
        page = (ROOT / "docs/install.md").read_text()
        blocks = re.findall(r"^## ([^\n]+)\n\n```sh\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
        self.assertEqual(len(blocks), 5)
        for title, block in blocks:
            with self.subTest(block=title):
                self.try_block(title, block.replace("/path/to/clone", str(ROOT)))

    def try_block(self, title, block):
        place = self.folder / re.sub(r"\W+", "-", title)
        place.mkdir()
        for package in DIST.iterdir():
            (place / package.name).symlink_to(package)
        lines = block.splitlines()
        if any(line.startswith("sudo ") for line in lines):
            return
        kept = "\n".join(line for line in lines if not line.startswith(LEFT_OUT))
        told = self.run_clean("bash", "-euc", kept, cwd=place).stdout
        if "self-check" in kept:
            self.assertIn("the self-check passed", told)


if __name__ == "__main__":
    main()
