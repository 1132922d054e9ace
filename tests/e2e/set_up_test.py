"""`machine.contract`: the set-up of a machine, for all programs of a folder that have a contract."""
import json
import unittest

from harness import Scratch

PROGRAM = """O2000
{own}
(@MODAL G17 G21 G40 G49 G54 G69 G80 G90)
(@START X0 Y0 Z0)
G53 G00 X-300. Y0 Z0
G43 H1 Z50.
M99
"""
SET_UP = """; plate 3 on the mill by the door
@OFFSET EXT X0 Y0 Z0
@OFFSET G54 X-400..-300 Y-200. Z-400.
@LENGTH H* 60..200
@MACHINE X-762..0 Y-406..0 Z-508..0 HOME X0 Y0 Z0
"""
MACHINE = "machine.contract"


class SetUp(Scratch):
    def verdicts(self, *arguments):
        result = self.feedhold("prove", "--no-cache", "--format", "json", "job/part.nc", *arguments)
        return {row["id"]: row["verdict"] for file in json.loads(result.stdout)["files"] for row in file["obligations"]}

    def program(self, own="(@CLEARANCE Z-600.)"):
        self.write("job/part.nc", PROGRAM.format(own=own))

    def ranges(self):
        return {name: verdict for name, verdict in self.verdicts().items() if ".MACHINE." in name}

    def test_in_the_folder_or_above(self):
        self.program()
        self.assertEqual(self.ranges(), {})
        for folder in ("", "job/"):
            self.write(folder + MACHINE, SET_UP)
            self.assertEqual(set(self.ranges().values()), {"proved"}, folder)
            (self.folder / folder / MACHINE).unlink()

    def test_the_nearest_holds(self):
        self.program()
        self.write(MACHINE, SET_UP)
        self.write("job/" + MACHINE, SET_UP.replace("Z-508..0", "Z-508..-200"))
        self.assertIn("refuted", self.ranges().values())

    def test_not_above_the_project(self):
        self.program()
        self.write(MACHINE, SET_UP)
        self.write("job/feedhold.toml", "")
        self.assertEqual(self.ranges(), {})

    def test_the_program_goes_before(self):
        self.program("(@OFFSET G54 Z-350.)\n(@LENGTH H1 10.)\n(@MACHINE Z-400..-100)")
        self.write(MACHINE, SET_UP)
        self.assertEqual(set(self.ranges().values()), {"refuted"})
        self.assertEqual(self.check("job").returncode, 0)

    def test_corners_of_the_machine(self):
        for own, rounded, expected in (("", "", "proved"), ("", "@CORNER 0.05\n", "refuted"),
                                       ("(@CORNER 0)\n", "@CORNER 0.05\n", "proved"),
                                       ("(@CORNER 0.05)\n", "@CORNER 0\n", "refuted")):
            self.program(own + "(@CLEARANCE Z50.)")
            self.write(MACHINE, SET_UP + rounded)
            clear = {verdict for name, verdict in self.verdicts().items() if ".clearance." in name}
            self.assertIn(expected, clear, (own, rounded))

    def test_only_with_a_contract(self):
        self.write("job/part.nc", "O2000\nG53 G00 X-300. Y0 Z0\nM99\n")
        self.write(MACHINE, SET_UP)
        self.assertEqual(self.ranges(), {})

    def test_errors_are_told_once_and_nothing_is_proved(self):
        self.program()
        self.write("job/other.nc", PROGRAM.format(own="(@CLEARANCE Z-600.)").replace("O2000", "O2001"))
        self.write(MACHINE, SET_UP + "@LENGTH H1\n@MODAL G54\n")
        found = json.loads(self.check("--format", "json", "--select", "contract", "job").stdout)["findings"]
        self.assertEqual([(row["path"], row["line"]) for row in found], [(MACHINE, 6), (MACHINE, 7)])
        self.assertEqual(self.verdicts(), {})

    def test_unreadable(self):
        self.program()
        self.write(MACHINE, b"@LENGTH\x00\xff\xfe")
        found = json.loads(self.check("--format", "json", "--select", "contract", "job").stdout)["findings"]
        self.assertEqual([row["path"] for row in found], [MACHINE])
        self.assertEqual(self.verdicts(), {})

    def test_empty(self):
        self.program()
        self.write(MACHINE, "; nothing yet\n")
        self.assertEqual(self.check("job").returncode, 0)
        self.assertEqual(self.ranges(), {})


if __name__ == "__main__":
    unittest.main()
