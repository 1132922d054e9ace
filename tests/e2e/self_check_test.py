"""`feedhold self-check`: passes with the solvers and without, and says which it had."""
import json
import unittest

from harness import Scratch

STEPS = ["check", "run", "prove", "refute", "certificate", "z3", "cvc5"]


class SelfCheck(Scratch):
    def steps(self, **environment):
        result = self.feedhold("self-check", "--format", "json", environment=environment)
        self.assertExit(result, 0)
        document = json.loads(result.stdout)
        self.assertTrue(document["passed"])
        self.assertEqual([step["name"] for step in document["steps"]], STEPS)
        return {step["name"]: step["result"] for step in document["steps"]}

    def test_passes(self):
        result = self.feedhold("self-check")
        self.assertExit(result, 0)
        self.assertTrue(result.stdout.startswith("feedhold "))
        self.assertTrue(result.stdout.endswith("the self-check passed\n"))
        for row in self.feedhold("dialects").stdout.splitlines():
            self.assertIn(row.split()[0], result.stdout)
        self.assertEqual({self.steps()[name] for name in STEPS[:5]}, {"passed"})

    def test_without_solvers(self):
        steps = self.steps(PATH=str(self.folder))
        self.assertEqual({steps[name] for name in STEPS[:5]}, {"passed"})
        self.assertEqual(steps["cvc5"], "skipped")

    def test_a_solver_that_is_wrong(self):
        cvc5 = self.write("cvc5", '#!/bin/sh\n[ "$1" = --version ] && echo version 9.9 || echo unsat\n')
        cvc5.chmod(0o755)
        result = self.feedhold("self-check", environment={"PATH": f"{self.folder}:/usr/bin:/bin"})
        self.assertExit(result, 1)
        self.assertRegex(result.stdout, r"failed +cvc5 +it refutes what has a solution")
        self.assertIn("the self-check failed", result.stdout)

    def test_folder_does_not_matter(self):
        self.write("feedhold.toml", "dialekt = 5\n")
        self.write("O9901.contract", "@REQUIRE nonsense\n")
        self.steps()


if __name__ == "__main__":
    unittest.main()
