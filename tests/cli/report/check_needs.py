#!/usr/bin/env python3
"""What a scene does not need, as a report has it: the answer has the figures of the files, and each cut is on the page with its
share and its reason: check_needs.py FOLDER of the report."""
import csv
import html
import pathlib
import re
import sys

OUT = pathlib.Path(sys.argv[1])
NUMBER = r"([\d.,]*\d)"
faults: list[str] = []


def expect(holds: object, what: str) -> None:
    """Notes what does not hold."""
    if not holds:
        faults.append(what)


def rows_of(file: str) -> list[dict[str, str]]:
    """Of a table of the report."""
    return list(csv.DictReader((OUT / file).open(newline="")))


def near(shown: str, kept: str, digits: int) -> bool:
    """Whether so many digits are shown."""
    return abs(float(shown.replace(",", "")) - float(kept)) <= 0.51 * 10.0 ** (1 - digits) * abs(float(kept))


page = (OUT / "index.html").read_text()
asked = html.unescape(page[page.index('<h2 id="needs">'):])
fitted = rows_of("fitted.csv")
cheapest = min(fitted, key=lambda row: float(row["whole_area_run_time_mm2_ms"]))
scene, (usual, core) = rows_of("core_scenes.csv")[0], rows_of("core_fit.csv")
found = re.search(rf"leaves out {NUMBER} % of the area .*? with {NUMBER} % \(95 %: .*? A core .*? has {NUMBER} % less logic .*? and "
                  rf"{NUMBER} % \(95 %: {NUMBER} to {NUMBER}\) of its rays", asked)
expect(found, asked[:800])
if found:
    less = 100 - 100 * float(core["area_mm2"]) / float(usual["area_mm2"])
    expect(near(found[1], cheapest["area_saved_pct"], 3) and near(found[2], cheapest["extra_box_tests_pct"], 3), found[0])
    expect(abs(float(found[3]) - less) <= 0.51 and near(found[6], scene["other_triangles_pct_high"], 2), found[0])
expect(float(scene["other_triangles_pct_high"]) <= 0.05 and int(scene["compared"]) > 10_000, f"{scene}")
for file in ("left_out.csv", "core_left_out.csv"):
    cuts = rows_of(file)
    expect(len(cuts) > 2, f"{file} has {len(cuts)} cuts")
    for cut in cuts:
        expect(cut["why"] and cut["left_out"] in asked and cut["why"] in asked, f"{file}: {cut} is not on the page")
marks = rows_of("whole_area_run_time.csv")
for row in fitted:
    cost = "whole_area_run_time_mm2_ms"
    expect(any(mark["unit"].endswith("fitted") and mark[cost] == row[cost] for mark in marks), f"no mark: {row}")
    swept = [float(mark[cost]) for mark in marks if mark["design"] == row["design"] and "fitted" not in mark["unit"]]
    expect(float(row[cost]) <= min(swept), f"{row['design']}: fitted costs {row[cost]}, swept {min(swept)}")
print(*faults, sep="\n")
sys.exit(1 if faults else 0)
