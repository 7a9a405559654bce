"""What `make mutants` plants faults in: the default core, each feature of `hitpipe list features`, and more."""
import json
import subprocess

# What cores have beside their feature, so that more of them is met.
BESIDE = {
    "weights": "--door float",
    "serial_triangle": "--bits 8+0/4s8 --rays 2 --stack 2",
    "questions": "--cache 2 --number-bits 12",
    "rings": "--data-bits 64 --cache 2",
}
CORES = [("core, default", ""), ("core, 64 data bits", "--data-bits 64")]
UNITS = [
    ("int_slabs", "--axi-stream"),
    ("int_slabs", "--ii 3"),
    ("int_major_pair", ""),
    ("int_major_pair", "--ii 3"),
    ("int_triangle", ""),
    ("int_triangle", "--ii 3"),
    ("int_triangle", "--bits 20+1s20c2"),
    ("fp_slabs", "--fifo"),
    ("fp_slabs", "--ii 3"),
    ("int_ray", ""),
    ("fp_plucker", "--ii 3"),
]


class Configuration:
    def __init__(self, name, command, is_core):
        self.name = name
        self.command = command
        self.is_core = is_core

    def write(self, hitpipe, folder):
        done = subprocess.run([hitpipe, *self.command.split(), "--out", folder], stdout=subprocess.DEVNULL)
        if done.returncode != 0:
            raise SystemExit(f"mutants: hitpipe {self.command} fails")


def of_features(hitpipe):
    """A core for each feature, with what that needs."""
    listed = json.loads(subprocess.check_output([hitpipe, "list", "features", "--format", "json"]))
    option = {each["feature"]: each["option"] for each in listed}
    return [(f"core, {each['feature']}", " ".join([each["option"], *(option[other] for other in each.get("needs", [])),
                                                   BESIDE.get(each["feature"], "")]).strip())
            for each in listed if each["option"] and each["feature"] != "float_door"]  # which others have beside them


def configurations(hitpipe):
    return [Configuration(name, f"core rtl {options}".strip(), True) for name, options in CORES + of_features(hitpipe)] + [
        Configuration(f"{unit} {options}".strip(), f"rtl {unit} {options}".strip(), False) for unit, options in UNITS]
