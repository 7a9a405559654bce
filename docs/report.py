#!/usr/bin/env python3
"""Makes docs/report/ again, a page for readers of the repository, from a report of spheres: docs/report.py [PROGRAM].
It takes five minutes."""
import html
import pathlib
import re
import shutil
import subprocess
import sys

COMMAND = ["report", "--scene", "spheres", "--width", "64", "--height", "64", "--without", "images,schematics"]
program = sys.argv[1] if len(sys.argv) > 1 else "build/hitpipe"
out, kept = pathlib.Path("out/report"), pathlib.Path("docs/report")


def words(text: str) -> str:
    """Of HTML, as one line of Markdown."""
    return re.sub(r"\s+", " ", html.unescape(re.sub("<[^>]*>", "", text))).strip().replace("|", "\\|").replace("_", "\\_")


def table(caption: str, text: str) -> list[str]:
    """A table of Markdown. A number is on the right of its column."""
    head = [words(cell) for cell in re.findall(r"<th[^>]*>(.*?)</th>", text)]
    rows = [re.findall(r"<td([^>]*)>(.*?)</td>", row) for row in re.findall(r"<tr>(.*?)</tr>", text)]
    rows = [row for row in rows if row]
    right = ["--:" if all('class="n"' in row[i][0] or not row[i][1] for row in rows) else "---" for i in range(len(head))]
    lines = [head, right, *([words(cell) for _, cell in row] for row in rows)]
    return [f"*{caption}*", "", *(f"| {' | '.join(line)} |" for line in lines), ""]


def page(text: str) -> list[str]:
    """The questions of a report, without the commands at their ends."""
    lines: list[str] = []
    pattern = re.compile(r'<h2[^>]*>(?P<h2>.*?)</h2>|<h3>(?P<h3>.*?)</h3>|<p(?: class="(?P<of>\w+)")?>(?P<p>.*?)</p>|'
                         r'<figcaption><strong>(?P<figure>.*?)</strong>.*?Files: (?P<file>\w+)\.svg|'
                         r'<table aria-label="(?P<caption>[^"]*)"[^>]*>(?P<table>.*?)</table>|<dt>(?P<dt>.*?)</dt><dd>(?P<dd>.*?)</dd>',
                         re.S)
    for found in pattern.finditer(text):
        if found["h2"]:
            lines += [f"## {words(found['h2'])}", ""]
        elif found["h3"]:
            lines += [f"### {words(found['h3'])}", ""]
        elif found["p"] and found["of"] != "caption":
            lines += [f"**{words(found['p'])}**" if found["of"] == "lead" else words(found["p"]), ""]
        elif found["figure"]:
            shutil.copy(out / f"{found['file']}.svg", kept)
            lines += [f"*{words(found['figure'])}*", "", f"![{words(found['figure'])}]({found['file']}.svg)", ""]
        elif found["table"]:
            lines += table(words(found["caption"]), found["table"])
        elif found["dt"]:
            lines += [f"- {words(found['dt'])}: {words(found['dd'])}"] + ([""] if text[found.end():].lstrip().startswith("</dl>") else [])
    return lines


shutil.rmtree(out, ignore_errors=True)
subprocess.run([program, *COMMAND, "--out", str(out)], check=True)
shutil.rmtree(kept, ignore_errors=True)
kept.mkdir()
version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
made = (out / "index.html").read_text(encoding="utf-8")
questions = made[made.index('<h2 id="bits">'):made.index('<h2 id="versions">')]
(kept / "README.md").write_text("\n".join([
    "# A report", "", f"By `docs/report.py`, hitpipe {version}, from `hitpipe {' '.join(COMMAND)} --out out/report`.",
    "[choosing.md](../choosing.md) defines the columns.", "", *page(questions)]).rstrip() + "\n", encoding="utf-8")
