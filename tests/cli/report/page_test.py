#!/usr/bin/env python3
"""A small report: each number of its tables is the one of the CSV file that it names, the recommended units are the
cheapest, a killed report goes on to the same files, and a file that changed is made again: page_test.py PROGRAM."""
import csv
import html
import html.parser
import io
import json
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time

PROGRAM = sys.argv[1]
OPTIONS = ["report", "int_slabs,fp_slabs", "--scene", "spheres", "--width", "8", "--height", "8", "--bits", "6/6,20/24",
           "--tests", "600", "--without", "core,fit,schematics"]
faults: list[str] = []


def expect(holds: object, what: str) -> None:
    """Notes what does not hold."""
    if not holds:
        faults.append(what)


def report(out: pathlib.Path, *more: str) -> subprocess.CompletedProcess[str]:
    """Runs a report to its end."""
    return subprocess.run([PROGRAM, *OPTIONS, *more, "--out", str(out)], capture_output=True, text=True, check=False)


class Tables(html.parser.HTMLParser):
    """The cells of each table: file, row, place in the file, text."""

    def __init__(self) -> None:
        super().__init__()
        self.cells: list[tuple[str, int, str, str]] = []
        self.file, self.row, self.at, self.inside = "", 0, "", False

    def handle_starttag(self, tag, attrs):
        of = dict(attrs)
        if tag == "table":
            self.file = of["data-file"]
        self.row += tag == "tr"
        if tag == "td":
            self.inside, self.at = True, of.get("data-at", "")
            self.cells.append((self.file, self.row, self.at, ""))

    def handle_data(self, data):
        if self.inside:
            self.cells[-1] = (*self.cells[-1][:3], self.cells[-1][3] + data)

    def handle_endtag(self, tag):
        self.inside = self.inside and tag != "td"


def same(shown: str, kept: str, least: int) -> bool:
    """Whether so many digits of the number or more, or all of the text, are shown."""
    try:
        a, b = float(shown.replace(",", "")), float(kept)
    except ValueError:
        return shown == kept.removeprefix("n") or shown == kept
    return abs(a - b) <= 0.51 * 10.0 ** (1 - least) * abs(b)


def check_numbers(out: pathlib.Path) -> None:
    """Of all tables."""
    page = Tables()
    page.feed((out / "index.html").read_text())
    lines = {file: [[], *csv.reader((out / file).open(newline=""))] for file in {cell[0] for cell in page.cells}}
    numbers = 0
    lines_of_row = {row: at.split(":")[0] for _, row, at, _ in page.cells if at}
    for file, row, at, text in page.cells:
        if not at:
            if re.fullmatch(r"[\d.,]+", text):
                expect(text == lines_of_row[row], f"{text} of a row for line {lines_of_row[row]} comes from no file")
            continue
        places = at.split()
        shown = [text] if len(places) == 1 else re.findall(r"[^ ()]*\d[^ ()]*", text)
        expect(len(shown) == len(places), f"{text} comes from {at}")
        for part, place in zip(shown, places):
            line, column = place.split(":")
            kept = lines[file][int(line)][lines[file][1].index(column)]
            numbers += re.match(r"[\d-]", part) is not None
            expect(same(part, kept, 2 if column.endswith(("_low", "_high")) else 3), f"{file} line {line}, {column}: {part} for {kept}")
    expect(numbers > 300, f"only {numbers} numbers")
    expect(set(lines) == {f"{name}.csv" for name in ("rows", "pictures", "pipelines", "stability", "moved", "integer_world")},
           f"tables of {set(lines)}")


def check_recommendation(out: pathlib.Path) -> None:
    """The units of the first table are the cheapest."""
    rows = [row for row in csv.DictReader((out / "rows.csv").open(newline="")) if row["rays_in_flight"] == "32"]
    page = (out / "index.html").read_text()
    for what, column, most in (("of all", "whole_area_run_time_mm2_ms", 1e9), ("alone", "area_run_time_mm2_ms", 1e9),
                               ("at most 1 %", "whole_area_run_time_mm2_ms", 1)):
        allowed = [row for row in rows if float(row["extra_box_tests_pct"]) <= most]
        best = min(allowed, key=lambda row, of=column: float(row[of]))
        name = best["design"] + ("" if best["bits"] == "fp32" else " " + best["bits"].removeprefix("n"))
        found = re.search(rf"<td[^>]*>([^<]*)</td><td[^>]*>Least [^<]*{what}[^<]*</td>", page)
        expect(found and found[1] == name, f"{what}: {found and found[1]} is recommended, {name} is the cheapest")


def digits(text: str) -> float:
    """A number of a sentence."""
    return float(text.replace(",", ""))


