#!/usr/bin/env python3
"""man_page.py PROGRAM MAN: the man page has each command, option and description that --help prints, and roff finds no fault in it."""
import pathlib
import re
import shutil
import subprocess
import sys

program, man = sys.argv[1], pathlib.Path(sys.argv[2])
page = man.read_text()
plain = re.sub(r"\\f[BRI]|\\&", "", page).replace("\\-", "-").replace("\\e", "\\")
wrong = []


def help_of(words):
    return subprocess.run([program, *words, "--help"], check=True, capture_output=True, text=True).stdout


def blank_free(text):
    """A break of help behind a hyphen is one in a word."""
    return re.sub(r"\s+", "", text)


def entries(text):
    """Names and description of each option of a help."""
    for found in re.finditer(r"^  (-[^\n]*(?:\n {20,}[^\n]*)*)", text, re.M):
        first, _, rest = found[1].partition("\n")
        names = re.findall(r"(?<![\w-])--?[a-z][\w-]*", re.split(r"\s{2,}|(?<=[a-z]) [A-Z]", first)[0])
        yield names, re.sub(r"^\S+", "", first.strip()) + " " + rest


def section_of(words):
    if not words:
        return plain.partition("\n.SH OPTIONS\n")[2].partition("\n.SH COMMANDS\n")[0]
    found = re.search(r"^\.SS hitpipe " + re.escape(" ".join(words)) + r"\n(.*?)(?=^\.S[SH] )", plain, re.M | re.S)
    if not found:
        wrong.append(f"{' '.join(words)} has no section")
    return found[1] if found else ""


def check(words):
    """This command and those below it; how many options."""
    text, section = help_of(words), section_of(words)
    count = 0
    for names, description in entries(text):
        count += 1
        tags = re.findall(r"^\.TP\n(.*)$", section, re.M)
        for name in names:
            if not any(re.search(r"(?<![\w-])" + re.escape(name) + r"(?![\w-])", tag) for tag in tags):
                wrong.append(f"{' '.join(words)}: {name} is not in the page")
        last = blank_free(description)[-30:]
        if last not in blank_free(section):
            wrong.append(f"{' '.join(words)}: {names}: {last} is not in the page")
    below = re.findall(r"^  ([a-z]+) {2,}\S", text, re.M) if "COMMAND" in text.split("\n\n")[1] + text.split("\n")[1] else []
    for command in below:
        count += check([*words, command])
    return count


options = check([])
if options < 200:
    wrong.append(f"only {options} options were compared")
for line in ("0  good", "hitpipe cosim int_slabs --scene spheres --out out"):
    if line not in plain:
        wrong.append(f"{line} is not in the page")
if shutil.which("groff"):
    said = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-z", str(man)], capture_output=True, text=True).stderr
    if said:
        wrong.append(said)
sys.exit("\n".join(wrong[:20]) if wrong else 0)
