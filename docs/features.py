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
# What all cores have stands above the table.
put('formal.md', 'features', ['option', 'promise', 'shown by'],
    [(f'`{without_number(feature["option"])}`', each['what'],
      f'the proof of `{each["machine"]}` {each["bits"]}' if 'bits' in each else f'a test: `{each["test"]}`')
     for feature in features if feature['option'] for each in feature['promises']])
