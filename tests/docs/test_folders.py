#!/usr/bin/env python3
"""test_folders.py ROOT: a test beside tests of source folders lies in the folder of its subject: what lies in tests/sim/cosim
tests sim/cosim. A folder of tests that is a program of its own may have another name."""
import pathlib, sys

root = pathlib.Path(sys.argv[1])
seen, wrong = 0, 0
for test in sorted((root / 'tests').rglob('*_test.cpp')):
    folder = test.parent.relative_to(root / 'tests')
    if not (root / folder.parts[0]).is_dir(): continue  # tests of the whole: docs, install and so on
    seen += 1
    if (root / folder).is_dir() or (test.parent / 'CMakeLists.txt').exists(): continue
    wrong += 1
    print(f'{test.relative_to(root)}: there is no folder {folder}')
if seen < 150:
    wrong += 1
    print(f'only {seen} tests were found')
sys.exit(wrong > 0)
