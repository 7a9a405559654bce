#!/usr/bin/env python3
"""promises.py HITPIPE: what the features of the core promise of machines (rtl_gen/core/feature.hpp), as rows for
prove_machines.sh: `proof NAME FORMAT WHAT` and `damage NAME FORMAT WHAT EXPRESSION`, with tabs between.

promises.py HITPIPE check: false if proved.txt lacks one of these rows, if an expression does not change its machine, if a
promise has neither proof nor test, or if a feature adds a machine to the core that no promise of it names."""
import functools
import json
import pathlib
import re
import subprocess
import sys
import tempfile

program = str(pathlib.Path(sys.argv[1]).resolve())
proved_file = pathlib.Path(__file__).with_name("proved.txt")


def run(*command, folder=None):
    return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout


def features():
    return json.loads(run(program, "list", "features", "--format", "json"))


def proofs(feature):
    return [promise for promise in feature.get("promises", []) if "bits" in promise]


def rows(all_features):
    """Those of the base last. The proofs of a cache and of rings are the dearest, and should not run alone at the end."""
    for feature in all_features[1:] + all_features[:1]:
        for promise in proofs(feature):
            of = promise["machine"], promise["bits"]
            yield "proof", *of, promise["what"]
            for damage in promise.get("damage", []):
                yield "damage", *of, damage["what"], damage["change"]


def changes(folder, machine, bits, change):
    """Whether damage of a machine's Verilog is any."""
    run(program, "rtl", machine, "--bits", bits, "--name", machine, "--vectors", "1", "--out", ".", folder=folder)
    verilog = (folder / f"{machine}.v").read_text()
    return run("sed", change, f"{machine}.v", folder=folder) != verilog


@functools.cache
def machines_of(options, folder):
    """Modules of a core and its wrapper."""
    run(program, "core", "rtl", "--bits", "8+0/4s8", "--rays", "2", *options, "--name", "core", "--out", ".", folder=folder)
    return {module for name in ("core.v", "core_axi.v")
            for module in re.findall(r"^module core_(\w+)", (folder / name).read_text(), re.M)}


def check(all_features):
    wrong = []
    proved = {line.split(" ", 1)[1] for line in proved_file.read_text().splitlines()}
    of_option = {each["feature"]: tuple(each["option"].split()) for each in all_features}
    known = {each["machine"] for each in json.loads(run(program, "list", "machines", "--format", "json"))}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for kind, machine, bits, what, *change in rows(all_features):
            if f"machines: {machine}: {what} {bits}" not in proved:
                wrong.append(f"{machine} {bits}: proved.txt does not have: {what}")
            if change and not changes(folder, machine, bits, *change):
                wrong.append(f"{machine} {bits}: changes nothing: {what}")
        for feature in all_features:
            own, others = feature["feature"], feature.get("needs", [])
            needed = sum((of_option[other] for other in others), ())
            added = machines_of(needed + of_option[own], folder) & known
            if own != all_features[0]["feature"]:
                added -= machines_of(needed, folder)
            named = {promise.get("machine") for promise in feature.get("promises", [])}
            wrong += [f"{own}: it adds {machine}, of which it promises nothing" for machine in sorted(added - named)]
            for promise in feature.get("promises", []):
                if ("bits" in promise) == ("test" in promise) or ("bits" in promise) != ("damage" in promise):
                    wrong.append(f"{own}: neither a proof that finds damage nor a test alone: {promise['what']}")
    count = len(list(rows(all_features)))
    print(*wrong, f"{count} rows", sep="\n")
    return 1 if wrong or count < 60 else 0


if sys.argv[2:] == ["check"]:
    sys.exit(check(features()))
for row in rows(features()):
    print(*row, sep="\t")
