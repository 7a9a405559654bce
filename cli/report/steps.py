"""Steps of a report: commands of hitpipe, and the file that they make. A file that the same commands made is kept."""
from __future__ import annotations

import concurrent.futures
import ctypes
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence

from plots import csv_text, write_whole
from tables import Row, parse_csv


class Ended(Exception):
    """The report ends with this exit code, and all has been said."""

    def __init__(self, code: int) -> None:
        super().__init__(code)
        self.code = code


@dataclasses.dataclass(frozen=True)
class Out:
    """A file or a folder of the report. A printed command names it without the folder of the report."""
    name: str


class Stopped(Exception):
    """A signal has ended a command, and ends the report."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


Words = Sequence["str | Out"]


def printed(words: Words) -> str:
    """The command as the page has it."""
    return shlex.join(["hitpipe", *(word.name if isinstance(word, Out) else word for word in words)])


def file_hash(file: pathlib.Path) -> str:
    """Of the file's bytes, empty if it is not there."""
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else ""


PRCTL, DIE_WITH_PARENT = ctypes.CDLL(None).prctl, 1  # looked up before a child is forked


def die_with_parent() -> None:
    """A command does not go on when the report is killed."""
    PRCTL(DIE_WITH_PARENT, signal.SIGKILL)


class Steps:
    """Runs commands, those of a step side by side, and knows which files are there already."""

    def __init__(self, program: str, version: str, folder: pathlib.Path, more: Sequence[str],
                 talk: Sequence[str]) -> None:
        self.program, self.version, self.folder, self.more = program, version, folder, list(more)
        self.talk = list(talk)  # --quiet, --verbose or nothing
        self.wrong = False  # a command counted something that must be 0
        self.commands: dict[str, list[str]] = {}  # of each file, as the page prints them
        self.children: set[subprocess.Popen[str]] = set()
        self.jobs = int(more[1]) if more else os.cpu_count() or 1
        self.stopped = 0
        self.file = folder / "steps.json"
        try:
            self.done = json.loads(self.file.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            self.done = {}
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(number) != signal.SIG_IGN:  # nohup ignores one
                signal.signal(number, self.stop)

    def stop(self, number: int, _frame: object) -> None:
        """Ends the commands that run, and then the report, by the same signal."""
        self.stopped = number
        for child in list(self.children):
            child.send_signal(number)
        if not self.children:
            self.end_by(number)

    def end_by(self, number: int) -> None:
        """As a program ends that does not handle the signal."""
        print(f"hitpipe: stopped; the same command keeps what is done in {self.folder}", file=sys.stderr, flush=True)
        signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)

    def run(self, words: Words, may_fail: bool = False, quiet: bool = False) -> str:
        """What the command prints. One that fails has said why; `may_fail` raises that line as a RuntimeError. A quiet
        one says nothing if it is right."""
        arguments = [str(self.folder / word.name) if isinstance(word, Out) else word for word in words]
        if self.stopped:
            raise Stopped(self.stopped)
        child = subprocess.Popen([self.program, *arguments, *self.more, *self.talk], stdout=subprocess.PIPE, text=True,
                                 stderr=subprocess.PIPE if may_fail or quiet else None, preexec_fn=die_with_parent)
        self.children.add(child)
        out, err = child.communicate()
        self.children.discard(child)
        code = child.returncode
        if self.stopped or code < 0:
            raise Stopped(self.stopped or -code)
        if code > 0 and quiet:
            print(err, end="", file=sys.stderr)
        if code > 1:
            if may_fail:
                raise RuntimeError(err.strip().removeprefix("hitpipe: "))
            raise Ended(code)
        self.wrong = self.wrong or code == 1
        return out

    def run_all(self, commands: Sequence[Words], may_fail: bool = False, quiet: bool = False) -> list[str]:
        """What each of the commands prints, in their order. They run side by side."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            made = [pool.submit(self.run, words, may_fail, quiet) for words in commands]
            try:
                return [each.result() for each in made]
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise

    def made(self, name: str, commands: Sequence[Words], files: Sequence[str]) -> bool:
        """Whether the same commands of the same program made these files from the same inputs."""
        self.commands[name] = [printed(words) for words in commands]
        known = self.done.get(name, {})
        kept = known.get("key") == self.key(commands) and all(
            known.get("files", {}).get(file) == (file_hash(self.folder / file) or None) for file in files)
        if kept:
            self.wrong = self.wrong or known["wrong"]
            if self.talk != ["--quiet"]:
                print(f"{name}: kept, made by the same command", file=sys.stderr, flush=True)
        elif self.talk == ["--verbose"] or not self.talk and sys.stderr.isatty():
            print(f"hitpipe: making {name}", file=sys.stderr, flush=True)
        return kept

    def key(self, commands: Sequence[Words]) -> list[str]:
        """What the files depend on."""
        inputs = {word for words in commands for word in words if isinstance(word, str) and os.path.isfile(word)}
        return [self.version, *map(printed, commands),
                *(f"{word} {file_hash(pathlib.Path(word))}" for word in sorted(inputs))]

    def record(self, name: str, commands: Sequence[Words], files: Sequence[str], wrong: bool) -> None:
        """The files are whole."""
        self.done[name] = {"key": self.key(commands), "wrong": wrong,
                           "files": {file: file_hash(self.folder / file) for file in files}}
        write_whole(self.file, (json.dumps(self.done, indent=1) + "\n").encode())

    def files(self, name: str, commands: Sequence[Words], files: Sequence[str], at_once: bool = False) -> None:
        """A step whose commands write the files themselves, in turn or all at once."""
        if self.made(name, commands, files):
            return
        before, self.wrong = self.wrong, False
        for group in [commands] if at_once else [[words] for words in commands]:
            self.run_all(group)
        self.record(name, commands, files, self.wrong)
        self.wrong = self.wrong or before

    def printed_by(self, name: str, commands: Sequence[Words], form: str, write: Callable[[list[str]], str],
                   may_fail: bool = False, more: Sequence[str] = (), quiet: bool = False) -> str:
        """A step whose commands print rows in this form: the file that `write` makes of what they print. The commands
        may write files, `more`, too."""
        file = self.folder / name
        if not self.made(name, commands, [name, *more]):
            before, self.wrong = self.wrong, False
            text = write(self.run_all([[*words, "--format", form] for words in commands], may_fail, quiet))
            write_whole(file, text.encode())
            self.record(name, commands, [name, *more], self.wrong)
            self.wrong = self.wrong or before
        self.commands[name] = [f"{line} --format {form}" for line in self.commands[name]]
        return file.read_text(encoding="utf-8")

    def table(self, name: str, commands: Sequence[Words], about: Sequence[Row] = (), may_fail: bool = False,
              more: Sequence[str] = ()) -> list[Row]:
        """All rows of commands that print CSV, with `about` of their command before its cells."""
        def joined(texts: list[str]) -> str:
            return rows_text([{**(about[i] if about else {}), **row} for i, text in enumerate(texts)
                              for row in parse_csv(text)])

        return parse_csv(self.printed_by(name, commands, "csv", joined, may_fail, more))

    def records(self, name: str, commands: Sequence[Words], may_fail: bool = False, quiet: bool = False) -> list:
        """What each of the commands prints as JSON."""
        def joined(texts: list[str]) -> str:
            return json.dumps([json.loads(text) for text in texts], indent=1, ensure_ascii=False) + "\n"

        return json.loads(self.printed_by(name, commands, "json", joined, may_fail, quiet=quiet))

    def derived(self, name: str, records: Sequence[Mapping[str, object]]) -> list[Row]:
        """Rows of records as a table of the report. Lists and records inside them stay out. A format of two numbers
        gets the n that it has in all CSV, lest it be read as a date."""
        def cell(value: object) -> str:
            text = "" if value is None else str(value).lower() if isinstance(value, bool) else str(value)
            return f"n{text}" if re.fullmatch(r"\d+/\d+", text) else text

        rows = [{k: cell(v) for k, v in of.items() if not isinstance(v, (list, dict))} for of in records]
        text = rows_text(rows)
        write_whole(self.folder / name, text.encode())
        return parse_csv(text)


def rows_text(rows: Sequence[Row]) -> str:
    """As CSV, with the columns of all rows."""
    header = list(dict.fromkeys(column for row in rows for column in row))
    return csv_text(header, [[row.get(c, "") for c in header] for row in rows])
