"""Runs what hitpipe writes for a core or a unit with one fault in it: in Icarus, and a core's wrapper in the harness."""
import pathlib
import re
import shutil
import subprocess

PASSED, FAILED, NOT_COMPILED = "passed", "failed", "not compiled"


def run(command, seconds, folder):
    """(exit code, what it printed); the code is None if it took longer."""
    try:
        done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=seconds, errors="replace")
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired:
        return None, ""


def passes(command, seconds, folder):
    code, said = run(command, seconds, folder)
    return PASSED if code == 0 and "PASS" in said and "FAIL" not in said else FAILED


class Written:
    """A folder that `hitpipe rtl` or `hitpipe core rtl` wrote."""

    def __init__(self, folder, is_core):
        self.folder = pathlib.Path(folder).resolve()
        self.tb = self.folder / "tb"
        self.texts = {file.name: file.read_text() for file in sorted(self.folder.glob("*.v"))}
        # A core's own is the first. Its units are in its file.
        self.benches = sorted(file.name[:-len("_tb.sv")] for file in self.tb.glob("*_tb.sv"))
        self.core = self.benches[0] if is_core else None
        self.wrapper = self.core + "_axi" if is_core else None

    def copy_with(self, fault, folder):
        """Its Verilog with the fault in a new folder."""
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name, text in self.texts.items():
            (folder / name).write_text(fault.text_with_it(text) if fault and fault.file == name else text)

    def icarus(self, folder, fault):
        """The testbenches' verdict on the Verilog in the folder. One that hangs has found the fault."""
        # A core's machines are in no unit.
        benches = [bench for bench in self.benches if not self.core or bench == self.core or fault.module.startswith(bench)]
        for bench in reversed(benches):
            code, _ = run(["iverilog", "-g2012", "-DHITPIPE_CHECK", "-s", f"{bench}_tb", "-o", folder / f"{bench}.vvp", "-y", folder,
                           f"{bench}_tb.sv", folder / self.file_of(bench)], 60, self.tb)
            if code != 0:
                return NOT_COMPILED
            if passes(["vvp", "-n", folder / f"{bench}.vvp"], 60, self.tb) == FAILED:
                return FAILED
        return PASSED

    def file_of(self, module):
        return f"{module}.v" if f"{module}.v" in self.texts else f"{self.core}.v"

class Harness:
    """A core's harness. What does not depend on the fault is compiled once."""

    FLAGS = ["-std=c++17", "-O0", "-w"]

    def __init__(self, written, folder):
        self.written = written
        self.folder = folder
        written.copy_with(None, folder)
        self.translate(folder)
        root = re.search(r"^VERILATOR_ROOT = (.*)$", (folder / "c" / f"V{written.wrapper}.mk").read_text(), re.M)[1]
        include = pathlib.Path(root) / "include"
        self.includes = ["-I.", f"-I{include}", f"-I{include}/vltstd", f"-I{written.folder}"]
        self.kept = []
        for source in (include / "verilated.cpp", include / "verilated_threads.cpp", written.tb / f"{written.wrapper}_harness" / "harness.cpp"):
            self.kept.append(folder / f"{source.stem}.o")
            subprocess.run(["g++", *self.FLAGS, "-O1", *self.includes, "-c", source, "-o", self.kept[-1]], cwd=folder / "c", check=True)
        if self.verdict(folder) != PASSED:
            raise SystemExit(f"mutants: {written.wrapper}: the harness fails without a fault")

    def translate(self, folder):
        wrapper = self.written.wrapper
        code, _ = run(["verilator", "--cc", "-Wno-fatal", "-Wno-lint", "-Wno-style", "-DHITPIPE_CHECK", "--x-initial", "unique",
                          "--top-module", wrapper, "-y", folder, "--Mdir", folder / "c", folder / f"{wrapper}.v"], 120, folder)
        return code == 0

    def verdict(self, folder):
        wrapper = self.written.wrapper
        if not self.translate(folder):
            return NOT_COMPILED
        sources = sorted(file.name for file in (folder / "c").glob("V*.cpp"))
        (folder / "c" / "all.cpp").write_text("".join(f'#include "{name}"\n' for name in sources))
        program = folder / "c" / wrapper
        code, said = run(["g++", *self.FLAGS, *self.includes, "all.cpp", *self.kept, "-pthread", "-latomic", "-o", program], 300, folder / "c")
        if code != 0:
            raise SystemExit(f"mutants: {wrapper}: g++ fails: {said}")
        return passes([program], 120, self.written.tb)
