"""Yosys finds the bits of a core that are the same in every state: they cannot be reached."""
import collections
import json
import subprocess

SCRIPT = """\
read_verilog -sv {files}
hierarchy -top {top}
proc
write_json modules.json
flatten
opt -fine
wreduce
opt -fine
write_json flat.json
"""


def instances(modules, module, path=""):
    """(path with a point behind it, module) of a module and all in it."""
    yield path, module
    for name, cell in modules[module]["cells"].items():
        if cell["type"] in modules:
            yield from instances(modules, cell["type"], f"{path}{name}.")


def constants(files, top, folder):
    """(module, signal): the bits that are constant in every instance."""
    (folder / "constants.ys").write_text(SCRIPT.format(files=" ".join(map(str, files)), top=top))
    done = subprocess.run(["yosys", "-q", "-s", "constants.ys"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors="replace")
    if done.returncode != 0:
        raise SystemExit(f"coverage: yosys: {done.stdout[-2000:]}")
    modules = json.loads((folder / "modules.json").read_text())["modules"]
    nets = json.loads((folder / "flat.json").read_text())["modules"][top]["netnames"]
    places = collections.defaultdict(list)
    for path, module in instances(modules, top):
        places[module].append(path)
    found = {}
    for module, paths in places.items():
        for signal in modules[module]["netnames"]:
            bits = [{bit for bit, value in enumerate(nets[path + signal]["bits"]) if value in ("0", "1")} if path + signal in nets else set()
                    for path in paths]
            if set.intersection(*bits):
                found[module, signal] = set.intersection(*bits)
    return found
