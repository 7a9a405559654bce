#!/usr/bin/env python3
"""tidy.py BUILD [JOBS]: clang-tidy over the sources of the tree. BUILD is a configured folder, of the preset lint. A source that was
clean is left out until it, a file that it includes, its options or .clang-tidy change; BUILD/tidied says so."""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

import tree

root = pathlib.Path(__file__).resolve().parents[2]
build = pathlib.Path(sys.argv[1]).resolve()
jobs = int(sys.argv[2]) if len(sys.argv) > 2 else os.cpu_count()
FOLDERS = re.compile(rf"{re.escape(str(root))}/({re.escape(str(build.relative_to(root)))}/)?({'|'.join(tree.rooms(root))})/")
# A unity file includes sources, which is what it is for.
TIDY = ["clang-tidy", "--quiet", f"-p={build}", "--checks=-bugprone-suspicious-include"]

digests = {}


def digest(path):
    if path not in digests:
        file = pathlib.Path(path)
        digests[path] = hashlib.sha256(file.read_bytes()).hexdigest() if file.exists() else ""
    return digests[path]


def included(entry):
    """The files of the tree, and of the build folder, that a source reads, and itself."""
    words = shlex.split(entry["command"])
    words = words[:words.index("-o")] + words[words.index("-o") + 2:]
    rule = subprocess.run([*words, "-MM"], cwd=entry["directory"], capture_output=True, text=True, check=True).stdout
    paths = rule.replace("\\\n", " ").split()[1:]
    return sorted({str((pathlib.Path(entry["directory"]) / path).resolve()) for path in paths} | {str(root / ".clang-tidy")})


def stamp_of(entry):
    return build / "tidied" / hashlib.sha256(entry["command"].encode()).hexdigest()


def is_clean(entry):
    stamp = stamp_of(entry)
    return stamp.exists() and all(digest(path) == was for path, was in json.loads(stamp.read_text()).items())


def complaints(entry):
    ran = subprocess.run([*TIDY, entry["file"]], cwd=root, capture_output=True, text=True)
    if ran.returncode != 0: return ran.stdout or ran.stderr
    stamp_of(entry).write_text(json.dumps({path: digest(path) for path in included(entry)}))
    return ""


entries = [entry for entry in json.loads((build / "compile_commands.json").read_text()) if FOLDERS.match(entry["file"])]
(build / "tidied").mkdir(exist_ok=True)
changed = [entry for entry in entries if not is_clean(entry)]
with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
    wrong = [text for text in pool.map(complaints, changed) if text]
print("".join(wrong), end="")
print(f"lint: {len(changed)} of {len(entries)} sources looked at, {len(wrong) or 'none'} with complaints")
sys.exit(1 if wrong or not entries else 0)
