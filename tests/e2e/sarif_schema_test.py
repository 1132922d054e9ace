"""SARIF output against the schema of SARIF 2.1.0 (from an npm package, so only with --oracles)."""
import json
import sys
import unittest

import jsonschema

from harness import BAD, GOOD, ORACLES, ROOT, SKIPPED, Scratch

SCHEMA = ROOT / "build/oracles/node_modules/@microsoft/jest-sarif/lib/schemas/sarif-2.1.0-rtm.5.json"


class SarifSchema(Scratch):
    def setUp(self):
        super().setUp()
        self.validator = jsonschema.Draft4Validator(json.loads(SCHEMA.read_text()))

    def sarif(self, *names):
        return json.loads(self.check("--format", "sarif", *names).stdout)

    def assertValid(self, report):
        errors = [f"{'/'.join(map(str, error.path))}: {error.message}" for error in self.validator.iter_errors(report)]
        self.assertEqual(errors, [])

    def test_report_with_findings(self):
        self.write("bad.nc", BAD)
        self.write("picture.nc", bytes(range(256)) * 64)
        self.assertValid(self.sarif("bad.nc", "picture.nc"))

    def test_report_without_findings(self):
        self.write("good.nc", GOOD)
        self.assertValid(self.sarif("good.nc"))

    def test_report_of_every_rule_page(self):
        for page in ROOT.glob("rules/*/*.md"):
            for number, part in enumerate(page.read_text().split("\n```nc ")[1:]):
                self.write(f"pages/{page.stem}/{number}.nc", part.split("\n", 1)[1].split("\n```")[0] + "\n")
        report = self.sarif("--dialect", "fanuc-30i", "pages")
        self.assertGreater(len(report["runs"][0]["results"]), 20)
        self.assertTrue(any("codeFlows" in result for result in report["runs"][0]["results"]))
        self.assertValid(report)

    def test_report_of_proofs(self):
        self.write("O9100.nc", "O9100\n#1=#21/#22\nWHILE[#1000EQ0]DO1\nEND1\nM99\n")
        self.write("picture.nc", bytes(range(256)) * 64)
        report = json.loads(self.feedhold("prove", "--dialect", "fanuc-30i", "--format", "sarif", "O9100.nc",
                                          "picture.nc").stdout)
        self.assertGreaterEqual(len(report["runs"][0]["results"]), 2)
        self.assertValid(report)

    def test_validator_refuses_what_is_wrong(self):
        self.write("bad.nc", BAD)
        report = self.sarif("bad.nc")
        del report["runs"][0]["tool"]["driver"]["name"]
        self.assertTrue(list(self.validator.iter_errors(report)))


if __name__ == "__main__":
    if not SCHEMA.exists() and not ORACLES:
        sys.exit(SKIPPED)
    unittest.main()
