"""The survivors that people have found to be equivalent, in equivalent.txt: the reason of each."""


def machine_of(module, top):
    """A module's name without the core's, which holds its format: `walker`, or `core` of the core itself."""
    if not top.startswith("hitpipe_core"):
        return module
    return module[len(top) + 1:] or "core"


class Known:
    """Entries of four lines: the machine, its line, the line with the fault, and why both do the same. A blank line parts them."""

    def __init__(self, text):
        self.reasons = {}
        plain = "\n".join(line for line in text.split("\n") if not line.startswith("#"))
        for entry in plain.strip().split("\n\n"):
            lines = [line.strip() for line in entry.strip().split("\n")]
            if lines == [""]:
                continue
            if len(lines) != 4:
                raise SystemExit(f"equivalent.txt: {len(lines)} lines at {lines[0]}; an entry has 4: machine, line, fault, reason")
            self.reasons[tuple(lines[:3])] = lines[3]

    def reason(self, machine, fault):
        return self.reasons.get((machine, fault.before.strip(), fault.after.strip()))
