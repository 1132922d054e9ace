# What pre-commit installs for the hooks of .pre-commit-hooks.yaml: nothing of this source tree, but the wheel `feedhold`
# of the same version, with the program inside.
import re
from pathlib import Path

from setuptools import setup

version = re.search(r"^project\(feedhold VERSION (\S+)", Path(__file__).with_name("CMakeLists.txt").read_text(), re.MULTILINE)[1]
setup(name="feedhold-hooks", version=version, packages=[], py_modules=[], install_requires=[f"feedhold=={version}"])
