#!/usr/bin/env python3
"""pages_are_true.py PROGRAM SOURCE: runs the commands of docs/*.md and compares.

A block ```console holds commands behind "$ " and the lines that they print. All blocks of a page run in one new folder, where
build/hitpipe is PROGRAM. A block ```cpp behind a line <!-- from PATH --> must stand in SOURCE/PATH, at any indentation.
"""
import pathlib, re, shutil, subprocess, sys, tempfile


def blocks(text, language):
    return re.finditer(r'(?:<!-- from (\S+) -->\n)?^```' + language + r'\n(.*?)^```$', text, re.M | re.S)


def steps(block):
    for part in re.split(r'^\$ ', block, flags=re.M)[1:]:
        command, _, printed = part.partition('\n')
        yield command, printed


def unindented(text):
    return '\n'.join(line.strip() for line in text.strip().splitlines())


def main():
    program, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    ran = wrong = 0
    for page in sorted((source / 'docs').glob('*.md')):
        text = page.read_text()
        folder = pathlib.Path(tempfile.mkdtemp())
        try:
            (folder / 'build').mkdir()
            (folder / 'build/hitpipe').symlink_to(program)
            for block in blocks(text, 'console'):
                for command, expected in steps(block[2]):
                    result = subprocess.run(['bash', '-c', command], cwd=folder, stdout=subprocess.PIPE,
                                            stderr=subprocess.PIPE, text=True)
                    ran += 1
                    if result.returncode != 0 or result.stdout != expected:
                        wrong += 1
                        print(f'docs/{page.name}: $ {command}\nprints (exit code {result.returncode})\n{result.stdout}{result.stderr}and the page says\n{expected}')
        finally:
            shutil.rmtree(folder)
        for block in blocks(text, 'cpp'):
            if block[1] is None: continue
            ran += 1
            if unindented(block[2]) not in unindented((source / block[1]).read_text()):
                wrong += 1
                print(f'docs/{page.name}: this is not in {block[1]}:\n{block[2]}')
    if ran == 0: print('no page has a command')
    sys.exit(wrong > 0 or ran == 0)


main()
