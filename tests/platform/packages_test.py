#!/usr/bin/env python3
"""packages_test.py ROOT: what each goal of make installs, on a system that has none of the packages and no right to install them."""
import pathlib
import re
import subprocess
import sys
import tempfile

root = pathlib.Path(sys.argv[1])
with tempfile.TemporaryDirectory() as name:
    # These stand for dpkg-query, which finds nothing, and id, which says that the user is not root.
    programs = {"dpkg-query": "exit 1", "id": "echo 1000"}
    for program, text in programs.items():
        (pathlib.Path(name) / program).write_text(f"#!/bin/sh\n{text}\n")
        (pathlib.Path(name) / program).chmod(0o755)
    for program in ("sh", "sed", "awk", "grep", "cat", "dirname", "make"):
        (pathlib.Path(name) / program).symlink_to(subprocess.check_output(["which", program], text=True).strip())

    def installs(*command):
        run = subprocess.run(command, cwd=root, env={"PATH": name}, capture_output=True, text=True, check=False)
        assert run.returncode, command
        found = re.search(r"^hitpipe: missing packages: (.*)$", run.stderr, re.M)
        return found[1].split() if found else run.stderr

    groups = {found[1]: re.sub(r"#.*", "", found[2]).split()
              for found in re.finditer(r"^## (\w+):.*\n((?:(?!## ).*\n)*)", (root / "packages.txt").read_text(), re.M)}
    needs = {"build": ["build"], "demo": ["build", "simulate"], "test": list(groups), "lint": ["build", "simulate", "check"],
             "packages": list(groups)}
    assert list(groups) == ["build", "simulate", "chips", "check"], groups
    for goal, wanted in needs.items():
        assert set(installs("make", goal)) == {p for group in wanted for p in groups[group]}, (goal, installs("make", goal))
    assert set(installs("make", "build", "demo")) == set(installs("make", "demo"))
    everything = installs("cmake/install-packages.sh")
    assert sorted(everything) == sorted(sum(groups.values(), [])) == sorted(set(everything)), everything
    assert installs("cmake/install-packages.sh", "coq") == ["coq"]
    said = installs("cmake/install-packages.sh", "--groups", "chip")
    assert said == 'hitpipe: packages.txt has no group "chip"; allowed are build, simulate, chips, check\n', said
    assert installs("cmake/install-packages.sh", "--groups") == "hitpipe: --groups names none; allowed are build, simulate, chips, check\n"
