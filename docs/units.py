#!/usr/bin/env python3
"""Makes docs/measured/units.md and the units of README.md again: docs/units.py [PROGRAM [FOLDER]].

FOLDER is the root of a checkout; a test gives a copy and compares. Prices are what the program prints. What chips and scenes say is
taken from the long tables of docs/measured/chips.md and docs/measured/scenes.md.
"""
import csv, io, pathlib, subprocess, sys

program = sys.argv[1] if len(sys.argv) > 1 else 'build/hitpipe'
folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else '.')

PRICED = ['fp_slabs fp32', 'fp_plucker fp32', 'fp_plucker_direct fp32', 'int_slabs 24/24', 'int_slabs 20/24', 'int_slabs 16/16',
          'int_plucker 24/24', 'int_plucker 20/24', 'int_plucker 16/16', 'int_major 20+1/13', 'int_major 16+1/12',
          'int_major_pair 20+1/13', 'int_major_pair 16+1/12', 'fp_slabs_safe e8m23', 'fp_slabs_safe e8m15', 'fp_slabs_safe e8m7',
          'fp_slabs_safe e5m10']
IN_README = {'int_major_pair 20+1/13': 'both boxes of a BVH node, least area',
             'int_major 20+1/13': 'one box a test, from integers',
             'int_slabs 20/24': "the thesis's unit",
             'fp_slabs_safe e8m15': 'floats that must stay floats',
             'fp_slabs fp32': 'to compare with'}
THESIS = ['fp_slabs fp32', 'fp_plucker fp32', 'int_slabs 24/24', 'int_slabs 20/24', 'int_plucker 24/24', 'int_plucker 20/24']
PRICES = ['stages', 'clock_mhz', 'latency_ns', 'area_mm2', 'area_per_box_mm2', 'area_pct', 'adp_pct']


def printed(*arguments):
    out = subprocess.run([program, *arguments, '--format', 'csv'], check=True, stdout=subprocess.PIPE, text=True).stdout
    return list(csv.DictReader(io.StringIO(out)))


def price(unit, *options):
    design, bits = unit.split()
    return printed('area', design, '--bits', bits, *options)[-1]


def long_table(page, header):
    """The rows of the first table of the page whose first line begins so, each as cells by column."""
    lines = iter((folder / page).read_text().splitlines())
    split = lambda line: [cell.strip().replace('`', '') for cell in line.strip().strip('|').split('|')]
    names = split(next(line for line in lines if line.startswith(header)))
    next(lines)
    rows = []
    for line in lines:
        if not line.startswith('|'): break
        rows.append(dict(zip(names, split(line), strict=True)))
    return rows


def table(names, alignment, rows):
    line = lambda cells: '| ' + ' | '.join(str(cell) for cell in cells) + ' |\n'
    return line(names) + '|' + '|'.join(alignment) + '|\n' + ''.join(line(row) for row in rows)


chips = {(row['unit'], row['in']): row for row in long_table('docs/measured/chips.md', '| unit | in |')}
scenes = {row['scene']: row for row in long_table('docs/measured/scenes.md', '| scene | stiff')}
misses = {row['design']: row['misses'] for row in printed('list', 'designs')}
version = subprocess.run([program, '--version'], check=True, stdout=subprocess.PIPE, text=True).stdout.split(' (')[0].strip()
by = f'By `docs/units.py`, {version}.'


def share(unit, target):
    return chips[unit, target]['largest part of the chip'].split(' ')[0]


def clock(unit, target):
    mhz = chips[unit, target]['MHz, median / best of 3'].split(' / ')[0]
    return mhz if mhz[:1].isdigit() else ''


def extra(unit):
    """Of triangle tests, in %."""
    cells = [scenes[scene].get(unit, '').split(' / ')[-1].replace('-', '−') for scene in ('spheres', 'statue')]
    return ' / '.join(cells) if all(cells) else ''


def priced(unit):
    now = price(unit)
    never = 'yes' if misses[unit.split()[0]] == 'never' else 'no'
    return [unit, *(now[column] for column in PRICES), extra(unit), never]


def in_chips(unit):
    lut, dsp = (lambda target: chips[unit, target]['LUT']), (lambda target: chips[unit, target]['DSP'])
    return [unit, share(unit, 'ice40_up5k'), clock(unit, 'ice40_up5k'), share(unit, 'ice40_hx'), clock(unit, 'ice40_hx'),
            lut('ecp5'), dsp('ecp5'), clock(unit, 'ecp5'), lut('xc7'), dsp('xc7'), chips[unit, 'osu018']['mm²'], clock(unit, 'osu018')]


def in_both_accounts(unit):
    columns = ('area_mm2', 'area_pct', 'adp_mm2_ns', 'adp_pct')
    return [unit, *(price(unit, '--account', account)[column] for account in ('printed', 'built') for column in columns)]


page = f'''# The units: prices, chips, extra tests

{by} A test makes this page again and compares.

## Prices

By the thesis's 0.25 µm components (Table 7.1), with all that is emitted. Percentages are of `fp_slabs`, for each box tested in a cycle.
Prices of `fp_slabs_safe` are [estimated](../designs.md#float-operators), and so are multipliers of `int_major`. Extra tests are
triangle tests, in %, on the scenes `spheres` / `statue`, beside a software traversal of the same surface-area tree that misses no box
([all scenes](scenes.md)).

{table(['unit', 'stages', 'clock, MHz', 'latency, ns', 'area, mm²', 'area a box, mm²', '% of fp_slabs', 'area × delay, %', 'extra tests, %', 'never misses'],
       ['---'] + ['--:'] * 8 + ['---'], map(priced, PRICED))}
## In chips and cells

Without flow control. A unit above 100 % of a chip does not fit. Artix-7 is mapped by Yosys and not placed. [chips.md](chips.md#all-units-in-all-targets) has
registers, carries, both clocks, latency and HIT a second.

{table(['unit', 'UP5K, % of chip', 'MHz', 'HX8K, % of chip', 'MHz', 'ECP5: LUT', 'DSP', 'MHz', 'Artix-7: LUT', 'DSP', 'OSU: mm²', 'MHz'],
       ['---'] + ['--:'] * 11, (in_chips(unit) for unit in dict.fromkeys(unit for unit, _ in chips)))}
## Table 7.2, printed and built

The six units of the thesis's Table 7.2 in two accounts ([reproduction.md](../reproduction.md#table-72-printed-and-built)).

{table(['unit', 'printed, mm²', '%', 'area × delay, mm² ns', '%', 'built, mm²', '%', 'area × delay, mm² ns', '%'], ['---'] + ['--:'] * 8,
       map(in_both_accounts, THESIS))}'''
(folder / 'docs/measured/units.md').write_text(page)


def in_readme(unit):
    design, bits = unit.split()
    xc7 = chips[unit, 'xc7']
    return [f'`{design}` {bits}', IN_README[unit], price(unit)['area_pct'], *extra(unit).split(' / '), xc7['LUT'], xc7['DSP']]


readme = (folder / 'README.md').read_text()
begin, end = '<!-- units -->\n', '<!-- end of units -->\n'
before, _, rest = readme.partition(begin)
_, _, after = rest.partition(end)
rows = table(['unit', 'for', 'area', 'spheres', 'statue', 'LUTs', 'blocks'], ['---', '---'] + ['--:'] * 5,
             map(in_readme, IN_README))
(folder / 'README.md').write_text(before + begin + rows + end + after)
