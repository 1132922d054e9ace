"""The archive, unpacked into an empty folder: the program needs nothing beside it, and proves what the other build proves."""
import json
import os
import struct
import subprocess
import unittest

from packaged import FEEDHOLD, ROOT, SYSTEM_PATH, Packaged, main

PT_INTERP = 3
PROGRAMS = ["mould-entry/O9115.nc"]  # of corpus/packages


def verdicts(program, path, folder):
    """By file and claim."""
    programs = [ROOT / "corpus/packages" / name for name in PROGRAMS]
    told = subprocess.run([program, "prove", "--no-cache", "--format", "json", *programs], capture_output=True, cwd=folder,
                          env={"PATH": path, "HOME": str(folder)}, timeout=600).stdout
    return {(file["path"], claim["id"]): (claim["verdict"], claim["grade"])
            for file in json.loads(told)["files"] for claim in file["obligations"]}


class Tarball(Packaged):
    def setUp(self):
        super().setUp()
        self.run_clean("tar", "-xzf", self.artifact("feedhold-*-linux-x86_64.tar.gz"))
        self.program = next(self.folder.glob("feedhold-*/bin/feedhold"))

    def test_use(self):
        self.use(self.program)

    def test_no_interpreter_is_asked_for(self):
        data = self.program.read_bytes()
        begin, size, count = (struct.unpack_from(form, data, at)[0] for form, at in (("<Q", 32), ("<H", 54), ("<H", 56)))
        self.assertNotIn(PT_INTERP, [struct.unpack_from("<I", data, begin + i * size)[0] for i in range(count)])

    @unittest.skipUnless(os.geteuid() == 0, "only root may change the root of the file system")
    def test_empty_root(self):
        result = self.run_clean("chroot", self.program.parent, "/feedhold", "self-check")
        self.assertIn("the self-check passed", result.stdout)
        self.assertRegex(result.stdout, "skipped +z3")

    def test_same_verdicts_as_the_build_that_links_z3(self):
        ours = verdicts(FEEDHOLD, SYSTEM_PATH, self.folder)
        self.assertGreater(len(ours), 4)
        self.assertEqual(verdicts(self.program, SYSTEM_PATH, self.folder), ours)

    def test_japanese_comments_need_no_tables_of_the_system(self):
        (self.folder / "O1.nc").write_bytes("O1(工具交換)\n#1-5(ｷﾘ)\nM30\n".encode("cp932"))
        told = self.run_clean(self.program, "check", "O1.nc", code=1, GCONV_PATH="/nowhere").stdout
        self.assertIn("ｷﾘ", told)

    def test_what_goes_with_it(self):
        top = self.program.parents[1]
        self.assertTrue((top / "share/man/man1/feedhold.1").is_file())
        notices = (top / "share/doc/feedhold/THIRD-PARTY-NOTICES").read_text()
        for library in ("gmp", "glibc", "fmtlib", "cli11", "tomlplusplus", "nlohmann-json3", "gcc-12"):
            self.assertRegex(notices, rf"(?m)^{library} \S+: ")


if __name__ == "__main__":
    main()
