"""Programs that are hard to follow, or make no sense to follow: `check`, `ranges` and `run` come to an end soon, within
little memory, with an answer or with the reason why there is none."""
import resource
import subprocess
import unittest

from harness import FEEDHOLD, Scratch

LONGEST = 20  # seconds of processor time: a machine that does other work, too, takes as long
HANGS = 300
MOST_MEMORY = 1 << 30


def little_memory_and_time():
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST))


class BadAnalysis(Scratch):
    def follow(self, *blocks, dialect="fanuc-30i"):
        """The exit codes and outputs of all commands."""
        self.write("program.nc", "\n".join(("%", *blocks, "%", "")))
        outputs = {}
        for command in ("check", "ranges", "run"):
            result = subprocess.run([FEEDHOLD, command, "--dialect", dialect, "program.nc"], cwd=self.folder,
                                    capture_output=True, timeout=HANGS, preexec_fn=little_memory_and_time,
                                    stdin=subprocess.DEVNULL)
            text = (result.stdout + result.stderr).decode(errors="replace")
            self.assertIn(result.returncode, (0, 1), f"{command}: {text[-2000:]}")
            self.assertTrue(text.strip(), command)
            outputs[command] = text
        return outputs

    # ---- calls ----

    def test_program_that_calls_itself(self):
        told = self.follow("O1", "#1=#1+1", "M98P1", "G65P1A#1", "M99")
        self.assertIn("PS0077", told["run"])

    def test_programs_that_call_each_other(self):
        told = self.follow("O1", "G65P2A#1B[#2+1]", "M98P2", "M99", "O2", "#3=#1", "G65P1A#3", "IF[#2LT5]GOTO5", "M98P1",
                           "N5M99")
        self.assertIn("calls itself", told["ranges"])

    def test_missing_programs(self):
        told = self.follow("O1", "M98P8888L#1", "G65P7777A1", "G66P6666", "X1", "G67", "M98P#1", "M30")
        self.assertIn("that was not supplied", told["ranges"])

    def test_chains_of_calls_whose_number_doubles(self):
        for call in ("G65P{}A[#1+1]", "M98P{}"):
            blocks = []
            for number in range(1, 60):
                blocks.append(f"O{number}")
                for i in range(4):
                    blocks += [f"#1=#1+{i}", f"#{100 + i}=#{100 + i}*2+#1", call.format(number + 1)]
                blocks.append("M99")
            self.follow(*blocks, "O60", "#100=#100+1", "M99")

    def test_long_chains_of_calls_grow_with_their_length(self):
        """Each program was once followed through all those below it: 500 of them took half a minute."""
        for extra in ((), ("G65P9999A#1",)):
            blocks = ["O9999", "#500=#1*2", "M99"]
            for number in range(1, 501):
                blocks += [f"O{number}", "#1=#1+1", f"IF[#1GT{number}]GOTO10", *extra, f"M98P{number + 1}", "N10M99"]
            self.write("program.nc", "\n".join(("%", *blocks, "O501", "M99", "%", "")))
            result = subprocess.run([FEEDHOLD, "check", "--dialect", "fanuc-30i", "program.nc"], cwd=self.folder,
                                    check=False, capture_output=True, timeout=HANGS,
                                    preexec_fn=little_memory_and_time, stdin=subprocess.DEVNULL)
            self.assertIn(result.returncode, (0, 1))

    def test_modal_calls_without_end(self):
        self.follow("O1", "N10G66P2A#1", "#1=#1+1", "GOTO10", "O2", "M99")
        self.follow("O1", "N10G66P2A#1", "X#1", "GOTO10", "O2", "G1Z#1", "M99")
        self.follow("O1", "G66P2A1", "X1", "M30", "O2", "G66P2", "X2", "G65P2", "M99")

    def test_calls_repeated_millions_of_times(self):
        self.follow("O1", "M98P2L9999999", "G65P3L99999999A1", "M98P2L#1", "M30", "O2", "#1=#1+1", "M99", "O3",
                    "M98P2L9999", "M99")

    def test_subroutine_that_calls_itself(self):
        self.follow("o1 sub", "o1 call [#1+1]", "o1 call [#1+2]", "o1 endsub", "o1 call [1]", "m2", dialect="linuxcnc")

    # ---- jumps ----

    def test_tangle_of_jumps(self):
        blocks = []
        for i in range(50):
            blocks += [f"N{i + 1}#{100 + i % 20}=#{100 + i * 7 % 20}+1",
                       f"IF[#{100 + i % 20}GT{i}]GOTO{i * 17 % 50 + 1}",
                       f"IF[#{100 + (i + 3) % 20}LT{i * 3}]GOTO{(i * 31 + 7) % 50 + 1}", f"GOTO#{100 + (i + 5) % 20}"]
        self.follow("O1", *blocks, "M30")

    def test_jumps_into_loops(self):
        blocks = [f"WHILE[#{depth}LT10]DO{depth}" for depth in (1, 2, 3)]
        blocks += [f"N{i}IF[#{i % 30 + 1}GT#{i * 7 % 30 + 1}]GOTO{i * 13 % 100 + 1}" for i in range(1, 101)]
        for depth in (3, 2, 1):
            blocks += [f"#{depth}=#{depth}+1", f"END{depth}"]
        self.follow("O1", *blocks, "GOTO#1", "M30")

    def test_many_computed_jumps(self):
        told = self.follow("O1", *(f"N{i + 1}GOTO#{i % 33 + 1}" for i in range(1500)), "M30")
        self.assertIn("no ranges: ", told["ranges"])

    # ---- loops ----

    def test_nested_loops_of_a_million(self):
        self.follow("O1", "#1=0", "WHILE[#1LT1000000]DO1", "#2=0", "WHILE[#2LT1000000]DO2", "#3=0", "N10#3=#3+1", "#4=0",
                    "N20#4=#4+1", "IF[#4LT1000000]GOTO20", "IF[#3LT1000000]GOTO10", "#2=#2+1", "END2", "#1=#1+1", "END1",
                    "M30")

    def test_loops_of_o_words(self):
        heads = [block for i in range(1, 25)
                 for block in (f"o{i} while [#{i + 30} lt 1000000]", f"#{i + 30}=[#{i + 30}+1]")]
        self.follow(*heads, *(f"o{i} endwhile" for i in range(24, 0, -1)), "m2", dialect="linuxcnc")
        self.follow("o2 repeat [1000000]", "o3 repeat [1000000]", "#1=[#1+1]", "o3 endrepeat", "o2 endrepeat", "m2",
                    dialect="linuxcnc")

    def test_loop_that_moves_without_end(self):
        self.follow("O1", "N10G1X#1", "#1=#1+1", "GOTO10")

    # ---- numbers and variables ----

    def test_huge_and_tiny_constants(self):
        self.follow("O1", "#1=" + "9" * 3000, "#2=.00000001", "#3=." + "0" * 3000 + "1", "G0X" + "9" * 400, "M30")
        self.follow("O1", "#1=99999999999999999999", "#2=.00000001", "#4=#1*#1*#1", "#5=#2/#1", "#7=EXP[#1]", "#8=SIN[#1]",
                    "#9=POW[#1,#1]", "#10=#1MOD#2", "X[#1]Y[#7]Z[#5]", "WHILE[#11LT#1]DO1", "#11=#11+#2", "END1", "M30")
        self.follow("O1", "#1=2", "WHILE[#9LT1000]DO1", "#1=#1*#1", "#2=#1-#1", "#3=FIX[#1]AND255", "#9=#9+1", "END1",
                    "M30")

    def test_every_variable_is_written(self):
        blocks = []
        for i in range(4000):
            blocks += [f"#{500 + i % 500}=#{100 + i % 100}+{i}", f"#{100 + i % 100}=#{500 + i * 7 % 500}*2",
                       f"IF[#{500 + i % 500}GT{i}]GOTO{i + 1}", f"N{i + 1}"]
        self.follow("O1", *blocks, "GOTO1")
        self.follow("O1", "N10#[500+#1]=#1", "#1=#1+1", "#[#1]=#[#1-1]", "GOTO10")


if __name__ == "__main__":
    unittest.main()
