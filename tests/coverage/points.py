"""Coverage points of Verilator: which lines and bits a simulation reached, and why others were not."""
import collections
import fnmatch
import re

LINE, TOGGLE = "line", "toggle"
KINDS = {"v_line": LINE, "v_branch": LINE, "v_toggle": TOGGLE}
Point = collections.namedtuple("Point", "kind module line column name")


def points(data):
    """(point, count) of the text of a coverage file. Instances of a module have the same points."""
    for entry in re.finditer(r"^C '(.*)' (\d+)$", data, re.M):
        fields = dict(field.split("\x02", 1) for field in entry[1].split("\x01") if "\x02" in field)
        page, _, module = fields["page"].partition("/")
        if page in KINDS:
            # A name with __ is of a module with other parameters.
            point = Point(KINDS[page], module.partition("__")[0], int(fields["l"]), int(fields["n"]), fields["o"])
            yield point, int(entry[2])


def joined(datas, is_counted):
    """Point: how often it was reached in all the simulations. Where they have other tops, module and line say what is the same."""
    counts = collections.Counter()
    for data in datas:
        for point, count in points(data):
            if is_counted(point.module):
                counts[point] += count
    return counts


class Share:
    """How many points were reached."""

    def __init__(self, reached=0, constant=0, every=0):
        self.reached, self.constant, self.every = reached, constant, every

    def add(self, is_reached, is_constant):
        self.reached += is_reached
        self.constant += is_constant
        self.every += 1

    def percent(self):
        return 100 * self.reached / self.every if self.every else 100.0

    def percent_of_what_changes(self):
        return 100 * self.reached / (self.every - self.constant) if self.every > self.constant else 100.0


def is_constant(point, constants):
    """Of what was not reached: constants are (module, signal): bits."""
    signal, bit = parts(point.name)
    return point.kind == TOGGLE and (bit or 0) in constants.get((point.module, signal), ())


def shares(counts, constants):
    """(module, kind): Share. The module None is all of them."""
    found = collections.defaultdict(Share)
    for point, count in counts.items():
        for module in (point.module, None):
            found[module, point.kind].add(count > 0, count == 0 and is_constant(point, constants))
    return found


def parts(name):
    """A signal and its bit, or the word of a memory; None if it has only one bit."""
    found = re.fullmatch(r"([^\[]*)(?:\[(\d+)\])?(?:\[\d+\])?", name)
    return (found[1], found[2] and int(found[2])) if found else (name, None)


def ranges(bits):
    """`0,16:31`: bits that follow each other are LOW:HIGH."""
    runs = []
    for bit in sorted(set(bits)):
        if runs and runs[-1][1] == bit - 1:
            runs[-1][1] = bit
        else:
            runs.append([bit, bit])
    return ",".join(str(low) if low == high else f"{low}:{high}" for low, high in runs)


class Rule:
    """`MODULE SIGNAL` or `MODULE SIGNAL[LOW:HIGH]`, with * and ?; before it perhaps `CONFIGURATION:`. Of line 12: `MODULE line_12`."""

    def __init__(self, text, reason):
        found = re.fullmatch(r"(?:([^:\[]*): )?(\S+) ([\w*?]+)(?:\[(\d+)(?::(\d+))?\])?", text)
        if not found:
            raise SystemExit(f"not_covered.txt: {text!r}; a rule is [CONFIGURATION: ]MODULE SIGNAL[LOW:HIGH]")
        self.text = text
        self.reason = reason
        self.configuration, self.module, self.signal = found[1], found[2], found[3]
        self.low = found[4] and int(found[4])
        self.high = int(found[5]) if found[5] else self.low
        self.used = False

    def names(self, configuration, module, point):
        signal, bit = parts(point.name)
        if self.configuration not in (None, configuration) or not fnmatch.fnmatchcase(module, self.module):
            return False
        if point.kind == LINE:
            return self.signal == f"line_{point.line}"
        if not fnmatch.fnmatchcase(signal, self.signal):
            return False
        return self.low is None or (bit is not None and self.low <= bit <= self.high)


def read_rules(text):
    """Entries that blank lines part: one rule a line, and then the reason of them all."""
    plain = "\n".join(line for line in text.split("\n") if not line.startswith("#"))
    rules = []
    for entry in re.split(r"\n\s*\n", plain.strip()):
        lines = [line.strip() for line in entry.strip().split("\n")]
        if lines == [""]:
            continue
        if len(lines) < 2:
            raise SystemExit(f"not_covered.txt: {lines[0]!r} has no reason")
        rules += [Rule(line, lines[-1]) for line in lines[:-1]]
    return rules


def not_covered(counts, constants, configuration, machine, rules):
    """(reason, module, what): bits or lines that were not reached; the reason is None if no rule names them. Constants are left out."""
    found = collections.defaultdict(list)
    for point, count in counts.items():
        if count or is_constant(point, constants):
            continue
        module = machine(point.module)
        rule = next((rule for rule in rules if rule.names(configuration, module, point)), None)
        if rule:
            rule.used = True
        signal, bit = parts(point.name)
        key = (rule.reason if rule else None, module, f"line {point.line}, {point.name}" if point.kind == LINE else signal)
        found[key].append(bit if point.kind == TOGGLE else None)
    return {key: sorted(bit for bit in bits if bit is not None) for key, bits in found.items()}
