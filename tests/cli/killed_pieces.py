#!/usr/bin/env python3
"""killed_pieces.py PROGRAM KILL_AT_CALL: pieces that are killed, or have no room on the disk, and are started again give
the result of one run. KILL_AT_CALL is the library that kills a program at a call that changes files. What is no whole set
of pieces is refused with one line."""
import json
import os
import pathlib
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
KILL_AT_CALL = str(pathlib.Path(sys.argv[2]).resolve())
SEED = 42
random.seed(SEED)
FOLDER = pathlib.Path(tempfile.mkdtemp())
wrong = []


def run(words, **more):
    """Without the lines that say how far a slow machine is."""
    made = subprocess.run([PROGRAM, *shlex.split(words)], cwd=FOLDER, capture_output=True, text=True, check=False,
                          **more)
    made.stderr = re.sub(r"^hitpipe: .*: \d+ (s|min|h)\b.*\n", "", made.stderr, flags=re.M)
    return made


def printed(words):
    made = run(words)
    if made.returncode != 0 or made.stderr:
        sys.exit(f"hitpipe {words}: exit code {made.returncode}: {made.stderr}")
    return made.stdout


def commands_of(words):
    """Of the pieces, without the program."""
    return [shlex.join(shlex.split(line)[1:]) for line in printed(words).splitlines()]


def output_of(command):
    words = shlex.split(command)
    return FOLDER / words[words.index("--out") + 1]


def kill(command, call):
    """Runs it until the call of that number. True if it had not ended before."""
    killer = {"LD_PRELOAD": KILL_AT_CALL, "HITPIPE_KILL_AT_CALL": str(call), "ASAN_OPTIONS": "verify_asan_link_order=0"}
    return run(command, env={**os.environ, **killer}).returncode == -signal.SIGKILL


def without_times(rows):
    """The last columns of a sweep are measured times."""
    lines = [line.split(",") for line in rows.splitlines()]
    last = lines[0].index("rtl_seconds")
    return [line[:last] for line in lines]


def kill_and_finish(name, words, calls, result):
    """Kills five pieces, each three times, then starts all again. A piece makes so many calls or more. Result joins."""
    commands = commands_of(f"{words} --pieces 8 --out {name}")
    for command in random.sample(commands, 5):
        for call in random.sample(range(1, calls + 1), 3):
            if not kill(command, call):
                wrong.append(f"{name}: {command} was not killed at call {call}, seed {SEED}")
            if output_of(command).exists():
                wrong.append(f"{name}: {output_of(command).name} is there, but its piece was killed")
    for command in random.sample(commands, len(commands)):
        printed(command)
    if printed(commands[3]) != f"{name}/4{output_of(commands[3]).suffix}: piece 4 of 8\n":
        wrong.append(f"{name}: a piece that is done does not say so")
    left = sorted(file.name for file in (FOLDER / name).iterdir() if file.suffix not in (".json", ".csv"))
    if left:
        wrong.append(f"{name}: left in the folder: {left}")
    result(" ".join(f"{name}/{file.name}" for file in sorted((FOLDER / name).iterdir())
                    if not file.name.endswith("-metadata.json")))


def same(piece, whole):
    return piece == whole or without_times(piece) == without_times(whole)


def compare(name, joined, one):
    if joined != one:
        wrong.append(f"{name}: joined and one run differ:\n{joined}\n{one}")


def refused(words, message):
    made = run(words)
    if made.returncode != 2 or made.stdout or made.stderr != f"hitpipe: {message}\n":
        wrong.append(f"hitpipe {words}: exit code {made.returncode}: {made.stdout}{made.stderr}, expected: {message}")


CHECK = "check int_slabs --bits 12/12 --tests 300000 --threads 1"
SWEEP = ("sweep int_slabs --bits 12/12,16/16 --rays-in-flight 4,8,12,16,24,32,48,64 --scene spheres --width 16 --height 16 "
         "--threads 1")


def check_sweep(files):
    text = printed(f"sweep --join {files} --out joined.csv")
    printed(f"{SWEEP} --out one.csv")
    compare("sweep", without_times((FOLDER / "joined.csv").read_text()),
            without_times((FOLDER / "one.csv").read_text()))
    if "hierarchy: " not in text:
        wrong.append("sweep --join prints no table")


