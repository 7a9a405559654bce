#!/usr/bin/env python3
"""Copies hls/machines with the statements of each block that write the next state, an output or a memory, or
ask a memory, at its end and in reverse order. In the form of machines that changes nothing.
  reverse_statements.py SOURCE FOLDER
FOLDER/moved.txt says how many statements of each file have another place."""
import pathlib
import re
import sys

WRITE = re.compile(r"(next|out)(\[|\.where\(|\.hold\()|out\.(copy|from_held)\(|memory\[\w+\]\.(write|ask|access)\(")


def statements(text):
    """Pieces of a text, each up to the ; { or } that ends it outside of parentheses."""
    pieces, begin, depth, at = [], 0, 0, 0
    while at < len(text):
        if text.startswith("//", at):
            at = text.index("\n", at)
            continue
        if text[at] == '"':
            at = text.index('"', at + 1)
        elif text[at] in "([":
            depth += 1
        elif text[at] in ")]":
            depth -= 1
        elif text[at] in ";{}" and depth == 0:
            pieces.append(text[begin : at + 1])
            begin = at + 1
        at += 1
    return pieces + [text[begin:]]


def without_comments(piece):
    return re.sub(r"//[^\n]*", "", piece).strip()


def reversed_writes(text):
    done, moved, count = [], [[]], 0
    for piece in statements(text):
        bare = without_comments(piece)
        if WRITE.match(bare) and bare.endswith(";"):
            moved[-1].append("\n" + bare)
            count += 1
            continue
        ends = bare.startswith("return") or bare.endswith("}")
        if ends and moved[-1]:
            done += moved[-1][::-1]
            moved[-1] = []
        done.append(piece)
        if bare.endswith("{"):
            moved.append([])
        elif bare.endswith("}") and len(moved) > 1:
            moved.pop()
    return "".join(done), count


def main():
    source, folder = map(pathlib.Path, sys.argv[1:3])
    place = folder / "hls/machines"
    place.mkdir(parents=True, exist_ok=True)
    lines = []
    for file in sorted((source / "hls/machines").glob("*.hpp")):
        text, count = reversed_writes(file.read_text())
        (place / file.name).write_text(text)
        if count:
            lines.append(f"{file.name} {count}\n")
    (folder / "moved.txt").write_text("".join(lines))


main()
