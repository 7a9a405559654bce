"""The faults that a line can have. Each is a kind and the line's code with the fault."""
import hashlib
import re

from verilog_lines import TOKEN

EXCHANGED = {"&": ["|", "^"], "|": ["&", "^"], "^": ["|", "&"], "+": ["-"], "-": ["+"], "*": ["+"], "==": ["!="], "!=": ["=="],
             "<": ["<=", ">"], "<=": ["<"], ">": [">=", "<"], ">=": [">"], "&&": ["||"], "||": ["&&"]}
CONSTANT = re.compile(r"(\d+)'([hdb])([0-9a-fA-F]+)")
SELECTED = re.compile(r"\b([a-z]\w*)\[(\d+)(?::(\d+))?\]")
BASES = {"h": 16, "d": 10, "b": 2}


def rank(*words):
    """A number that the words decide. It is the same on every machine."""
    return int.from_bytes(hashlib.sha256("\n".join(map(str, words)).encode()).digest()[:8], "big")


def at_top(text):
    """The tokens that stand in no bracket, with their places; and whether an operand stands before each."""
    depth, operand = 0, False
    for token in TOKEN.finditer(text):
        word = token[0]
        if word in ")]}":
            depth -= 1
        if depth == 0 and word not in ")]}":
            yield token, operand
        if word in "([{":
            depth += 1
        operand = word[0].isalnum() or word[0] == "_" or word in ")]}"


def other_operators(text):
    operand = False
    for token in TOKEN.finditer(text):
        word = token[0]
        before, behind = text[:token.start()], text[token.end():]
        if word == "~":
            yield "operator", before + behind
        elif operand or word in "&|^":
            for other in EXCHANGED.get(word, []):
                yield "operator", before + other + behind
        operand = word[0].isalnum() or word[0] in "_$" or word in ")]}"


def fewer_operands(text):
    tokens = [token for token, operand in at_top(text) if operand and token[0] in EXCHANGED]
    if len(tokens) == 1 and "?" not in text:
        yield "operand", text[:tokens[0].start()].strip()
        yield "operand", text[tokens[0].end():].strip()


def exchanged_arms(text):
    ask = colon = None
    for token, _ in at_top(text):
        if token[0] == "?" and ask is None:
            ask = token
        elif token[0] == ":" and ask and colon is None:
            colon = token
    if colon:
        first, second = text[ask.end():colon.start()].strip(), text[colon.end():].strip()
        if first != second and "?" not in second:
            yield "arms", f"{text[:ask.end()]} {second} : {first}"


def other_constants(text, seed):
    for constant in CONSTANT.finditer(text):
        width, base, digits = int(constant[1]), constant[2], constant[3]
        value = int(digits, BASES[base])
        flipped = value ^ 1 << rank(seed, text, constant.start()) % width
        values = {(value + 1) % 2 ** width, (value - 1) % 2 ** width, flipped} - {value}
        for other in sorted(values):
            shown = format(other, {"h": "x", "d": "d", "b": "b"}[base])
            yield "constant", f"{text[:constant.start()]}{width}'{base}{shown}{text[constant.end():]}"


def shifted_slices(text, module):
    for selected in SELECTED.finditer(text):
        name = selected[1]
        if name in module.memories or name not in module.widths:
            continue
        high = int(selected[2])
        low = int(selected[3] or high)
        for step in (1, -1):
            if low + step >= 0 and high + step < module.widths[name]:
                places = f"{high + step}:{low + step}" if selected[3] else f"{high + step}"
                yield "slice", f"{text[:selected.start()]}{name}[{places}]{text[selected.end():]}"


def other_addresses(text, module):
    for read in re.finditer(r"\b([a-z]\w*)\[([a-z]\w*)\]", text):
        if read[1] in module.memories:
            yield "address", f"{text[:read.start()]}{read[1]}[{read[2]} ^ 1'b1]{text[read.end():]}"


def width_of(text, module):
    selected = SELECTED.fullmatch(text)
    if selected:
        return int(selected[2]) - int(selected[3] or selected[2]) + 1
    return module.widths.get(text.lstrip("~"))


def tied(text, width):
    for bit in (0, 1):
        value = f"{{{width}{{1'b{bit}}}}}" if width > 1 else f"1'b{bit}"
        if text != value:
            yield "tied", value


def stuck_bits(text, width, seed):
    bit = rank(seed, "bit", text) % width
    yield "stuck bit", f"({text}) | {width}'h{1 << bit:x}"
    yield "stuck bit", f"({text}) & {width}'h{(1 << width) - 1 - (1 << bit):x}"


def sources(lines):
    """What registers, pins and outputs of each module get, by width."""
    found = {}
    for line in lines:
        for span in exchangeable(line):
            text = line.code[span[0]:span[1]]
            width = width_of_span(line, span)
            found.setdefault((line.module.name, line.clocked, width), set()).add(text)
    return {key: sorted(texts) for key, texts in found.items()}


def exchangeable(line):
    """Spans of values that another's may replace: of a register, or one name of a pin or an output."""
    if line.resets:
        return []
    spans = line.pins + (line.values if line.clocked or line.code.lstrip().startswith("assign") else [])
    return [span for span in spans if width_of_span(line, span) and (line.clocked or re.fullmatch(r"\w+", line.code[span[0]:span[1]]))]


def width_of_span(line, span):
    if span in line.values:
        return line.module.widths.get(line.target)
    return width_of(line.code[span[0]:span[1]], line.module)


def faults_of(line, seed, others):
    """All faults of the line: (kind, code)."""
    found = []

    def put(span, faults):
        begin, end = span
        found.extend((kind, line.code[:begin] + text + line.code[end:]) for kind, text in faults)

    for span in line.spans():
        text = line.code[span[0]:span[1]]
        if line.resets and span in line.values:
            put(span, (("reset", other) for _, other in other_constants(text, seed)))
            continue
        put(span, other_operators(text))
        put(span, other_constants(text, seed))
        put(span, shifted_slices(text, line.module))
        put(span, other_addresses(text, line.module))
        if span in line.enables:
            put(span, (("enable", bit) for bit in ("1'b0", "1'b1")))
            continue
        put(span, fewer_operands(text))
        put(span, exchanged_arms(text))
        width = width_of_span(line, span)
        if width and span not in line.labels:
            put(span, tied(text, width))
            if width > 1 and span in line.values:
                put(span, stuck_bits(text, width, seed))
        if span in line.addresses:
            put(span, [("address", f"({text}) ^ 1'b1")])
        if span in exchangeable(line):
            texts = [other for other in others[line.module.name, line.clocked, width] if other != text]
            if texts:
                put(span, [("another's value", texts[rank(seed, "other", line.place, text) % len(texts)])])
    if line.resets and line.values:
        found.append(("reset", re.match(r"\s*", line.code)[0] + ";"))
    return sorted({fault for fault in found if fault[1] != line.code})
