#!/usr/bin/env python3
"""What a Debian 12 with git and make has once packages.txt is installed: the closure of packages.txt without recommended packages.
  closure.py files BUILD    every file outside the tree that CMake, compiler and linker read for BUILD belongs to a package of it
  closure.py path FOLDER    links all its programs into FOLDER: whoever has only FOLDER in PATH starts no other programs by name
Ends with 77 on another system."""
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

INFO = Path("/var/lib/dpkg/info")
ROOT = Path(__file__).resolve().parent.parent.parent


def installed_packages():
    """The fields of each installed package by its name, and who provides each virtual package."""
    packages, providers = {}, {}
    for paragraph in Path("/var/lib/dpkg/status").read_text().split("\n\n"):
        fields = dict(line.split(": ", 1) for line in re.sub(r"\n[ \t]", " ", paragraph).split("\n") if ": " in line)
        if fields.get("Status", "").endswith(" ok installed"):
            packages[fields["Package"]] = fields
            for name in names(fields.get("Provides", "")):
                providers.setdefault(name[0], []).append(fields["Package"])
    return packages, providers


def names(relation):
    """For each clause of a field such as Depends, the names of which one is enough."""
    return [[re.split(r"[ :(]", word.strip())[0] for word in clause.split("|")] for clause in relation.split(",") if clause.strip()]


def closure():
    packages, providers = installed_packages()
    listed = re.sub(r"#.*", "", (ROOT / "packages.txt").read_text()).split()
    if missing := [p for p in listed if p not in packages]:
        sys.exit(f"closure: not installed: {' '.join(missing)}; make packages installs them")
    minimal = [p for p, f in packages.items() if f.get("Essential") == "yes" or f.get("Priority") == "required"]
    found, left = set(), minimal + ["apt", "git", "make"] + listed
    while left:
        if (package := left.pop()) in found:
            continue
        found.add(package)
        fields = packages[package]
        for clause in names(fields.get("Pre-Depends", "")) + names(fields.get("Depends", "")):
            choices = [real for name in clause for real in ([name] if name in packages else providers.get(name, []))]
            if not found.intersection(choices):
                left += choices[:1]
    return found


def plain(path):
    """As it is on a system whose /lib is /usr/lib."""
    return re.sub(r"^/(bin|sbin|lib\w*)/", r"/usr/\1/", path)


def files_of(packages):
    """Where each installed file comes from, of those packages."""
    owner = {}
    for listing in INFO.glob("*.list"):
        package = listing.stem.split(":")[0]
        if package in packages:
            for path in listing.read_text().splitlines():
                owner[plain(path)] = package
    return owner


def belongs(path, files):
    """Whether a package has that file or link. A link of update-alternatives has no package; what it leads to has."""
    folder, name = os.path.split(path)
    if plain(path) in files or plain(os.path.join(os.path.realpath(folder), name)) in files:
        return True
    target = os.path.join(folder, os.readlink(path)) if os.path.islink(path) else ""
    return target.startswith("/etc/alternatives/") and belongs(os.path.join(folder, os.readlink(target)), files)


def ninja(build, *tool):
    run = subprocess.run(["ninja", "-C", str(build), "-t", *tool], capture_output=True, text=True, check=True)
    return run.stdout.splitlines()


def linked(build):
    """What the linker reads for the system's libraries in each link line."""
    lines = set()
    for line in ninja(build, "commands", "all"):
        words = shlex.split(line)
        if words[:2] == [":", "&&"] and "-o" in words and not words[2].endswith(("ar", "cmake")):
            lines.add((words[2], *(w for w in words[3:] if w.startswith(("/usr/", "/lib", "-l", "-f")))))
    for words in sorted(lines):
        run = subprocess.run([*words, "-Wl,--no-as-needed,--trace", "-x", "c++", "-", "-o", "/dev/null"], input="int main(){}",
                             capture_output=True, text=True, check=False)
        if run.returncode:
            sys.exit(f"closure: {' '.join(words)}: {run.stderr}")
        yield from re.findall(r"^\(?(/[^()\s]+)", run.stdout, re.M)


def check_files(build):
    outside = set(linked(build))
    for target in ("all", "build.ninja"):
        outside.update(line for line in ninja(build, "inputs", target))
    outside.update(line.strip() for line in ninja(build, "deps") if line.startswith(" "))
    trees = (str(ROOT), str(build.resolve()), "/tmp/")
    outside = {os.path.normpath(f) for f in outside if f.startswith("/") and not f.startswith(trees)}
    files = files_of(closure())
    wrong = sorted(f for f in outside if not belongs(f, files))
    for f in wrong:
        print(f"{f}: no package in the closure of packages.txt has it")
    print(f"{len(outside)} files outside the tree, {len(wrong)} of them not in the closure of packages.txt")
    return 1 if wrong or len(outside) < 500 else 0


def link_programs(folder):
    files = files_of(closure())
    folder.mkdir(parents=True)
    for place in ("/usr/local/bin", "/usr/bin", "/usr/sbin"):
        for entry in os.scandir(place):
            if os.access(entry.path, os.X_OK) and belongs(entry.path, files):
                (folder / entry.name).symlink_to(entry.path)
    return 0


if not INFO.is_dir():
    print("closure: skipped, this is no Debian")
    sys.exit(77)
sys.exit({"files": check_files, "path": link_programs}[sys.argv[1]](Path(sys.argv[2])))
