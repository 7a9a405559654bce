"""Offers tests to a unit with flow control `stall` and takes its results, with gaps and stalls. It knows no simulator:
`falling` waits for the next falling edge of clk, and `settled` until what was set shows at the outputs."""
import random

from pairs import Judge


async def drive(dut, pairs, falling, settled, seed=1, most_cycles=None):
    """Ends when every test was answered, or after most_cycles. Returns the Judge and the number of cycles."""
    draw = random.Random(seed)
    judge = Judge(pairs)
    sent = cycles = 0
    dut.rst.value, dut.in_valid.value, dut.out_ready.value = 1, 0, 0
    for port in pairs.unit.ports:
        getattr(dut, port.name).value = 0
    await falling()
    await falling()
    dut.rst.value = 0
    # A test takes a cycle and a bit with gaps and stalls, and no pipeline has a thousand stages.
    while judge.came < len(pairs) and cycles < (most_cycles or 4 * len(pairs) + 1000):
        offers = sent < len(pairs) and draw.random() < 0.8
        takes = draw.random() < 0.8
        dut.in_valid.value, dut.out_ready.value = int(offers), int(takes)
        if offers:
            for name, word in pairs.operands[sent].items():
                getattr(dut, name).value = word
        # What the outputs show now is what the rising edge acts on.
        await settled()
        if offers and int(dut.in_ready.value):
            sent += 1
        if takes and int(dut.out_valid.value):
            judge.take({port.name: int(getattr(dut, port.name).value) for port in pairs.unit.results})
        cycles += 1
        await falling()
    return judge, cycles