def check_check(files):
    for form in ("text", "csv", "json"):
        compare("check", printed(f"check --join {files} --format {form}"), printed(f"{CHECK} --format {form}"))
    one = run("check fp_slabs --tests 100000")
    for command in commands_of("check fp_slabs --tests 100000 --pieces 5 --out f"):
        printed(command)
    joined = run("check --join f/1.json f/5.json f/3.json f/2.json f/4.json")
    compare("check with false misses", (joined.returncode, joined.stdout, joined.stderr),
            (one.returncode, one.stdout, one.stderr))
    if "the first, simplified" not in joined.stderr:
        wrong.append(f"fp_slabs has no false miss: {joined.stderr}")


def others():
    triangles = "check int_triangle --tests 100000 --format csv"
    for command in commands_of(f"{triangles} --pieces 4 --out t"):
        printed(command)
    compare("int_triangle", printed("check --join t/1.json t/2.json t/3.json t/4.json --format csv"),
            printed(triangles))
    world = "sweep int_triangle --scene spheres --width 24 --height 24"
    for command in commands_of(f"{world} --pieces 3 --out w"):
        printed(command)
    compare("sweep of int_triangle", printed("sweep --join w/3.json w/1.json w/2.json --out joined.csv"),
            printed(f"{world} --out one.csv"))
    compare("its rows", (FOLDER / "joined.csv").read_text(), (FOLDER / "one.csv").read_text())
    stiff = "check int_slabs int_major --stiff --tests 1000 --scene spheres --rays 20"
    for command in commands_of(f"{stiff} --pieces 5 --out stiff"):
        printed(command)
    pieces = " ".join(f"stiff/{i}.json" for i in range(1, 6))
    compare("stiff rays", printed(f"check --stiff --join {pieces} --out joined"), printed(f"{stiff} --out one"))
    for name in ("stiffness.csv", "stiffness.svg", "stiffness_scene.svg"):
        compare(name, (FOLDER / "joined" / name).read_text(), (FOLDER / "one" / name).read_text())
    trace = "core trace --scene spheres --width 40 --height 8 --native --rays-in-flight 4,16 --parts 2 --memory ideal,latency=5..60"
    for command in commands_of(f"{trace} --pieces 3 --out c"):
        printed(command)
    for form in ("text", "json"):
        compare("trace", printed(f"core trace --join c/2.json c/1.json c/3.json --format {form}"),
                printed(f"{trace} --format {form}"))
    for parts, one in zip(json.loads(printed(f"{trace} --format json")),
                          json.loads(printed(f"{trace.replace('--parts 2', '')} --format json"))):
        for key in ("rays", "wrong", "reads_a_ray"):
            compare(f"trace in parts and in one, {key}", parts[key], one[key])
    tables = "table 4.2 6.2 7.1 7.2 --judge --scene Branch=spheres --width 16 --height 12 --repeats 1"
    for command in commands_of(f"{tables} --pieces 3 --out j"):
        printed(command)
    compare("table", printed("table --judge --join j/1.json j/2.json j/3.json"), printed(tables))


