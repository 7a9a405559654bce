#!/usr/bin/env python3
"""The reader of coverage files on a small text: instances and simulations are joined, and rules name what is left."""
import sys

sys.dont_write_bytecode = True
from points import LINE, TOGGLE, Share, joined, not_covered, ranges, read_rules, shares


def entry(kind, module, line, name, place, count):
    fields = {"f": f"{module}.v", "l": line, "n": 3, "page": f"{kind}/{module}", "o": name, "h": place}
    return "C '" + "".join(f"\x01{key}\x02{value}" for key, value in fields.items()) + f"' {count}\n"


def fail(what):
    print(what)
    sys.exit(1)


def same(found, expected, what):
    if found != expected:
        fail(f"{what}: {found}, expected {expected}")


BENCH = "# SystemC::Coverage-3\n" + "".join([
    entry("v_toggle", "core_tb", 3, "clk", "TOP.core_tb", 9),
    entry("v_line", "core_walker", 7, "block", "TOP.core_tb.dut.walker", 5),
    entry("v_branch", "core_walker", 8, "if", "TOP.core_tb.dut.walker", 0),
    entry("v_branch", "core_walker", 8, "else", "TOP.core_tb.dut.walker", 5),
    entry("v_toggle", "core_walker", 2, "trail[0]", "TOP.core_tb.dut.walker", 0),
    entry("v_toggle", "core_walker", 2, "trail[1]", "TOP.core_tb.dut.walker", 4),
    entry("v_toggle", "core_walker", 2, "trail[2]", "TOP.core_tb.dut.walker", 0),
    entry("v_toggle", "core_walker", 2, "trail[3]", "TOP.core_tb.dut.walker", 0),
    entry("v_toggle", "core_mul__A1", 2, "sign", "TOP.core_tb.dut.one", 0),
    entry("v_toggle", "core_mul__A2", 2, "sign", "TOP.core_tb.dut.other", 1),
])
HARNESS = "".join([
    entry("v_toggle", "core_walker", 2, "trail[0]", "TOP.core_axi.core_i.walker", 2),
    entry("v_toggle", "core_walker", 2, "trail[2]", "TOP.core_axi.core_i.walker", 0),
    entry("v_toggle", "core_axi", 4, "unused", "TOP.core_axi", 0),
])


def is_of_core(module):
    return not module.endswith("_tb")


def machine(module):
    return module[len("core_"):]


counts = joined([BENCH, HARNESS], is_of_core)
CONSTANTS = {("core_walker", "trail"): {1, 2}, ("core_axi", "unused"): {0}}
found = {key: (share.reached, share.constant, share.every) for key, share in shares(counts, CONSTANTS).items()}
same(found, {("core_walker", LINE): (2, 0, 3), (None, LINE): (2, 0, 3), ("core_walker", TOGGLE): (2, 1, 4), ("core_mul", TOGGLE): (1, 0, 1),
             ("core_axi", TOGGLE): (0, 1, 1), (None, TOGGLE): (3, 2, 6)}, "what is reached")
same([Share(3, 2, 6).percent(), Share(3, 2, 6).percent_of_what_changes(), Share().percent(), Share(0, 1, 1).percent_of_what_changes()],
     [50.0, 75.0, 100.0, 100.0], "percent")
same(ranges([5, 3, 4, 9, 0]), "0,3:5,9", "bits")

RULES = ("# A note.\n\n* unused\nNobody reads it.\n\n"
         "small: walker trail[2:3]\nwalker tr*[3]\nwalker line_8\nToo far away.\n\naxi other\nNo use.\n")
rules = read_rules(RULES)
same(not_covered(counts, {}, "small", machine, rules), {
    ("Nobody reads it.", "axi", "unused"): [], ("Too far away.", "walker", "trail"): [2, 3], ("Too far away.", "walker", "line 8, if"): []},
    "what is left")
same([rule.text for rule in rules if not rule.used], ["walker tr*[3]", "axi other"], "rules that name nothing")
same(not_covered(counts, {}, "default", machine, rules), {
    ("Nobody reads it.", "axi", "unused"): [], ("Too far away.", "walker", "trail"): [3], (None, "walker", "trail"): [2],
    ("Too far away.", "walker", "line 8, if"): []}, "what is left of another core")
same(not_covered(counts, CONSTANTS, "default", machine, rules), {
    ("Too far away.", "walker", "trail"): [3], ("Too far away.", "walker", "line 8, if"): []}, "what is left but constants")
