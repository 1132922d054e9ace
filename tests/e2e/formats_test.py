"""The machine-readable outputs: JSON against its schema, JUnit as XML, GitHub's annotation lines."""
import json
import unittest
import xml.etree.ElementTree

import jsonschema

from harness import BAD, GOOD, ROOT, Scratch

UNSET_ON_A_WAY = """O1002
IF[#100EQ1]GOTO10
#1=5.
N10 G90 G00 X#1
M30
"""


class Formats(Scratch):
    def setUp(self):
        super().setUp()
        self.write("bad.nc", BAD)
        self.write("good.nc", GOOD)
        self.write("picture.nc", bytes(range(256)) * 64)

    def output(self, name):
        result = self.check("--format", name, "bad.nc", "good.nc", "picture.nc")
        self.assertExit(result, 1)
        return result.stdout

    def test_json_follows_its_schema(self):
        report = json.loads(self.output("json"))
        schema = json.loads((ROOT / "docs" / "schemas" / "check.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.validate(report, schema)
        self.assertEqual(report["version"], 2)
        finding = next(found for found in report["findings"] if found["rule"] == "missing-equals")
        self.assertEqual((finding["path"], finding["line"]), ("bad.nc", 3))
        self.assertEqual(len(report["skipped"]), 1)

    def test_schema_refuses_what_is_no_report(self):
        for path in (ROOT / "docs" / "schemas").glob("*.json"):
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate({"version": 2, "findings": [{"path": 5}]}, json.loads(path.read_text()))

    def test_fingerprint_survives_a_move(self):
        before = json.loads(self.output("json"))["findings"][0]["fingerprint"]
        self.write("bad.nc", BAD.replace("#510", "(A NEW LINE ABOVE)\n#510"))
        self.assertEqual(json.loads(self.output("json"))["findings"][0]["fingerprint"], before)

    def test_junit_is_xml(self):
        root = xml.etree.ElementTree.fromstring(self.output("junit"))
        self.assertTrue(root.tag in ("testsuites", "testsuite"))
        self.assertEqual(len(list(root.iter("failure"))), 1)

    def test_github_names_file_and_line(self):
        self.assertIn("::error file=bad.nc,line=3", self.output("github"))
        self.assertIn("\ndialect fanuc-30i: 2 by its text\n", self.output("github"))

    def test_way_to_a_finding(self):
        self.write("way.nc", UNSET_ON_A_WAY)
        rule = ("--select", "possibly-unset-variable", "way.nc")
        finding = json.loads(self.check("--format", "json", *rule).stdout)["findings"][0]
        self.assertEqual([(step["path"], step["line"], step["message"]) for step in finding["flow"]],
                         [("way.nc", 2, "the condition is true")])
        result = json.loads(self.check("--format", "sarif", *rule).stdout)["runs"][0]["results"][0]
        steps = result["codeFlows"][0]["threadFlows"][0]["locations"]
        self.assertEqual([step["location"]["physicalLocation"]["region"]["startLine"] for step in steps], [2, 4])
        self.assertIn("path: line 2 `IF[#100EQ1]GOTO10`: the condition is true", self.check(*rule).stdout)

    def test_sarif_has_what_its_readers_need(self):
        run = json.loads(self.output("sarif"))["runs"][0]
        result = next(found for found in run["results"] if found["ruleId"] == "missing-equals")
        self.assertEqual(result["locations"][0]["physicalLocation"]["region"]["startLine"], 3)
        self.assertTrue(result["message"]["text"])
        self.assertTrue(result["partialFingerprints"])
        rule = next(rule for rule in run["tool"]["driver"]["rules"] if rule["id"] == "missing-equals")
        self.assertTrue(rule["shortDescription"]["text"] and rule["fullDescription"]["text"] and rule["help"]["text"])


if __name__ == "__main__":
    unittest.main()
