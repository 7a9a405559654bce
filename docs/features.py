#!/usr/bin/env python3
"""Makes the table of faults in docs/core.md and that of features in docs/formal.md again: docs/features.py [PROGRAM [FOLDER]].

FOLDER is the root of a checkout; a test gives a copy and compares. The tables are what `hitpipe list features` says.
"""
import json, pathlib, re, subprocess, sys

program = sys.argv[1] if len(sys.argv) > 1 else 'build/hitpipe'
docs = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else '.') / 'docs'
features = json.loads(subprocess.check_output([program, 'list', 'features', '--format', 'json']))


def put(name, part, head, rows):
    page = docs / name
    table = '\n'.join([f'| {" | ".join(head)} |', '|' + '---|' * len(head), *(f'| {" | ".join(row)} |' for row in rows)])
    made, count = re.subn(rf'(<!-- {part} -->\n).*?(\n<!-- end of {part} -->)', lambda found: found[1] + table + found[2],
                          page.read_text(), flags=re.S)
    if count != 1: sys.exit(f'{page} has no table of {part}')
    page.write_text(made)


def without_number(option):
    return re.sub(r' (\d+|\S*,\S*)$', '', option)


put('core.md', 'failures', ['what goes wrong', 'what you see'],
    [(each['what'], each['shows']) for feature in features for each in feature.get('failures', [])])
# No feature of their own.
widths = [('fewer bits', 'the six machines that know them', 'the core with them'),
          ('`--data-bits 64`, `512`, `--in-order`', '`beats`, of 64 and 512 bits; `core_axi` of 64 bits', 'the core with 512')]
put('formal.md', 'features', ['option', 'proved', 'only tested'],
    [(f'`{without_number(each["option"])}`', each['proved'], each['tested']) for each in features if each['proved']] + widths)
