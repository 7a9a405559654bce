#!/usr/bin/env python3
"""prices.py PROGRAM SOURCE: prices on the pages are what `hitpipe area` prints today.

docs/designs.md has rows of designs and formats, docs/reproduction.md Table 7.2 in both accounts, and README.md the area of
each unit that it recommends. Whether a design may miss a box is as `hitpipe list designs` says.
"""
import csv, io, pathlib, re, subprocess, sys

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
wrong = 0


def rows(*arguments):
    out = subprocess.run([program, *arguments, '--format', 'csv'], check=True, stdout=subprocess.PIPE, text=True).stdout
    return list(csv.DictReader(io.StringIO(out)))


def price(design, bits, *options):
    return rows('area', design, '--bits', bits, *options)[-1]


def same(page, unit, column, kept, now):
    global wrong
    if kept == now: return
    wrong += 1
    print(f'{page}: {unit}: {column} is {now}, not {kept}')


def cells(page, start):
    """The rows of the page that match, each as its cells without blanks around them and without backticks."""
    for line in (source / page).read_text().splitlines():
        if re.match(start, line): yield [cell.strip().replace('`', '') for cell in line.strip().strip('|').split('|')]


def number_of(kept, page, least):
    global wrong
    if len(kept) >= least: return
    wrong += 1
    print(f'{page}: only {len(kept)} rows of prices were found')


misses = {row['design']: row['misses'] for row in rows('list', 'designs')}
never = {design: 'yes' if answer == 'never' else 'no' for design, answer in misses.items()}
columns = ('stages', 'clock_mhz', 'latency_ns', 'area_mm2', 'area_per_box_mm2', 'area_pct', 'adp_pct')

kept = list(cells('docs/designs.md', r'\| `\w+` \| [^|]+ \| \d+ \|'))
number_of(kept, 'docs/designs.md', 12)
for design, bits, *figures, _, answer in kept:
    now = price(design, bits)
    for column, figure in zip(columns, figures): same('docs/designs.md', f'{design} {bits}', column, figure, now[column])
    same('docs/designs.md', f'{design} {bits}', 'never misses', answer, never[design])

kept = list(cells('README.md', r'\| `\w+` [^|]+ \| \d+ \|'))
number_of(kept, 'README.md', 5)
for unit, area, *_ in kept:
    design, bits = unit.split()
    same('README.md', unit, 'area_pct', area, price(design, bits)['area_pct'])
    same('README.md', unit, 'never misses', 'no' if design == 'fp_slabs' else 'yes', never[design])

kept = list(cells('docs/reproduction.md', r'\| (fp|int)_\w+ \S+ \| \d'))
number_of(kept, 'docs/reproduction.md', 6)
for unit, *figures in kept:
    design, bits = unit.split()
    for account, four in (('printed', figures[:4]), ('built', figures[4:])):
        now = price(design, bits, '--account', account)
        for column, figure in zip(('area_mm2', 'area_pct', 'adp_mm2_ns', 'adp_pct'), four):
            same('docs/reproduction.md', f'{unit}, {account}', column, figure, now[column])
sys.exit(wrong > 0)
