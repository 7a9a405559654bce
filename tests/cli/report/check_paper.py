#!/usr/bin/env python3
"""The breaks between printed pages: no page but the last is half empty, and no heading stands alone at the foot of a page:
check_paper.py PAGE.html PAGE.pdf"""
import html
import re
import subprocess
import sys

page = open(sys.argv[1], encoding="utf-8").read()
headings = {html.unescape(re.sub("<[^>]*>", "", text)).strip() for text in re.findall(r"<h[23][^>]*>(.*?)</h[23]>", page)}
words = re.compile(r'<word [^>]*yMin="([\d.]+)"[^>]*yMax="([\d.]+)">(.*?)</word>')
boxes = subprocess.run(["pdftotext", "-bbox-layout", sys.argv[2], "-"], check=True, capture_output=True, text=True).stdout
pages = re.findall(r'<page [^>]*height="([\d.]+)">(.*?)</page>', boxes, re.S)
faults = [] if len(pages) > 2 else [f"{len(pages)} pages"]
for number, (height, text) in enumerate(pages, 1):
    lines = [[(float(top), float(bottom), html.unescape(word)) for top, bottom, word in words.findall(line)]
             for line in re.findall(r"<line [^>]*>(.*?)</line>", text, re.S)]
    last = max(lines, key=lambda line: line[-1][1], default=None)
    if last is None:
        faults.append(f"page {number} is empty")
        continue
    if " ".join(word for _, _, word in last) in headings:
        faults.append(f"a heading at the foot of page {number}: {' '.join(word for _, _, word in last)}")
    if number < len(pages) and last[-1][1] < 0.6 * float(height):
        faults.append(f"page {number} ends after {100 * last[-1][1] / float(height):.0f} % of its height")
print(f"{len(pages)} pages, {len(faults)} faults", *faults, sep="\n")
sys.exit(1 if faults else 0)
