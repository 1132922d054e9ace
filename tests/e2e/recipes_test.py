"""The recipes of docs/many-machines.md, as the page has them: each is run, and its merge says what one run says.

Slurm and GNU parallel with FEEDHOLD_ORACLES=1 (cluster_test.py starts the cluster).
"""
import re
import subprocess
import unittest

from cluster_test import PARALLEL, SLURM, Cluster, Engine
from harness import FEEDHOLD, ORACLES, ROOT

PAGE = (ROOT / "docs/many-machines.md").read_text()
INSTALL = re.compile(r"pip install feedhold==\S+( && )?")
KILLED = 137
# In front of the real program: kills the first shard 2 once.
KILLING = """#!/bin/sh
case "$*" in *"--shard 2/"*) if mkdir "{trap}" 2> /dev/null; then kill -9 $$; fi ;; esac
exec "{feedhold}" "$@"
"""


def blocks(language, word):
    """The fences in a language that have a word, in order."""
    found = [text for text in re.findall(rf"(?ms)^```{language}\n(.*?)^```$", PAGE) if word in text]
    assert found, f"{word} in {language}"
    return found


class Recipes(Engine):
    def setUp(self):
        super().setUp()
        (self.folder / "nc").mkdir()
        for path in list(self.folder.iterdir()):
            if path.name != "nc":
                path.rename(self.folder / "nc" / path.name)
        self.trap = self.cache / "killed"
        programs = self.cache / "bin"
        programs.mkdir()
        (programs / "feedhold").symlink_to(FEEDHOLD)
        self.programs = programs

    def environment(self, changes=None):
        given = super().environment(changes)
        return {**given, "PATH": f"{self.cache / 'bin'}:{given['PATH']}"}

    def kill_a_shard(self):
        (self.programs / "feedhold").unlink()
        (self.programs / "feedhold").write_text(KILLING.format(trap=self.trap, feedhold=FEEDHOLD))
        (self.programs / "feedhold").chmod(0o755)

    def shell(self, script, **environment):
        """As a job of a build server runs it."""
        script = INSTALL.sub("", script)
        return subprocess.run(["bash", "-e", "-c", script], cwd=self.folder, env=self.environment(environment),
                              capture_output=True, text=True, timeout=300)

    def expected(self, *options):
        return self.feedhold("prove", "-q", "nc", *options)

    # ---- a matrix of jobs ----

    def github(self, shard):
        """The scripts of the steps of both jobs."""
        text = blocks("yaml", "runs-on")[0].replace("${{ matrix.shard }}", str(shard))
        return [job_steps(part) for part in text.split("\n  merge:\n")]

    def test_github(self):
        for shard in range(1, 5):
            install, prove = self.github(shard)[0]
            if shard > 1:
                install = install.replace("mkdir parts", "mkdir -p parts")  # one machine for all jobs
            for script in (install, prove):
                result = self.shell(script)
                self.assertEqual(result.returncode, 0, f"{script}\n{result.stderr}")
        expected = self.expected("--format", "sarif")
        merged = self.shell(self.github(1)[1][-1])
        self.assertEqual((merged.stdout, merged.returncode), (expected.stdout, expected.returncode))
        self.kill_a_shard()
        self.assertEqual(self.shell(self.github(2)[0][1]).returncode, KILLED)

    def gitlab(self):
        text = blocks("yaml", "CI_NODE_INDEX")[0]
        return [[line.strip()[2:] for line in re.search(r"script:\n((?:    - .*\n)+)", part)[1].splitlines()]
                for part in text.split("\nmerge:\n")]

    def test_gitlab(self):
        shard, merge = self.gitlab()
        job = "\n".join(shard).replace("mkdir parts", "mkdir -p parts")
        for index in range(1, 5):
            result = self.shell(job, CI_NODE_INDEX=str(index), CI_NODE_TOTAL="4")
            self.assertEqual(result.returncode, 0, result.stderr)
        expected = self.expected()
        merged = self.shell("\n".join(merge))
        self.assertEqual((merged.stdout, merged.returncode), (expected.stdout, expected.returncode))
        self.kill_a_shard()
        self.assertEqual(self.shell(job, CI_NODE_INDEX="2", CI_NODE_TOTAL="4").returncode, KILLED)

    def test_what_cannot_be_read_fails(self):
        self.write("nc/feedhold.toml", "dialekt = 5\n")
        self.assertEqual(self.shell("mkdir parts\n" + self.github(1)[0][1]).returncode, 2)
        job = "\n".join(self.gitlab()[0]).replace("mkdir parts", "mkdir -p parts")
        self.assertEqual(self.shell(job, CI_NODE_INDEX="1", CI_NODE_TOTAL="4").returncode, 2)

    # ---- GNU parallel ----

    @unittest.skipUnless(ORACLES and PARALLEL, "needs GNU parallel and ./dev test --oracles")
    def test_parallel(self):
        """On this machine in place of three; a job that is killed is tried again."""
        script = blocks("sh", "parallel -S")[0].replace("-S pc1,pc2,pc3", "--will-cite -j2")
        self.kill_a_shard()
        (self.folder / "parts").mkdir()
        merged = self.shell(script)
        self.assertTrue(self.trap.exists())
        expected = self.expected()
        self.assertTrue(merged.stdout.endswith(f"\n{expected.stdout}"), "behind what the shards say")
        self.assertEqual(merged.returncode, expected.returncode)


def job_steps(job):
    """The scripts of the `run:` of its steps; such a page has them in one line, or indented behind `|`."""
    found = re.findall(r"- run: (?:\|\n((?: {10}.*\n)+)|(.*))", job)
    return [re.sub(r"(?m)^ {10}", "", block) or line for block, line in found]


@unittest.skipUnless(ORACLES and SLURM, "needs slurm-wlm, munge and ./dev test --oracles")
class SlurmRecipe(Cluster, Recipes):
    def test_slurm(self):
        script, = blocks("sh", "#SBATCH")
        submit, = blocks("sh", "sbatch --parsable")
        (self.folder / "shard.sh").write_text(script.replace("1-40", "1-4").replace("N=40", "N=4"))
        (self.folder / "parts").mkdir()
        result = self.shell(submit)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.wait_for(lambda: not self.run_("squeue", "-h"), "the jobs do not end")
        self.assertEqual((self.folder / "findings.txt").read_text(), self.expected().stdout)

    test_github = test_gitlab = test_what_cannot_be_read_fails = test_parallel = None


if __name__ == "__main__":
    unittest.main()
