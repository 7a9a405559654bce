#!/usr/bin/env python3
"""folders.py ROOT: folders include what they say, and no two include each other.
folders.py ROOT reach FILE...: how many files of the project each file includes, directly and through others.

A folder at the root begins its CMakeLists.txt with what may be in it and what it includes. The line with "includes A, B" names
the others that its sources may include, "nothing" none, "all but A" the rest. A table below names each folder inside. Where the
text says that a room includes the rooms above it, one includes only what the table names before it. There is no circle of
folders anywhere, not even a long one. Each include that breaks a rule is printed.
"""
import collections
import os
import pathlib
import re
import sys

import tree

root = pathlib.Path(sys.argv[1])
rooms = tree.rooms(root)
SOURCES = (".h", ".hpp", ".cpp", ".cpp.in", ".hpp.in")
names = {name for name in tree.files(root) if name.endswith(SOURCES) and name.split("/")[0] in rooms}


def included(name):
    """The files of the project that a file includes. Public headers have their place in library/include."""
    given = re.findall(r'^\s*#\s*include ["<]([^">]+)[">]', (root / name).read_text(errors="replace"), re.M)
    return [place for file in given for place in (file, f"library/include/{file}") if place in names]


includes = {name: included(name) for name in sorted(names)}


def reached(start, following):
    found, ahead = {start}, [start]
    while ahead:
        for each in following(ahead.pop()):
            if each not in found:
                found.add(each)
                ahead.append(each)
    return found


def not_as_said(room):
    """What the head of its CMakeLists.txt forbids, and what it does not name."""
    file = f"{room}/CMakeLists.txt"
    head = re.match(r"(#.*\n)*", (root / file).read_text()).group(0)
    prose = re.sub(r"\n# (?! )", " ", head)
    says = re.search(r"[Ii]ncludes (nothing|all but ([a-z_]+)|[a-z_]+(?:, [a-z_]+)*)", prose)
    if says is None:
        yield f"{file}: does not say what the folder includes"
        return
    allowed = {room} | (set() if says[1] == "nothing" else set(rooms) - {says[2]} if says[2] else set(says[1].split(", ")))
    for other in sorted(allowed - set(rooms)):
        yield f"{file}: names {other}, which is no folder of sources"
    own = [name for name in includes if name.startswith(room + "/")]
    for name in own:
        for other in includes[name]:
            if other.split("/")[0] not in allowed:
                yield f"{name}: includes {other}, which {file} does not allow"
    if "#   " not in head: return
    place = {}
    for inside in {name.split("/")[1] for name in own if name.count("/") > 1}:
        named = re.search(rf"(?m)(?:^#|  ) *{inside} ", head)
        if named: place[inside] = named.start()
        else: yield f"{file}: does not name {room}/{inside}"
    for gone in set(re.findall(r"(?m)^#   ([a-z_]+) ", head)) - set(place):
        yield f"{file}: names {room}/{gone}, which is not there"
    if "a room includes the rooms that stand above it" not in prose: return
    for name in own:
        for other in includes[name]:
            from_, to = name.split("/")[1], other.split("/")[1]
            if other.startswith(room + "/") and place.get(to, 0) > place.get(from_, 0):
                yield f"{name}: includes {other}, a room that stands below {from_} in {file}"


def way(edges, start, end):
    """The fewest folders from one to the other, both with them; empty if no include leads there."""
    ways = collections.deque([[start]])
    seen = {start}
    while ways:
        path = ways.popleft()
        if path[-1] == end: return path
        for folder, other in edges:
            if folder == path[-1] and other not in seen:
                seen.add(other)
                ways.append([*path, other])
    return []


def circles():
    """The shortest circle of folders, and the step in it with the fewest includes; then, without this step, the next."""
    edges = collections.defaultdict(list)
    for name, others in includes.items():
        for other in others:
            step = os.path.dirname(name), os.path.dirname(other)
            if step[0] != step[1]: edges[step].append((name, other))
    while True:
        found = [path for folder, other in edges if (path := way(edges, other, folder))]
        if not found: return
        path = min(found, key=len)
        least = min(zip(path, path[1:] + path[:1]), key=lambda step: len(edges[step]))
        yield path, edges.pop(least)


def main():
    faults = [fault for room in rooms for fault in not_as_said(room)]
    for circle, step in circles():
        faults.append(f"{' -> '.join([*circle, circle[0]])}: folders that include each other, for instance by")
        faults += [f"  {name}: includes {other}" for name, other in step]
    if len(names) < 500: faults.append(f"only {len(names)} files were found")
    folders = len({os.path.dirname(name) for name in names})
    print("\n".join(faults) if faults else f"{folders} folders in {len(rooms)} keep to what they say, and no two include each other")
    return 1 if faults else 0


def reach(file):
    if file not in names: sys.exit(f"{file}: no source of {', '.join(rooms)}")
    read = reached(file, lambda each: includes[each])
    # What it calls stands in the sources beside the headers.
    sources = reached(file, lambda each: includes[each] + [beside for beside in [re.sub(r"\.hpp$", ".cpp", each)] if beside in names])
    print(f"{file}: {len(read) - 1} files, and {len(sources) - 1} with the sources of these headers and what they include")


if len(sys.argv) == 2: sys.exit(main())
if len(sys.argv) < 4 or sys.argv[2] != "reach": sys.exit(__doc__)
for given in sys.argv[3:]: reach(given)
