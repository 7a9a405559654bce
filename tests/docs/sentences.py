#!/usr/bin/env python3
"""sentences.py SOURCE [MOST]: prints each sentence of README.md, CONTRIBUTING.md and docs/*.md with more than MOST words, 30 of them.

A sentence ends at . ! or ? before a blank, and where its list item, table cell or paragraph ends. Code in backticks and the address of
a link are no words, and a number is one.
"""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
most = int(sys.argv[2]) if len(sys.argv) > 2 else 30
ABBREVIATIONS = re.compile(r"\b(e\.g|i\.e|et al|vs|Fig|approx|No)\.")


def paragraphs(text):
    """Each with its line: of prose, of a list item, of a table cell."""
    text = re.sub(r"^```.*?^```$", lambda block: "\n" * block[0].count("\n"), text, flags=re.M | re.S)
    now, begin = [], 0
    for number, line in enumerate([*text.split("\n"), ""], 1):
        starts = re.match(r"\s*([-*] |\d+\. |#|\||<|!\[|    )", line)
        if now and (starts or not line.strip()):
            yield begin, " ".join(now)
            now = []
        if re.match(r"\s*\|", line):
            for cell in line.strip().strip("|").split("|"):
                yield number, cell
        elif line.strip() and not re.match(r"#|<|!\[|    \S", line):
            begin = begin if now else number
            now.append(re.sub(r"^\s*([-*]|\d+\.) ", "", line).strip())


def words(sentence):
    plain = re.sub(r"`[^`]*`", "code", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", sentence))
    return [word for word in plain.split() if re.search(r"\w", word)]


long = seen = 0
for page in [source / "README.md", source / "CONTRIBUTING.md", *sorted((source / "docs").glob("*.md"))]:
    for line, text in paragraphs(page.read_text()):
        for sentence in re.split(r"(?<=[.!?])[)*\"]*\s+(?=\S)", ABBREVIATIONS.sub(r"\1", text)):
            seen += 1
            if len(words(sentence)) > most:
                long += 1
                print(f"{page.relative_to(source)}:{line}: {len(words(sentence))} words: {sentence}")
if seen < 500:
    print(f"the pages have only {seen} sentences")
sys.exit(1 if long or seen < 500 else 0)
