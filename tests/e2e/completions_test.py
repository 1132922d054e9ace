"""Completions in real shells, and the manual page in the hands of groff."""
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from harness import FEEDHOLD, Scratch

BASH = """source ./feedhold.bash
complete -p feedhold >/dev/null || exit 9
COMP_WORDS=({words})
COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
_feedhold
printf '%s\\n' "${{COMPREPLY[@]}}"
"""


def needs(program):
    return unittest.skipUnless(shutil.which(program), f"{program} is not installed")


class Completions(Scratch):
    def script(self, shell, name):
        result = self.feedhold("completions", shell)
        self.assertExit(result, 0)
        return self.write(name, result.stdout)

    def run_in(self, *command):
        result = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=60,
                                env=self.environment())
        self.assertEqual((result.returncode, result.stderr), (0, ""), result.stdout)
        return result.stdout

    def bash(self, *words):
        quoted = " ".join(f"'{word}'" for word in ("feedhold", *words))
        return self.run_in("bash", "-uc", BASH.format(words=quoted)).split()

    def options(self, command):
        """As the help lists them."""
        return set(re.findall(r"^ +(?:-\w,)?(--[A-Za-z-]+)", self.feedhold(command, "--help").stdout, re.MULTILINE))

    def commands(self):
        text = self.feedhold("--help").stdout.split("Subcommands:")[1]
        return set(re.findall(r"^  ([a-z-]+) ", text, re.MULTILINE))

    def test_bash(self):
        self.script("bash", "feedhold.bash")
        self.assertLessEqual(self.commands(), set(self.bash("")))
        self.assertEqual(self.bash("che"), ["check"])
        self.assertEqual(set(self.bash("check", "--b")), {"--baseline"})
        for command in self.commands():
            with self.subTest(command=command):
                self.assertLessEqual(self.options(command), set(self.bash(command, "--")))
        self.assertEqual(set(self.bash("prove", "--format", "")), {"text", "json", "sarif"})
        self.assertEqual(self.bash("prove", "--format", "=", "js"), ["json"])
        self.assertEqual(set(self.bash("prove", "--format", "=")), {"text", "json", "sarif"})
        self.assertIn("fanuc-30i", self.bash("check", "part.nc", "--dialect", "fanuc"))
        self.assertEqual(self.bash("explain", "missing-eq"), ["missing-equals"])
        self.assertEqual(set(self.bash("completions", "")), {"bash", "zsh", "fish"})
        self.assertEqual(self.bash("check", "--config", ""), [])  # readline completes files then
        self.assertEqual(self.bash("check", "par"), [])

    @needs("zsh")
    def test_zsh(self):
        self.script("zsh", "_feedhold")
        self.run_in("zsh", "-n", "_feedhold")
        said = self.run_in("zsh", "-fc", "autoload -Uz compinit && compinit -u -d ./dump && source ./_feedhold && "
                                         "print -r -- $_comps[feedhold]")
        self.assertEqual(said.strip(), "_feedhold")

    @needs("fish")
    def test_fish(self):
        self.script("fish", "feedhold.fish")
        ask = "source feedhold.fish; complete -C '{}' | string replace -r '\\t.*' ''"
        self.assertEqual(self.run_in("fish", "-c", ask.format("feedhold che")).split(), ["check"])
        self.assertLessEqual(self.commands(), set(self.run_in("fish", "-c", ask.format("feedhold ")).split()))
        self.assertEqual(set(self.run_in("fish", "-c", ask.format("feedhold prove --format ")).split()),
                         {"text", "json", "sarif"})
        self.assertLessEqual(self.options("check"),
                             set(self.run_in("fish", "-c", ask.format("feedhold check --")).split()))

    def test_what_is_no_shell(self):
        self.assertExit(self.feedhold("completions", "abacus"), 2)
        self.assertExit(self.feedhold("completions"), 2)

    # ---- the manual page ----

    def page(self):
        result = self.feedhold("man")
        self.assertExit(result, 0)
        return self.write("feedhold.1", result.stdout)

    @needs("groff")
    def test_groff_has_nothing_to_say(self):
        self.page()
        text = self.run_in("groff", "-man", "-ww", "-Tascii", "-P-c", "-P-b", "-P-u", "feedhold.1")
        for command in self.commands():
            self.assertRegex(text, rf"feedhold\s+{command}")
            for option in self.options(command):
                self.assertIn(option, text)

    @needs("mandoc")
    def test_mandoc_has_nothing_to_say(self):
        self.page()
        said = subprocess.run(["mandoc", "-Tlint", "-Wwarning", "feedhold.1"], cwd=self.folder, capture_output=True,
                              text=True, timeout=60).stdout.splitlines()
        # A date would make two builds of the same source differ.
        self.assertEqual([line for line in said if "missing date" not in line], [])

    @needs("cmake")
    def test_installed(self):
        self.run_in("cmake", "--install", str(Path(FEEDHOLD).parent), "--prefix", str(self.folder / "usr"))
        for name, words in (("share/man/man1/feedhold.1", ["man"]),
                            ("share/bash-completion/completions/feedhold", ["completions", "bash"]),
                            ("share/zsh/site-functions/_feedhold", ["completions", "zsh"]),
                            ("share/fish/vendor_completions.d/feedhold.fish", ["completions", "fish"])):
            self.assertEqual((self.folder / "usr" / name).read_text(), self.feedhold(*words).stdout)
        version = subprocess.run([self.folder / "usr/bin/feedhold", "--version"], capture_output=True, text=True)
        self.assertEqual(version.returncode, 0)


if __name__ == "__main__":
    unittest.main()