def refusals():
    of = 'of 8 of "hitpipe check int_slabs --bits 12/12 --tests 300000 --seed 1"'
    files = [f"c8/{i}.json" for i in range(1, 9)]
    refused(f"check --join {' '.join(files[:4] + files[5:])}", f"--join: piece 5 {of} is missing")
    refused(f"check --join {' '.join(files)} c8/2.json", "c8/2.json: is piece 2 of 8, as c8/2.json is; give each once")
    text = (FOLDER / "c8/3.json").read_text()
    (FOLDER / "cut.json").write_text(text[: len(text) // 2])
    refused(f"check --join {' '.join(files).replace('c8/3', 'cut')}",
            "cut.json: is no whole piece; run the command of this piece again")
    (FOLDER / "old.json").write_text(text.replace('"program": "hitpipe ', '"program": "hitpipe 0.0.'))
    made = run(f"check --join {' '.join(files).replace('c8/3', 'old')}")
    if made.returncode != 2 or not made.stderr.startswith("hitpipe: old.json: was made by hitpipe 0.0."):
        wrong.append(f"another version: {made.stderr}")
    (FOLDER / "old.json").write_text(text.replace(program, program[:-9] + "01234567)"))
    refused(f"check --join {' '.join(files).replace('c8/3', 'old')}",
            f"old.json: was made by {program[:-9]}01234567), and this is {program}")
    printed("check int_slabs --bits 12/12 --tests 300000 --seed 2 --piece 3/8 --out seed.json")
    refused(f"check --join {' '.join(files).replace('c8/3', 'seed')}",
            'seed.json: is piece 3 of 8 of "hitpipe check int_slabs --bits 12/12 --tests 300000 --seed 2", and the '
            f'first file is piece 1 {of}')
    refused("check int_slabs --bits 12/12 --tests 300000 --seed 2 --piece 3/8 --out c8/3.json",
            f'c8/3.json: holds piece 3 {of} by {program}, asked for is piece 3 '
            f'{of.replace("seed 1", "seed 2")} by {program}; give another file or remove it')
    refused(f"sweep --join {' '.join(files)} --out x.csv",
            f'c8/1.json: is piece 1 {of}; allowed are pieces of hitpipe sweep')
    refused("sweep --join none.csv --out x.csv", "none.csv-metadata.json: cannot read which piece is beside it")
    # A sweep's rows: lines that are cut off, and rows of another scene under the same name.
    rows = (FOLDER / "s8/2.csv").read_text()
    joined = f"sweep --join {' '.join(f's8/{i}.csv' for i in range(1, 9))} --out x.csv"
    (FOLDER / "s8/2.csv").write_text("".join(rows.splitlines(True)[:1]))
    refused(joined, "s8/2.csv: has 0 rows, and its piece has 2; run its command again")
    (FOLDER / "s8/2.csv").write_text(rows[:-9])
    refused(joined, "s8/2.csv: the last line is cut short; give a file that hitpipe sweep wrote")
    (FOLDER / "s8/2.csv").write_text(rows)
    mesh = "v 0 0 0\nv 1 0 0\nv 0 1 {}\nf 1 2 3\n"
    small = "sweep int_slabs --bits 12/12 --rays-in-flight 8,16 --scene mesh.obj --width 8 --height 8"
    (FOLDER / "mesh.obj").write_text(mesh.format(0))
    first, second = commands_of(f"{small} --pieces 2 --out m")
    printed(first)
    (FOLDER / "mesh.obj").write_text(mesh.format(1))
    printed(second)
    refused("sweep --join m/1.csv m/2.csv --out x.csv",
            "m/2.csv: was made with another mesh.obj than the first file")
    refused(first, "m/1.csv: was made with another mesh.obj; give another file or remove it")
    if (FOLDER / "x.csv").exists():
        wrong.append("a join that is refused leaves a file")


def full_disk():
    """A file may have 100 bytes, as on a disk that is full."""
    for command in (commands_of(f"{CHECK} --pieces 8 --out full")[2],
                    commands_of(f"{SWEEP} --pieces 8 --out full")[2]):
        made = run(command, preexec_fn=lambda: (signal.signal(signal.SIGXFSZ, signal.SIG_IGN),
                                                resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))))
        if made.returncode != 2 or made.stderr.count("\n") != 1 or output_of(command).exists():
            wrong.append(f"{command} on a full disk: exit code {made.returncode}: {made.stderr}")
        printed(command)
        if not same(output_of(command).read_text(),
                    (FOLDER / ("c8" if "check" in command else "s8") / output_of(command).name).read_text()):
            wrong.append(f"{command}: not whole after the disk was full")


def models_are_made_once():
    """Four pieces of one unit at a time, into an empty cache. The stand-in counts how often Verilator runs."""
    counter = FOLDER / "verilator"
    real = shutil.which("verilator")
    counter.write_text(f'#!/bin/sh\ncase "$*" in *--cc*) echo x >> "{FOLDER}/runs";; esac\nexec "{real}" "$@"\n')
    counter.chmod(0o755)
    commands = commands_of("sweep int_slabs --bits 12/12 --rays-in-flight 2,4,6,8 --scene spheres --width 16 "
                           "--height 16 --pieces 4 --out once")
    started = [subprocess.Popen([PROGRAM, *shlex.split(command)], cwd=FOLDER, stdout=subprocess.DEVNULL,
                                env={"PATH": "/usr/bin:/bin", "HOME": str(FOLDER), "VERILATOR": str(counter),
                                     "HITPIPE_CACHE": str(FOLDER / "cache")}) for command in commands]
    codes = [child.wait() for child in started]
    runs = (FOLDER / "runs").read_text().count("x") if (FOLDER / "runs").exists() else 0
    if any(codes) or runs != 1:
        wrong.append(f"four pieces of one unit: exit codes {codes}, Verilator ran {runs} times")


program = printed("--version").splitlines()[0]
try:
    # A file takes four. A sweep writes two, then two for each row, and then a whole file.
    kill_and_finish("c8", CHECK, 4, check_check)
    kill_and_finish("s8", SWEEP, 12, check_sweep)
    others()
    refusals()
    full_disk()
    models_are_made_once()
finally:
    shutil.rmtree(FOLDER)
for line in wrong:
    print(line)
sys.exit(len(wrong) > 0)