def check_answers(out: pathlib.Path) -> None:
    """The first sentences have the figures of the files."""
    page = (out / "index.html").read_text()
    leads = [html.unescape(lead) for lead in re.findall(r'<p class="lead">(.*?)</p>', page)]
    number = r"([\d.,]*\d)"
    rows = [row for row in csv.DictReader((out / "rows.csv").open(newline="")) if row["rays_in_flight"] == "32"]
    best = min(rows, key=lambda row: float(row["whole_area_run_time_mm2_ms"]))
    found = re.match(rf"The unit {best['design']} .*?costs least, {number} .*? with {number} % \(95 %: {number} to {number}\)", leads[0])
    expect(found, leads[0])
    for shown, column, least in zip(found.groups() if found else (), (
            "whole_area_run_time_mm2_ms", "extra_box_tests_pct", "extra_box_tests_pct_low", "extra_box_tests_pct_high"), (3, 3, 2, 2)):
        expect(same(shown, best[column], least), f"{column}: {shown} for {best[column]}")
    judged = [row for row in csv.DictReader((out / "stability.csv").open(newline="")) if row["category"] == "all"]
    expect({(row["design"], row["bits"]) for row in judged} == {(row["design"], row["bits"]) for row in rows},
           f"judged are {[(row['design'], row['bits']) for row in judged]}")
    safe = [row for row in judged if row["design"] != "fp_slabs"]
    found = re.match(rf"None of {number} units that must not miss missed one of {number} boxes .*? at most {number} in a million", leads[1])
    expect(found, leads[1])
    if found:
        expect(int(found[1]) == len(safe) and digits(found[2]) == sum(int(row["exact_hits"]) for row in safe), leads[1])
        expect(same(found[3], str(max(1e4 * float(row["false_miss_pct_high"]) for row in safe)), 2), leads[1])


def check_files(out: pathlib.Path) -> None:
    """Each picture in each form, its values beside it; nothing that was left out; no temporary file."""
    names = {file.name for file in out.iterdir()}
    drawn = {name[:-4] for name in names if name.endswith(".svg")}
    expect({"error_area", "error_run_time", "whole_area_run_time", "memory", "occupancy", "stiffness_int_slabs",
            "integer_world_plot"} <= drawn, f"drawn are {drawn}")
    for name in drawn:
        for kind in ("pdf", "png", "csv"):
            of = "stiffness" if kind == "csv" and name.startswith("stiffness_") else name
            expect(f"{of}.{kind}" in names, f"no {of}.{kind}")
    more = [name for name in names if name.startswith((".", "core", "fitted", "schematics"))]
    expect(not more, f"there are {more}")
    page = (out / "index.html").read_text()
    expect('id="needs"' not in page and "<h3>The core</h3>" not in page, "the page has a section that was left out")
    values = list(csv.DictReader((out / "error_area.csv").open(newline="")))
    rows = {(r["design"], r["bits"]): r for r in csv.DictReader((out / "rows.csv").open(newline=""))}
    front = [v for v in values if v["on_front"] == "1"]
    for v in values:
        expect(v["area_per_box_mm2"] == rows[v["design"], v["bits"]]["area_per_box_mm2"], f"error_area.csv: {v}")
        below = [f for f in values if float(f["area_per_box_mm2"]) < float(v["area_per_box_mm2"]) and
                 max(0, float(f["extra_box_tests_pct"])) < max(0, float(v["extra_box_tests_pct"]))]
        expect(v not in front or not below, f"{v} is not on the front")
    svg = (out / "error_area.svg").read_text()
    for v in front:
        expect(f">{v['unit']}</text>" in svg, f"error_area.svg does not name {v['unit']}")


def ended(out: pathlib.Path) -> bool:
    """Whether, after a moment, no process works for this folder."""
    for _ in range(200):
        lines = []
        for file in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
            try:
                lines.append(file.read_bytes())
            except OSError:  # it has ended meanwhile
                continue
        if not any(f"{out}/".encode() in line for line in lines):
            return True
        time.sleep(0.05)
    return False


