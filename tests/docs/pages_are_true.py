#!/usr/bin/env python3
"""pages_are_true.py PROGRAM SOURCE: runs the commands of README.md and docs/*.md and compares.

A block ```console holds commands behind "$ " and the lines that they print. All blocks of a page run in one new folder, where
build/hitpipe is PROGRAM. A block ```cpp behind a line <!-- from PATH --> must stand in SOURCE/PATH, at any indentation. If one begins
with #pragma once, the blocks of that path are together all of the file below its first comment. A sum of numbers with its result, such
as 31 / 4 = 7.75, is exact.
"""
import pathlib, re, shutil, subprocess, sys, tempfile
from fractions import Fraction

NUMBER = r'[−-]?\d[\d,]*(?:\.\d+)?'
SUM = re.compile(rf'(?<![\w.^=·+/%)(−-])((?:\(?{NUMBER}\)?(?:\s*[·+/−-]\s*|\s*))+?)\s*=\s*({NUMBER})(?![\w.^]|\s*[·/^])')


def blocks(text, language):
    return re.finditer(r'(?:<!-- from (\S+) -->\n)?^```' + language + r'\n(.*?)^```$', text, re.M | re.S)


def steps(block):
    for part in re.split(r'^\$ ', block, flags=re.M)[1:]:
        command, _, printed = part.partition('\n')
        yield command, printed


def sums(text):
    """Each sum with its printed and its exact result."""
    for found in SUM.finditer(re.sub(r'^```.*?^```$', '', text, flags=re.M | re.S)):
        terms = found[1].strip().replace('−', '-').replace('·', '*').replace(',', '')
        if re.search(r'[-+*/]', terms[1:]):
            exact = eval(re.sub(r'[\d.]+', r"Fraction('\g<0>')", terms), {'Fraction': Fraction})
            yield found[0], found[2].replace('−', '-').replace(',', ''), exact


def unindented(text):
    return '\n'.join(line.strip() for line in text.strip().splitlines())


def main():
    program, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    ran = wrong = checked = 0
    for page in [source / 'README.md', *sorted((source / 'docs').glob('*.md'))]:
        text = page.read_text()
        folder = pathlib.Path(tempfile.mkdtemp())
        try:
            (folder / 'build').mkdir()
            (folder / 'build/hitpipe').symlink_to(program)
            for block in blocks(text, 'console'):
                for command, expected in steps(block[2]):
                    if command.startswith(('git clone', 'make build', 'make demo', 'make test')): continue  # these make PROGRAM
                    result = subprocess.run(['bash', '-c', command], cwd=folder, stdout=subprocess.PIPE,
                                            stderr=subprocess.PIPE, text=True)
                    ran += 1
                    if result.returncode != 0 or result.stdout != expected:
                        wrong += 1
                        print(f'{page.relative_to(source)}: $ {command}\nprints (exit code {result.returncode})\n{result.stdout}{result.stderr}and the page says\n{expected}')
        finally:
            shutil.rmtree(folder)
        for whole, printed, exact in sums(text):
            checked += 1
            if Fraction(printed) != exact:
                wrong += 1
                print(f'{page.relative_to(source)}: {whole}: it is {float(exact)}')
        listed = {}
        for block in blocks(text, 'cpp'):
            if block[1] is None: continue
            listed.setdefault(block[1], []).append(block[2])
            ran += 1
            if unindented(block[2]) not in unindented((source / block[1]).read_text()):
                wrong += 1
                print(f'{page.relative_to(source)}: this is not in {block[1]}:\n{block[2]}')
        for path, parts in listed.items():
            whole = (source / path).read_text().partition('#pragma once')
            if whole[1] and parts[0].startswith(whole[1]) and unindented('\n'.join(parts)) != unindented(whole[1] + whole[2]):
                wrong += 1
                print(f'{page.relative_to(source)}: its blocks together are not {path}')
    if ran == 0 or checked < 5: print(f'the pages have {ran} commands and {checked} sums')
    sys.exit(wrong > 0 or ran == 0 or checked < 5)


main()
