"""The judges recognise messages of `check` by their words, so these must be words that the rule's page shows."""
import re
from pathlib import Path

RULES = Path(__file__).resolve().parents[2] / "rules"
MESSAGE = re.compile(r"^(?:error|warning|info): (.*) \[([a-z0-9-]+)\]$", re.MULTILINE)


def require_on_pages(rows):
    """`rows`: (rule, pattern).  A pattern that no message on the rule's page matches would judge nothing, silently."""
    messages = [match.groups() for page in RULES.glob("*/*.md") for match in MESSAGE.finditer(page.read_text())]
    for rule, pattern in rows:
        if not any(name == rule and re.search(pattern, text) for text, name in messages):
            raise ValueError(f"no message on the page of {rule} matches `{pattern}`")
