"""The choice of faults. It depends on the seed and the emitted text alone."""
from faults import faults_of, rank, sources
from verilog_lines import lines_of


LATER = ("_epoch", "_read_meter")


class Fault:
    def __init__(self, file, line, kind, code):
        self.file = file
        self.number = line.number
        self.module = line.module.name
        self.kind = kind
        self.before = line.code
        self.after = code
        self.comment = line.rest

    def text_with_it(self, text):
        lines = text.split("\n")
        lines[self.number] = self.after + self.comment
        return "\n".join(lines)


def faults_in_order(texts, seed):
    """All faults of the files (name: text). A line's second fault comes after the first of every line."""
    found = []
    lines_by_file = {file: lines_of(text) for file, text in sorted(texts.items())}
    # Configurations share machines. The names of all modules give each other faults. Those of modules that came later do
    # not, so that the others keep the faults that they had.
    names = {line.module.name for lines in lines_by_file.values() for line in lines}
    seed = rank(seed, *sorted(name for name in names if not name.endswith(LATER)))
    for file, lines in lines_by_file.items():
        others = sources(lines)
        for line in lines:
            def key(fault, line=line):
                return rank(seed, line.module.name, line.place, *fault)
            # Kinds with many variants do not crowd out the rest.
            kinds = {}
            for fault in sorted(faults_of(line, seed, others), key=key):
                kinds.setdefault(fault[0], []).append(fault)
            # Nearly every line can be tied or stuck, so other kinds are four times as likely to come before these.
            by_turn = sorted((turn, rank(seed, line.place, kind) * (4 if kind in ("tied", "stuck bit") else 1), fault)
                             for kind, faults in kinds.items() for turn, fault in enumerate(faults))
            found += [(turn, key(fault), Fault(file, line, *fault)) for turn, (_, _, fault) in enumerate(by_turn)]
    return [fault for _, _, fault in sorted(found, key=lambda entry: entry[:2])]
