"""The survivors that people have found to be equivalent, in equivalent.txt: the reason of each."""
import re


def machine_of(module, top):
    """A module's name without the core's, which holds its format: `walker`, or `core` of the core itself."""
    if not top.startswith("hitpipe_core"):
        return module
    return module[len(top) + 1:] or "core"


def pattern(line):
    return re.compile(line[1:-1] if line.startswith("/") and line.endswith("/") else re.escape(line))


class Known:
    """Entries of four lines: the machine, its line, the line with the fault, and why both do the same. A blank line parts them.

    A line between two slashes is a regular expression of the whole line.
    """

    def __init__(self, text):
        self.reasons = {}
        plain = "\n".join(line for line in text.split("\n") if not line.startswith("#"))
        for entry in plain.strip().split("\n\n"):
            lines = [line.strip() for line in entry.strip().split("\n")]
            if lines == [""]:
                continue
            if len(lines) != 4:
                raise SystemExit(f"equivalent.txt: {len(lines)} lines at {lines[0]}; an entry has 4: machine, line, fault, reason")
            self.reasons[tuple(pattern(line) for line in lines[:3])] = lines[3]

    def reason(self, machine, fault):
        said = machine, fault.before.strip(), fault.after.strip()
        for patterns, reason in self.reasons.items():
            if all(pattern.fullmatch(text) for pattern, text in zip(patterns, said)):
                return reason
        return None
