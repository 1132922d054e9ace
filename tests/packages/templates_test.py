"""The scripts of the GitHub Action and of the GitLab template, run with the wheel from the local index."""
import json

import yaml
from packaged import BAD, DIST, GOOD, REFUTED, ROOT, SYSTEM_PATH, Packaged, main


class Templates(Packaged):
    def setUp(self):
        super().setUp()
        self.run_clean("python3", "-m", "venv", "--system-site-packages", self.folder / "venv")
        self.shop = self.folder / "shop"
        self.shop.mkdir()

    def bash(self, script, code=0, **environment):
        return self.run_clean("bash", "-eo", "pipefail", "-c", script, cwd=self.shop, code=code,
                              **{"PATH": f"{self.folder}/venv/bin:{SYSTEM_PATH}", "PIP_NO_INDEX": "1",
                                 "PIP_FIND_LINKS": str(DIST), **environment})

    def assertSarif(self, name, rule):
        log = json.loads((self.shop / name).read_text())
        self.assertEqual(log["version"], "2.1.0")
        self.assertIn(rule, [result["ruleId"] for run in log["runs"] for result in run["results"]])

    # ---- GitHub ----

    def github(self, code, **inputs):
        """Runs what is bash in the action; gives the code that the last step ends with."""
        action = yaml.safe_load((ROOT / "packaging/github/action.yml").read_text())
        given = {f"${{{{ inputs.{name} }}}}": inputs.get(name, about["default"]) for name, about in action["inputs"].items()}
        output = self.folder / "output"
        output.write_text("")
        scripts = [step for step in action["runs"]["steps"] if "run" in step]
        self.assertEqual({step["shell"] for step in scripts}, {"bash"})
        for step in scripts:
            said = dict(line.split("=") for line in output.read_text().splitlines())
            values = given | {f"${{{{ steps.run.outputs.{name} }}}}": value for name, value in said.items()}
            self.bash(step["run"], code if step is scripts[-1] else 0, GITHUB_OUTPUT=str(output),
                      GITHUB_ACTION_PATH=str(ROOT / "packaging/github"),
                      **{name: values[value] for name, value in step.get("env", {}).items()})

    def test_github(self):
        (self.shop / "O1000.nc").write_text(GOOD)
        self.github(0)
        (self.shop / "O9102.nc").write_text(REFUTED)
        self.github(1)
        self.assertSarif("feedhold-sarif/prove.sarif", "no-control-alarm")
        (self.shop / "O1001.nc").write_text(BAD)
        self.github(1, prove="false", paths="O1000.nc O1001.nc")
        self.assertSarif("feedhold-sarif/check.sarif", "missing-equals")

    # ---- GitLab ----

    def gitlab(self, code):
        job = yaml.safe_load((ROOT / "packaging/gitlab/feedhold.yml").read_text())["feedhold"]
        variables = {name: value.replace("$CI_PROJECT_DIR", str(self.shop)) for name, value in job["variables"].items()}
        self.bash("\n".join(job["script"]), code, **variables)
        for name in [*job["artifacts"]["paths"], job["artifacts"]["reports"]["junit"]]:
            self.assertTrue((self.shop / name).stat().st_size > 0, name)

    def test_gitlab(self):
        (self.shop / "O1000.nc").write_text(GOOD)
        self.gitlab(0)
        (self.shop / "O1001.nc").write_text(BAD)
        self.gitlab(1)
        self.assertSarif("feedhold-check.sarif", "missing-equals")
        self.assertIn("missing-equals", (self.shop / "feedhold-junit.xml").read_text())


if __name__ == "__main__":
    main()
