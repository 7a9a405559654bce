"""A component between registers: what it costs, and how long a stage of it takes."""

import re
import tempfile
from pathlib import Path

import osu018

REGISTER_UM2 = 96  # DFFPOSX1
PORT = re.compile(r"^\s*(input|output)\s+(?:wire|reg)\s+(?:\[(\d+):0\]\s+)?(\w+)", re.MULTILINE)


def ports_of(verilog, module):
    """(direction, width, name) of each port of a module in the form that hitpipe writes."""
    header = re.search(rf"^module {module} *\((.*?)\);", verilog, re.MULTILINE | re.DOTALL)
    if not header:
        osu018.fail(f"no module {module} in the Verilog")
    return [(d, int(high or 0) + 1, name) for d, high, name in PORT.findall(header[1])]


def around(ports, module, direct):
    """Registers before the inputs and behind the outputs. A port in `direct` has none."""
    lines, connected = [], []
    top = ["input wire clk"]
    for direction, width, name in ports:
        span = f"[{width - 1}:0] "
        if name == "clk":
            connected.append(".clk(clk)")
        elif name in direct:
            top.append(f"input wire {span}{name}")
            connected.append(f".{name}({name})")
        elif name == "en":
            connected.append(".en(1'b1)")
        elif direction == "input":
            top.append(f"input wire {span}{name}")
            lines.append(f"  (* keep *) reg {span}{name}_q;\n  always @(posedge clk) {name}_q <= {name};\n")
            connected.append(f".{name}({name}_q)")
        else:
            top.append(f"output reg {span}{name}")
            lines.append(f"  wire {span}{name}_d;\n  always @(posedge clk) {name} <= {name}_d;\n")
            connected.append(f".{name}({name}_d)")
    return f"module between ({', '.join(top)});\n{''.join(lines)}  {module} component ({', '.join(connected)});\nendmodule\n"


def between_registers(verilog, module, direct=(), recipe="timed"):
    """Area of the component alone in um2, its own registers included; the period from register to register in ps."""
    ports = ports_of(verilog, module)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "component.v").write_text(verilog + around(ports, module, direct))
        area, registers = osu018.synthesise(folder, "component.v", "between", recipe=recipe)
        border = sum(width for _, width, name in ports if name not in ("clk", "en", *direct))
        if registers < border:
            osu018.fail(f"{module}: an input or output bit has no effect, so its register is gone")
        return area - REGISTER_UM2 * border, osu018.period_ps(folder, "between")
