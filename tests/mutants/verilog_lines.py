"""Reads emitted Verilog line by line: it has one simple statement on each line."""
import re

TOKEN = re.compile(r"\d+'[hdb][0-9a-fA-F]+|[A-Za-z_$][\w$]*|\d+|<<|>>|<=|>=|==|!=|&&|\|\||\S")
DECLARED = re.compile(r"\b(?:wire|reg)(?: signed)?(?: \[(\d+):0\])? (\w+)( \[0:\d+\])?")
WIRE = re.compile(r"\s*(?:wire|reg)(?: signed)?(?: \[[^\]]*\])? (\w+) = (.+);\s*$")
ASSIGN = re.compile(r"\s*assign (\w+) = (.+);\s*$")
REGISTER = re.compile(r"(?:.*\) |\s*|.*: )([a-z]\w*)(?:\[(.+)\])? <?= (.+);\s*$")
LABEL = re.compile(r"\s*(\d+'[hdb][0-9a-fA-F]+): ")
PIN = re.compile(r"\.(\w+)\(")
# These say something of other lines, or what a reader may leave unread.
SKIPPED = re.compile(r"\s*(?:input |output |module |endmodule|always |parameter |localparam |\)|`|/\*|wire unused\b|\$|initial\b)")


class Module:
    """A module's widths by name. A memory has the width of its words."""

    def __init__(self, name):
        self.name = name
        self.widths = {}
        self.memories = set()

    def declare(self, code):
        for high, name, places in DECLARED.findall(code):
            self.widths[name] = int(high or 0) + 1
            if places:
                self.memories.add(name)


class Line:
    """A line whose code a fault may change, with the spans of its expressions."""

    def __init__(self, number, place, module, code, rest, resets):
        self.number = number  # in the file, from 0
        self.place = place  # in the module, from 0
        self.module = module
        self.code = code
        self.rest = rest  # the comment
        self.target = None  # what gets a value, if its width is known
        self.values = []  # spans of what a wire, register or pin gets
        self.pins = []  # likewise of pins
        self.enables = []
        self.addresses = []  # of a memory that is written
        self.labels = []
        self.resets = resets  # it is a register's value after a reset
        self.clocked = False

    def spans(self):
        return self.values + self.pins + self.enables + self.addresses + self.labels


def closing(text, begin):
    """The place of the bracket that closes the one before `begin`."""
    depth = 1
    for place in range(begin, len(text)):
        depth += (text[place] in "([{") - (text[place] in ")]}")
        if depth == 0:
            return place
    return None


def find_expressions(line):
    code = line.code
    declared = WIRE.match(code) or ASSIGN.match(code)
    if declared:
        line.target = declared[1]
        line.values.append(declared.span(2))
        return
    enabled = re.match(r"\s*(?:end )?(?:else )?if \(", code)
    if enabled:
        end = closing(code, enabled.end())
        if end is None:
            return
        line.enables.append((enabled.end(), end))
    label = LABEL.match(code)
    if label:
        line.labels.append(label.span(1))
    register = REGISTER.match(code)
    if register:
        line.target = register[1]
        line.clocked = "<=" in code[register.end(1):register.start(3)]
        line.values.append(register.span(3))
        if register[2] and register[1] in line.module.memories:
            line.addresses.append(register.span(2))
        return
    for pin in PIN.finditer(code):
        end = closing(code, pin.end())
        if end is not None and end > pin.end():
            line.pins.append((pin.end(), end))


def lines_of(text):
    """The lines of a file that a fault may change."""
    found, module, resets, checks, place = [], None, False, False, 0
    for number, whole in enumerate(text.split("\n")):
        code, slashes, comment = whole.partition("//")
        begins = re.match(r"module (\w+)", code)
        if begins:
            module, place = Module(begins[1]), 0
        if module is None:
            continue
        place += 1
        module.declare(code)
        if code.startswith("`"):
            checks = code.startswith("`if")
        if re.match(r"\s*if \(~?rst\w*\) begin", code):
            resets = True
        elif re.match(r"\s*end\b", code):
            resets = False
        if checks or not code.strip() or SKIPPED.match(code) or "lint" in comment:
            continue
        line = Line(number, place, module, code.rstrip(), whole[len(code.rstrip()):], resets)
        find_expressions(line)
        if line.spans():
            found.append(line)
    return found
