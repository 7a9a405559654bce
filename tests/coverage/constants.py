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


def plain(module):
    """Yosys calls a module with parameters $paramod\\NAME\\VALUES."""
    return module.split("\\")[1] if module.startswith("$paramod") else module


def constant_bits(net):
    return {bit for bit, value in enumerate(net["bits"]) if value in ("0", "1")} if net else set()


def constants(files, top, folder):
    """(module, signal): the bits that are constant in every instance."""
    (folder / "constants.ys").write_text(SCRIPT.format(files=" ".join(map(str, files)), top=top))
    done = subprocess.run(["yosys", "-q", "-s", "constants.ys"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          errors="replace")
    if done.returncode != 0:
        raise SystemExit(f"coverage: yosys: {done.stdout[-2000:]}")
    modules = json.loads((folder / "modules.json").read_text())["modules"]
    nets = json.loads((folder / "flat.json").read_text())["modules"][top]["netnames"]
    places, signals = collections.defaultdict(list), collections.defaultdict(set)
    for path, module in instances(modules, top):
        places[plain(module)].append(path)
        signals[plain(module)].update(modules[module]["netnames"])
    found = {}
    for module, paths in places.items():
        for signal in signals[module]:
            bits = set.intersection(*(constant_bits(nets.get(path + signal)) for path in paths))
            if bits:
                found[module, signal] = bits
    return found
