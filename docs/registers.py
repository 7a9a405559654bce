#!/usr/bin/env python3
"""Makes the tables of registers in docs/core.md again: docs/registers.py [PROGRAM [FOLDER]].

FOLDER is the root of a checkout; a test gives a copy and compares. The tables are what the manifest of a core with
cache and rings says.
"""
import json, pathlib, re, subprocess, sys, tempfile

program = sys.argv[1] if len(sys.argv) > 1 else 'build/hitpipe'
page = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else '.') / 'docs/core.md'
OF_FEATURE = {'always': '', 'cache': 'with a cache: ', 'rings': 'with rays in memory: '}


def registers():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, 'core', 'rtl', '--cache', '16', '--rings', '--door', 'float', '--name', 'core', '--out', folder],
                       check=True, stdout=subprocess.DEVNULL)
        return json.loads((pathlib.Path(folder) / 'core.json').read_text())['registers']


def places(field):
    low, high = field['low'], field['low'] + field['width'] - 1
    return f'{low}' if low == high else f'{low}-{high}'


def meaning(field):
    return OF_FEATURE[field.get('feature', 'always')] + field.get('sentence', '')


def text(register):
    """What a row says: the sentence of the register, and what its fields add to it."""
    said = [(OF_FEATURE['cache'] if register['feature'] == 'cache' else '') + register['sentence']]
    fields = register['fields']
    if len(fields) == 1 and fields[0]['access'] == 'constant':
        said[0] += f', {fields[0]["reset"]:#x}'
    if register['name'] != 'STATUS' and len(fields) > 1:
        said += [f'{places(field)}: {meaning(field)}' for field in fields]
    for field in fields:
        if field['access'] == 'rw' and field['reset']: said.append(f'{field["reset"]:#x} after a reset')
        if field.get('cleared_softly'): said.append('A soft reset makes it 0')
    return '. '.join(said)


def rows(chosen):
    yield '| address | register | bits | access | what it says |'
    yield '|---|---|---|---|---|'
    for each in chosen:
        fields = each['fields']
        bits = f'{fields[0]["low"]}-{fields[-1]["low"] + fields[-1]["width"] - 1}' if fields else 'none'
        access = ', '.join(dict.fromkeys(field['access'] for field in fields)) or 'constant'
        yield f'| {each["address"]:#04x} | `{each["name"]}` | {bits} | {access} | {text(each)} |'


def status(chosen):
    yield '| bit of the status | name | access | what it says |'
    yield '|---|---|---|---|'
    for field in next(each for each in chosen if each['name'] == 'STATUS')['fields']:
        yield f'| {places(field)} | `{field["name"]}` | {field["access"]} | {meaning(field)} |'


all_of_them = registers()
made = page.read_text()
for part, lines in {'registers': rows(each for each in all_of_them if each['feature'] != 'rings'),
                    'status': status(all_of_them),
                    'registers of rings': rows(each for each in all_of_them if each['feature'] == 'rings')}.items():
    table = '\n'.join(lines)
    made, count = re.subn(rf'(<!-- {part} -->\n).*?(\n<!-- end of {part} -->)', lambda found: found[1] + table + found[2], made,
                          flags=re.S)
    if count != 1: sys.exit(f'{page} has no table of {part}')
page.write_text(made)
