#!/usr/bin/env python3
"""test_names.py ROOT BUILD: each test that a page names as `Suite.Test`, or as `Suite.*`, is a test of the tree, and each line of
tests/slow_tests.txt is a test of CTest."""
import pathlib, re, subprocess, sys

root = pathlib.Path(sys.argv[1])
tests = set()
for file in (root / 'tests').rglob('*.[ch]pp'):
    tests.update(re.findall(r'\b(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)', file.read_text()))
for file in (root / 'tests').rglob('CMakeLists.txt'):
    text = file.read_text()
    tests.update(tuple(name.split('.')) for name in re.findall(r'add_test\(NAME (\w+\.\w+)\s', text))
    tests.update(('install', name) for name in re.findall(r'^install_test\((\w+)', text, re.M))
suites = {suite for suite, _ in tests}

named, wrong = 0, 0
for page in [root / 'README.md', root / 'CONTRIBUTING.md', *sorted((root / 'docs').rglob('*.md'))]:
    for suite, test in re.findall(r'`([A-Za-z]\w*)\.([A-Z]\w+|\*)`', page.read_text()):
        named += 1
        if (suite, test) in tests or (test == '*' and suite in suites): continue
        wrong += 1
        print(f'{page.relative_to(root)}: {suite}.{test}: no such test')
if named < 30:
    wrong += 1
    print(f'only {named} names of tests were found')
listed = subprocess.run(['ctest', '--test-dir', sys.argv[2], '-N'], capture_output=True, text=True, check=True).stdout
of_ctest = set(re.findall(r'^ *Test +#\d+: (.*)$', listed, re.M))
for slow in (root / 'tests/slow_tests.txt').read_text().split():
    if slow in of_ctest: continue
    wrong += 1
    print(f'tests/slow_tests.txt: {slow}: no such test')
sys.exit(wrong > 0)
