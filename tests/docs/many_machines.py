#!/usr/bin/env python3
"""many_machines.py PROGRAM SOURCE ENGINE: runs the recipe of docs/choosing.md for parallel, make or slurm as it is
printed, and compares what the pieces join to with one run. Exit code 77: the engine is not installed."""
import csv
import os
import pathlib
import re
import secrets
import shutil
import socket
import subprocess
import sys
import tempfile
import time

program, source, engine = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]), sys.argv[3]
page = (source / "docs/choosing.md").read_text()
folder = pathlib.Path(tempfile.mkdtemp(prefix="hitpipe-"))
environment = {**os.environ, "PATH": f"{os.environ['PATH']}:/usr/sbin:/sbin"}


def need(*programs):
    missing = [each for each in programs if shutil.which(each, path=environment["PATH"]) is None]
    if missing:
        print(f"not installed: {', '.join(missing)}")
        sys.exit(77)


def block(heading, language="sh", number=0):
    """The block of this language below the heading."""
    section = re.split(rf"^##+ {heading}$", page, flags=re.M)[1]
    section = re.split(r"^##", section, flags=re.M)[0]
    return re.findall(rf"^```{language}\n(.*?)^```$", section, re.M | re.S)[number]


def shell(text, **more):
    made = subprocess.run(["bash", "-ec", text], cwd=folder, env={**environment, **more}, capture_output=True,
                          text=True, check=False, timeout=1200)
    if made.returncode != 0:
        sys.exit(f"{text}exit code {made.returncode}\n{made.stdout}{made.stderr}")
    return made.stdout


def rows(file):
    """Without the columns of measured times."""
    cells = list(csv.reader((folder / file).read_text().splitlines()))
    measured = [i for i, name in enumerate(cells[0]) if name == "rtl_seconds" or name.startswith("software_s_")]
    return [[cell for i, cell in enumerate(row) if i not in measured] for row in cells]


def expect(truth, what):
    if not truth:
        sys.exit(f"{engine}: {what}")


def pieces_there():
    return sorted(int(file.stem) for file in (folder / "out/p").glob("*.csv"))


def check_joined():
    """Behind the engine: the page's join, or what the engine has joined itself."""
    expect(pieces_there() == list(range(1, 9)), f"there are the pieces {pieces_there()}")
    if not (folder / "joined.csv").exists():
        shell(block("Engines", number=1))
    one = re.sub(r"--pieces 8 --out out/p > jobs", "--out one.csv", block("Engines"))
    expect(one != block("Engines"), "the page's first command is another")
    shell(one)
    expect(len(rows("one.csv")) == 9 and rows("joined.csv") == rows("one.csv"), "joined and one run differ")


def by_parallel():
    need("parallel")
    line = block("GNU parallel")
    expect("--joblog log" in line and "--resume" in line, "the recipe keeps no log")
    # The first run is cut off: it does the first three pieces, and the fourth fails.
    shell("(head -3 jobs; echo false) > some")
    shell(line.replace("< jobs", "< some || true"))
    expect(pieces_there() == [1, 2, 3], f"before the engine goes on there are {pieces_there()}")
    shell(line)
    log = list(csv.DictReader((folder / "log").read_text().splitlines(), delimiter="\t"))
    done = [int(each["Seq"]) for each in log if each["Exitval"] == "0"]
    expect(sorted(done) == list(range(1, 9)) and len(log) == 9, f"the log has {log}")


def by_ssh():
    """Two machines that share a disk. What stands for ssh runs the command here, with the login shell in SHELL as sshd
    has it, and says which machine it was for."""
    need("parallel")
    (folder / "ssh").write_text('#!/bin/bash\nwhile [[ $1 == -* ]]; do shift; done\n'
                                f'echo "$1" >> {folder}/machines\nshift\n'
                                'cd /; export SHELL=/bin/bash; eval "$@"\n')
    (folder / "ssh").chmod(0o755)
    shell(block("GNU parallel", number=1), PARALLEL_SSH=str(folder / "ssh"))
    machines = set((folder / "machines").read_text().split())
    expect({"one.example", "two.example"} <= machines, f"the machines were {machines}")


def by_make():
    need("make")
    (folder / "pieces.mk").write_text(block("make", "make"))
    shell(block("make"))
    expect((folder / "joined.csv").exists(), "make has not joined")
    (folder / "out/p/5.csv").unlink()
    said = shell(block("make"))
    expect("sed -n 5p" in said and "sed -n 4p" not in said, f"after a piece is lost make says {said}")


def by_slurm():
    need("munged", "slurmctld", "slurmd", "sbatch")
    expect(os.geteuid() == 0 or sys.exit(print("Slurm's daemons need root") or 77), "")
    ports = []
    for _ in range(2):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            ports.append(free.getsockname()[1])
    own = folder / "slurm"
    for each in ("state", "spool"):
        (own / each).mkdir(parents=True)
    key = own / "munge.key"
    key.write_bytes(secrets.token_bytes(1024))
    key.chmod(0o400)
    for each in (folder, own):
        each.chmod(0o755)
    node = socket.gethostname().split(".")[0]
    (own / "slurm.conf").write_text(f"""ClusterName=pieces
SlurmctldHost={node}(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={own}/munge.socket
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
StateSaveLocation={own}/state
SlurmdSpoolDir={own}/spool
SlurmctldPidFile={own}/slurmctld.pid
SlurmdPidFile={own}/slurmd.pid
SlurmctldLogFile={own}/slurmctld.log
SlurmdLogFile={own}/slurmd.log
NodeName={node} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")
    environment["SLURM_CONF"] = str(own / "slurm.conf")
    try:
        shell(f"munged --force --num-threads=2 --key-file={key} --socket={own}/munge.socket --pid-file={own}/munged.pid "
              f"--log-file={own}/munged.log --seed-file={own}/munge.seed\nslurmctld\nslurmd\n")
        for _ in range(1200):
            if "idle" in subprocess.run(["sinfo", "-h"], env=environment, capture_output=True, text=True,
                                        check=False).stdout:
                break
            time.sleep(0.5)
        shell(block("Slurm"))
        (folder / "out/p/5.csv").unlink()
        before = (folder / "out/p/1.csv").stat().st_mtime_ns
        shell(block("Slurm"))
        expect((folder / "out/p/1.csv").stat().st_mtime_ns == before, "a piece was done again")
    finally:
        for name in ("slurmd", "slurmctld", "munged"):
            file = own / f"{name}.pid"
            if file.exists():
                subprocess.run(["kill", file.read_text().strip()], check=False)
        time.sleep(1)


engines = {"parallel": by_parallel, "ssh": by_ssh, "make": by_make, "slurm": by_slurm}
try:
    (folder / "build").mkdir()
    (folder / "build/hitpipe").symlink_to(program)
    shell(block("Engines"))
    expect(len((folder / "jobs").read_text().splitlines()) == 8, "there are not eight commands")
    engines[engine]()
    check_joined()
finally:
    shutil.rmtree(folder, ignore_errors=True)
