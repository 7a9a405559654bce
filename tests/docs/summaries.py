#!/usr/bin/env python3
"""summaries.py SOURCE: short tables on the pages agree with the long tables that they are taken from.

docs/chips.md has for each unit the shares, clocks and counts of docs/measured/chips.md. README.md has for each unit that it
recommends the extra triangle tests of docs/choosing.md on spheres and statue, and its place on two chips.
"""
import pathlib, re, sys

source = pathlib.Path(sys.argv[1])
wrong = 0


def table(page, header):
    """The rows of the first table of the page whose first line begins so, each as cells by column name."""
    lines = iter((source / page).read_text().splitlines())
    for line in lines:
        if line.startswith(header): break
    names = [cell.strip() for cell in line.strip('|').split('|')]
    next(lines)
    rows = []
    for line in lines:
        if not line.startswith('|'): return rows
        rows.append([cell.strip().replace('`', '') for cell in line.strip().strip('|').split('|')])
        if len(rows[-1]) != len(names): sys.exit(f'{page}: not {len(names)} cells: {line}')
    return rows


def same(page, what, kept, whole):
    global wrong
    if kept == whole: return
    wrong += 1
    print(f'{page}: {what}: {kept}, and the whole table says {whole}')


def rounded(text):
    return f'{float(text):.0f}' if text else ''


chips = {(row[0], row[1]): row for row in table('docs/measured/chips.md', '| unit | in |')}
share = lambda row: row[6].split(' ')[0]
clock = lambda row: '' if row[7].startswith(('does', 'not')) else row[7].split(' / ')[0]
short = table('docs/chips.md', '| unit | UP5K')
for unit, *cells in short:
    up5k, hx, ecp5, xc7, osu = (chips[unit, target] for target in ('ice40_up5k', 'ice40_hx', 'ecp5', 'xc7', 'osu018'))
    whole = [share(up5k), clock(up5k), share(hx), clock(hx), ecp5[2], ecp5[4], clock(ecp5), xc7[2], xc7[4], osu[8], clock(osu)]
    same('docs/chips.md', unit, cells, whole)
same('docs/chips.md', 'units', len(short), len(chips) // 5)

scenes = {row[0]: row for row in table('docs/choosing.md', '| scene | stiff')}
names = next(line for line in (source / 'docs/choosing.md').read_text().splitlines() if line.startswith('| scene | stiff'))
names = [name.strip() for name in names.strip('|').split('|')]
readme = table('README.md', '| unit, format |')
# Units that fit a UP5K with another clock or rate, with the logic cells and the clock that they then have.
otherwise, unit, chip = {}, '', ''
for row in table('docs/chips.md', '| unit | in | N |'):
    unit, chip = row[0] or unit, row[1] or chip
    cells, mhz = row[4].replace(',', ''), row[5]
    if chip == 'UP5K' and mhz:
        otherwise.setdefault(unit, []).append(f'{100 * int(cells) / 5280:.0f} %, {rounded(mhz)}')
for unit, _, extra, on_up5k, on_ecp5, on_artix in readme:
    if unit in names:
        both = [scenes[scene][names.index(unit)].split(' / ')[1] for scene in ('spheres', 'statue')]
        kept = [cell.replace('−', '-') for cell in extra.split(' / ')]
        half_digit = [0.5 / 10 ** len(cell.partition('.')[2]) for cell in kept]
        if any(abs(float(a) - float(b)) > half + 1e-9 for a, b, half in zip(kept, both, half_digit)):
            same('README.md', f'{unit}, extra tests', kept, both)
    else:
        same('README.md', f'{unit}, extra tests', extra, 'not measured')
    row = chips[unit, 'ice40_up5k']
    fits = [f'{share(row)} %, {rounded(clock(row))}'] if clock(row) else otherwise.get(unit, ['does not fit'])
    if on_up5k.split(' (')[0] not in fits: same('README.md', f'{unit} on UP5K', on_up5k, fits)
    for chip, kept in (('ecp5', on_ecp5), ('xc7', on_artix)):
        row = chips[unit, chip]
        placed = f', {rounded(clock(row))}' if clock(row) else ''
        same('README.md', f'{unit} in {chip}', kept, f'{row[2]}, {row[4]}{placed}')
if len(readme) < 5: wrong += 1
sys.exit(wrong > 0)
