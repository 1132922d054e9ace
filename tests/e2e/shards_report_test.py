"""`certify` in shards: the merge writes the report of one run, or says why there is none."""
import unittest

from shards_test import BROKEN, MISTAKEN, Tree


class Report(Tree):
    maxDiff = None

    def test_report(self):
        """`certify` by shards, more of them than there are programs: the report is that of one run."""
        paths = ["cell 1", "notes.txt"]
        self.feedhold("certify", *paths, "-o", self.cache / "one" / "report")
        for index in range(1, 6):
            self.feedhold("certify", *paths, "--shard", f"{index}/5", "--part", self.part(index, 5))
        self.assertRefused(self.feedhold("certify", *paths, "--shard", "1/5"), "--part")
        self.merge("--output", self.cache / "two" / "report")
        one, two = (({path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()})
                    for folder in (self.cache / "one", self.cache / "two"))
        self.assertTrue(one)
        self.assertEqual(one, two)

    def test_report_of_what_cannot_be_read(self):
        """Every shard writes its part, and the merge complains as one run does; no report is written."""
        self.write("cell 2/O9012.contract", MISTAKEN)
        self.write("settings/feedhold.toml", BROKEN)
        for paths in (["cell 1", "cell 2"], ["cell 1", "settings"], ["cell 1", "missing.nc"]):
            with self.subTest(paths=paths):
                report = self.cache / "report"
                one = self.feedhold("certify", *paths, "-o", report)
                self.assertRefused(one, "no report was written")
                for old in self.parts.iterdir():
                    old.unlink()
                codes = [self.feedhold("certify", *paths, "--shard", f"{index}/3", "--part", self.part(index, 3)).returncode
                         for index in range(1, 4)]
                self.assertIn(2, codes)
                self.assertSame(self.merge("--output", report), one)
                self.assertFalse(report.exists())


if __name__ == "__main__":
    unittest.main()
