"""No program makes `prove` use much time or memory, and what is given up says so and is never proved."""
import json
import resource
import subprocess
import unittest

import nasty_programs
from harness import FEEDHOLD, Scratch

SIZE = 1_500  # bytes: of such programs all reach the limits that are known
SECONDS = 90  # of the processor: one and a half times what the slowest machine took
MEGABYTES = 1024


def limited():
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    resource.setrlimit(resource.RLIMIT_AS, (4 * MEGABYTES << 20, 4 * MEGABYTES << 20))


class NastyPrograms(Scratch):
    def prove(self, make, size):
        path = self.write(f"{make.__name__}.nc", make(size))
        return subprocess.run([FEEDHOLD, "prove", "--dialect", "fanuc-30i", "--isolated", "--no-cache", "--jobs", "1",
                               "--format", "json", path], capture_output=True, preexec_fn=limited,
                              env=self.environment())

    def test_each_ends_in_time(self):
        for make in nasty_programs.ALL:
            with self.subTest(make=make.__name__):
                result = self.prove(make, SIZE)
                self.assertIn(result.returncode, (0, 1, 2, 3), result.stderr)
                for file in json.loads(result.stdout)["files"]:
                    for row in file["obligations"]:
                        if row["verdict"] == "unknown":
                            self.assertTrue(row["reason"], row["id"])

    def test_what_is_given_up_says_so(self):
        result = self.prove(nasty_programs.squares, SIZE)
        [program] = json.loads(result.stdout)["files"][0]["programs"]
        self.assertIn("a value whose formula is too large, and which is taken as any number",
                      [row["reason"] for row in program["unmodelled"]])

    def test_same_with_any_number_of_threads(self):
        files = [self.write(f"{make.__name__}.nc", make(SIZE)) for make in
                 (nasty_programs.sums_of_all, nasty_programs.loops, nasty_programs.bits)]
        reports = [self.feedhold("prove", "--dialect", "fanuc-30i", "--isolated", "--no-cache", "--jobs", jobs,
                                 "--format", "json", *files).stdout for jobs in (1, 3)]
        self.assertEqual(*reports)


if __name__ == "__main__":
    unittest.main()
