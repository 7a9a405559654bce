"""Yosys tries to prove that a module with a fault says the same as the one without it, from any state of its registers."""
import re

from simulation import run


def module_text(text, name):
    return re.search(rf"^module {name}\b.*?^endmodule$", text, re.M | re.S)[0]


def combinational(text):
    """Names of wires that are no output. They may differ where nobody sees it, so they are not compared."""
    return re.findall(r"^  wire (?:signed )?(?:\[\d+:0\] )?(\w+) =", text, re.M)


PROOF = """\
design -copy-from gold -as gold gold
design -copy-from gate -as gate gate
read_verilog -lib boxes.v
equiv_make -blacklist not_compared gold gate both
hierarchy -top both
opt_clean
equiv_struct
equiv_simple -short
equiv_struct
equiv_simple -seq 2
equiv_struct
equiv_induct -seq 3
equiv_status -assert
"""


def equivalent(texts, fault, folder, seconds):
    """Other modules are boxes: they say the same if they are told the same."""
    whole, name = texts[fault.file], fault.module
    (folder / "boxes.v").write_text("".join(text.replace(module_text(text, name), "") if text is whole else text for text in texts.values()))
    script = ""
    for side, text in (("gold", whole), ("gate", fault.text_with_it(whole))):
        (folder / f"{side}.v").write_text(re.sub(rf"^module {name}\b", f"module {side}", module_text(text, name), flags=re.M))
        script += (f"read_verilog -sv {side}.v\nread_verilog -lib boxes.v\nhierarchy -top {side}\nproc\nopt_clean\n"
                   f"memory -nordff -nomap\nopt_expr\nopt_clean\ndesign -stash {side}\n")
    (folder / "equivalent.ys").write_text(script + PROOF)
    # With all wires compared a proof has small steps. Without, it needs only that registers and outputs are the same.
    for wires in [], combinational(module_text(whole, name)):
        (folder / "not_compared").write_text("\n".join(wires) + "\n")
        code, _ = run(["yosys", "-q", "-s", "equivalent.ys"], seconds, folder)
        if code == 0:
            return True
    return False