def check_stopped(folder: pathlib.Path) -> None:
    """A signal to the report ends its command too, and a line says that the same command goes on."""
    for number, out in ((signal.SIGTERM, folder / "terminated"), (signal.SIGINT, folder / "interrupted")):
        running = subprocess.Popen([PROGRAM, *OPTIONS, "--threads", "1", "--out", str(out)], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        while running.poll() is None and not (out / "rows.csv").exists():
            time.sleep(0.005)
        running.send_signal(number)
        _, said = running.communicate()
        expect(running.returncode == -number, f"it ended with {running.returncode} by signal {number}")
        last = f"hitpipe: stopped; the same command keeps what is done in {out}"
        expect(said.splitlines()[-1:] == [last], f"it said: {said}")
        expect(ended(out), f"a command goes on after signal {number}")


def check_killed(whole: pathlib.Path, out: pathlib.Path) -> None:
    """Killed when some steps are done, it makes the others and keeps these."""
    running = subprocess.Popen([PROGRAM, *OPTIONS, "--out", str(out)], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    steps = out / "steps.json"
    while running.poll() is None and not (steps.exists() and "pipelines.csv" in json.loads(steps.read_text())):
        time.sleep(0.005)
    expect(running.poll() is None, "it ended before it was killed")
    running.send_signal(signal.SIGKILL)
    running.wait()
    expect(ended(out), "a command goes on after the kill")
    done = list(json.loads(steps.read_text()))
    expect(not (out / "index.html").exists(), "the page was there already")
    again = report(out)
    expect(again.returncode == 0, again.stderr)
    kept = re.findall(r"^(\S+): kept, made by the same command$", again.stderr, re.M)
    expect(kept == done, f"done were {done}, kept are {kept}")
    timed = {"rows.csv", "rows.csv-metadata.json", "integer_world.csv-metadata.json", "pictures.csv", "index.html",
             "steps.json", "csv-metadata.json",
             *(f"error_software_time.{kind}" for kind in ("svg", "pdf", "png", "csv"))}
    names = {file.name for file in whole.iterdir() if file.is_file()}
    expect(names == {file.name for file in out.iterdir() if file.is_file()}, "other files")
    for name in names - timed:
        expect((whole / name).read_bytes() == (out / name).read_bytes(), f"{name} differs after the kill")


def check_kept(out: pathlib.Path) -> None:
    """A step whose file has changed, or whose command has, is made again; the others are not."""
    right = (out / "pipelines.csv").read_bytes()
    (out / "pipelines.csv").write_bytes(right.replace(b"int_slabs", b"other"))
    again = report(out, "--seed", "2")
    kept = set(re.findall(r"^(\S+): kept", again.stderr, re.M))
    expect(kept == {"rows.csv", "pictures.csv", "integer_world.csv", "moved.json"}, f"kept are {kept}")
    expect((out / "pipelines.csv").read_bytes() == right, "pipelines.csv is not made again")
    expect("--seed 2" in (out / "index.html").read_text(), "the page has another command")


def commands_of(out: pathlib.Path, section: str) -> list[list[str]]:
    """What the page prints at the section's end."""
    page = (out / "index.html").read_text()
    found = re.search(rf'<h2 id="{section}">.*?<pre[^>]*>(.*?)</pre>', page, re.S)
    return [shlex.split(html.unescape(line)) for line in found[1].splitlines()]


def rows_of(text: str) -> list[dict[str, str]]:
    """Of CSV, without empty cells."""
    return [{k: v for k, v in row.items() if v} for row in csv.DictReader(io.StringIO(text))]


def json_rows(text: str) -> list[dict[str, str]]:
    """Of JSON, as a table has them."""
    return [{k: re.sub(r"^(?=\d+/\d+$)", "n", str(v)) for k, v in row.items() if v is not None} for row in json.loads(text)]


def check_commands(out: pathlib.Path, section: str, file: str, most: int, of: str) -> None:
    """The commands of the page that begin so print the rows of the file."""
    commands = [words for words in commands_of(out, section) if shlex.join(words[1:]).startswith(of)]
    expect(commands, f"{section} has no commands")
    kept = rows_of((out / file).read_text())
    for words in commands[:most]:
        expect(words[0] == "hitpipe", str(words))
        made = subprocess.run([PROGRAM, *words[1:]], capture_output=True, text=True, check=False)
        rows = json_rows(made.stdout) if words[-1] == "json" else rows_of(made.stdout)
        expect(rows, f"{words} prints nothing: {made.stderr}")
        for row in rows:
            expect(any(row.items() <= line.items() for line in kept), f"{file} has no row {row} of {words}")


def check_given(folder: pathlib.Path, whole: pathlib.Path) -> None:
    """Rows that are there make the page, at another cost too; those of another scene are refused."""
    options = [word for word in OPTIONS if word not in ("int_slabs,fp_slabs", "--bits", "6/6,20/24", "--without",
                                                        "core,fit,schematics")]
    rows = folder / "given.csv"
    rows.write_bytes((whole / "rows.csv").read_bytes())
    most = "--without=images,stability,stiff,world,core,fit,schematics"
    made = subprocess.run([PROGRAM, *options, most, "--rows", str(rows), "--triangle-ns", "4", "--triangle-mm2", "2.5",
                           "--plot-width", "84mm", "--out", str(folder / "given")], capture_output=True, text=True,
                          check=False)
    expect(made.returncode == 0, made.stderr)
    before, after = (list(csv.DictReader(file.open(newline=""))) for file in (rows, folder / "given/rows.csv"))
    for a, b in zip(before, after, strict=True):
        expect(a["run_time_ms"] == b["run_time_ms"] and a["whole_run_time_ms"] != b["whole_run_time_ms"], str(b))
    expect("is taken as 4 ns of a unit of 2.5 mm²" in (folder / "given/index.html").read_text(), "the cost is not told")
    expect('width="238.11' in (folder / "given/error_area.svg").read_text(), "the width is another")
    expect((folder / "given/error_area.csv").read_bytes() == (whole / "error_area.csv").read_bytes(), "other areas")
    other = subprocess.run([PROGRAM, *options, most, "--rows", str(rows), "--fov", "30", "--out", str(folder / "no")],
                           capture_output=True, text=True, check=False)
    expect(other.returncode == 2 and "give another file or remove it" in other.stderr, other.stderr)
    expect(not (folder / "no").exists(), "a refused report made its folder")


def check_more(out: pathlib.Path) -> None:
    """Intervals and the core, each with its picture."""
    words = [word if word != "core,fit,schematics" else "images,pipelines,stability,stiff,world,fit,schematics"
             for word in OPTIONS]
    made = subprocess.run([PROGRAM, *words, "--ii", "1,3", "--out", str(out)], capture_output=True, text=True,
                          check=False)
    expect(made.returncode == 0 and "wrong_core_answers   0\n" in made.stdout, f"{made.stdout}{made.stderr}")
    rates = [row for row in csv.DictReader((out / "area_rate.csv").open(newline="")) if row["line"] == "int_slabs 20/24"]
    rates.sort(key=lambda row: float(row["x"]))
    expect(len(rates) == 2 and float(rates[0]["y"]) < float(rates[1]["y"]), f"a rarer test takes less area: {rates}")
    core = list(csv.DictReader((out / "core.csv").open(newline="")))
    expect(len(core) == 46 and all(row["wrong"] == "0" for row in core), f"{len(core)} rows of cores")
    usual = {"bits": "20+1s20", "triangle_ii": "4", "memory": "ideal", "latency": "100", "cache_kib": "0",
             "rays_in_flight": "128"}
    value = lambda column, **of: next(  # noqa: E731
        float(row[column]) for row in core if all(row[k] == v for k, v in {**usual, **of}.items()))
    for latency in ("20", "100", "200"):
        expect(2 * value("port_busy_pct", latency=latency, rays_in_flight="8") < value("port_busy_pct", latency=latency),
               f"more rays keep the port no busier at {latency}")
    expect(value("bytes_a_ray", cache_kib="64") < 0.9 * value("bytes_a_ray"), "a cache saves nothing")
    check_commands(out, "bits", "core.csv", 2, "core trace")


def check_refused(folder: pathlib.Path) -> None:
    """One line, and nothing is made."""
    out = folder / "none"
    (folder / "empty").mkdir()
    for more, said, variables in (
            (["--image-design", "fp_slabs"], "design fp_slabs: can miss boxes; give a design that never does", {}),
            (["--without", "all"], "--without: no section all; there are: pipelines, world, core, stability, stiff, fit, "
             "images, schematics", {}),
            (["--plot-width", "84"], "--plot-width: 84 is no width from 40mm to 400mm, such as 84mm, 3.3in or 240pt", {}),
            (["--rows", "none.csv"], "design excludes --rows: the rows of the file have their designs", {}),
            ([], "report: no python3 with matplotlib and jinja2 was found; install the packages python3-matplotlib and "
             "python3-jinja2 or set PYTHON to the program", {"PYTHON": "/bin/false"})):
        made = subprocess.run([PROGRAM, *OPTIONS, *more, "--out", str(out)], capture_output=True, text=True,
                              check=False, env={**os.environ, **variables})
        expect(made.returncode == 2 and made.stdout == "" and made.stderr.startswith("hitpipe: " + said) and
               made.stderr.count("\n") == 1, f"{more}: {made.returncode} {made.stderr}")
        expect(not out.exists(), f"{more} made the folder")


with tempfile.TemporaryDirectory() as name:
    base = pathlib.Path(name)
    first = report(base / "whole")
    expect(first.returncode == 0 and first.stderr == "", f"{first.returncode}: {first.stderr}")
    expect(re.fullmatch(r"page +\S+index.html\nrows +\d+\n([a-z_]+ +0\n){4}", first.stdout), first.stdout)
    check_numbers(base / "whole")
    check_recommendation(base / "whole")
    check_answers(base / "whole")
    check_files(base / "whole")
    check_stopped(base)
    check_killed(base / "whole", base / "killed")
    check_commands(base / "whole", "bits", "pipelines.csv", 100, "area")
    check_commands(base / "whole", "stable", "stability.csv", 100, "check int_slabs,fp_slabs")
    check_given(base, base / "whole")
    check_more(base / "more")
    check_kept(base / "whole")
    check_refused(base)
for fault in faults:
    print(fault)
sys.exit(1 if faults else 0)
