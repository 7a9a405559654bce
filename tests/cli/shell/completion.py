#!/usr/bin/env python3
"""completion.py FOLDER SHELL: the completions of FOLDER in that shell at a pseudo-terminal. 77: the shell is not there."""
import os
import pathlib
import pty
import re
import select
import shutil
import sys
import tempfile
import time

folder, shell = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
if not shutil.which(shell):
    sys.exit(77)
START = {
    "bash": ["bash", "--norc", "--noprofile", "-i"],
    "zsh": ["zsh", "-f", "-i"],
}
SET_UP = {
    "bash": f"bind 'set enable-bracketed-paste off'; bind 'set page-completions off'; bind 'set completion-query-items 0'; source {folder}/hitpipe.bash",
    "zsh": f"unset zle_bracketed_paste; setopt no_auto_menu; LISTMAX=0; fpath=({folder} $fpath); autoload -Uz compinit; compinit -u -D",
}


class Terminal:
    """An interactive shell, as a user types to it."""

    def __init__(self, home):
        self.child, self.end = pty.fork()
        if self.child == 0:
            os.chdir(home)
            os.execvpe(shell, START[shell], {"PATH": os.environ["PATH"], "HOME": str(home), "TERM": "dumb", "PS1": "> ",
                                             "COLUMNS": "200", "LINES": "400", "PROMPT_EOL_MARK": ""})

    def read_until(self, sign, seconds=60):
        text, until = "", time.monotonic() + seconds
        while not re.search(sign, text):
            if time.monotonic() > until:
                sys.exit(f"{shell}: no {sign!r} in {text!r}")
            if select.select([self.end], [], [], 0.2)[0]:
                text += os.read(self.end, 65536).decode(errors="replace")
                text = re.sub(r"\x1b\[[?\d;]*[A-Za-z]", "", text)
        return text

    def type(self, text):
        os.write(self.end, text.encode())

    def close(self):
        self.type("\x15exit\n")
        os.close(self.end)
        os.waitpid(self.child, 0)


CASES = [
    ("hitpipe ", ["rtl", "core", "implement", "help"], ["trace"]),
    ("hitpipe core ", ["rtl", "trace", "board"], ["cosim"]),
    ("hitpipe rtl int_sl", ["int_slabs"], []),
    ("hitpipe core rtl --da", ["--data-bits"], ["--data-bitz"]),
    ("hitpipe --quiet area --", ["--library", "--verbose"], ["--data-bits"]),
    ("hitpipe area --format ", ["text", "csv", "json"], ["--library"]),
    ("hitpipe help co", ["core", "cosim"], ["rtl"]),
    ("hitpipe bvh --scene my_m", ["my_mesh.ply"], []),
    ("hitpipe bvh --scene ", ["spheres", "statue", "my_mesh.ply"], ["thesis_250nm"]),
    ("hitpipe core trace --scene=sp", ["spheres"], ["statue"]),
    ("hitpipe area --library ", ["thesis_250nm", "xc7", "my_mesh.ply"], ["spheres"]),
    ("hitpipe core trace --memory d", ["dram"], ["ideal"]),
    ("hitpipe implement int_major --target ice40_u", ["ice40_up5k"], []),
    ("hitpipe rtl read_m", ["read_meter"], []),
    ("hitpipe cosim read_m", [], ["read_meter"]),
]
wrong = []
with tempfile.TemporaryDirectory() as name:
    home = pathlib.Path(name)
    (home / "my_mesh.ply").write_text("")
    # A terminal for each, side by side, because what a shell offers has no end that could be waited for.
    terminals = [Terminal(home) for _ in CASES]
    for terminal in terminals:
        terminal.type(SET_UP[shell] + "; echo REA''DY\n")
    for terminal in terminals:
        terminal.read_until("READY\r?\n")
    # The line is completed twice. Then comes a word in front of it, so that it runs nothing.
    for typed in [[f"\x15{line}\t" for line, _, _ in CASES], ["\t"] * len(CASES), ["\x01: '\x05' END\n"] * len(CASES)]:
        for terminal, text in zip(terminals, typed):
            terminal.type(text)
        time.sleep(2)
    for terminal, (line, wanted, unwanted) in zip(terminals, CASES):
        printed = terminal.read_until(r"END[\r\n][^E]*> $")
        terminal.close()
        words = set(re.findall(r"[\w.-]+", printed))
        wrong += [f"{line!r}: {word} is not offered in {printed!r}" for word in wanted if word not in words]
        wrong += [f"{line!r}: {word} is offered in {printed!r}" for word in unwanted if word in words]
sys.exit("\n".join(wrong) if wrong else 0)
