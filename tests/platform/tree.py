"""What the project has: its files, and the folders of its sources."""
import os
import pathlib
import subprocess


def files(root):
    """Paths from the root: what git tracks, and in an archive all but what was built."""
    listed = subprocess.run(["git", "-C", root, "ls-files"], capture_output=True, text=True).stdout.split("\n")
    names = [name for name in listed if (pathlib.Path(root) / name).is_file()]
    if names: return names
    for folder, inside, here in os.walk(root):
        inside[:] = sorted(name for name in inside if not name.startswith((".", "__"))
                           and not os.path.exists(os.path.join(folder, name, "CMakeCache.txt")))
        names += [os.path.relpath(os.path.join(folder, name), root) for name in sorted(here)]
    return names


def rooms(root):
    """The folders at the root whose sources make the program and the library."""
    names = files(root)
    return sorted({name.split("/")[0] for name in names if name.endswith((".cpp", ".hpp"))}
                  & {name.split("/")[0] for name in names if name.count("/") == 1 and name.endswith("/CMakeLists.txt")}
                  - {"bench", "examples", "tests"})
