"""What `make mutants` plants faults in."""
import subprocess

CORES = [
    ("core, default", ""),
    ("core, small", "--triangle-ii serial --bits 8+0/4s8 --rays 2 --stack 2"),
    ("core, float door", "--door float --barycentrics"),
    ("core, 64 data bits", "--data-bits 64"),
    ("core, cache", "--cache 2"),
    ("core, rings", "--dma --door float --data-bits 64 --cache 2"),
]
UNITS = [
    ("int_slabs", "--axi-stream"),
    ("int_slabs", "--ii 3"),
    ("int_major_pair", "--ray-slots 4"),
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


def configurations():
    return [Configuration(name, f"core rtl {options}".strip(), True) for name, options in CORES] + [
        Configuration(f"{unit} {options}".strip(), f"rtl {unit} {options}".strip(), False) for unit, options in UNITS]
