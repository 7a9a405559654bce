#!/usr/bin/env python3
"""features.py SOURCE: a feature of the core is named in its own files. Prints for each feature of designs.cmake which other
files use its options, that is the fields of CoreOptions that its file reads. False if more than two do, or if its own file
uses none. Its own files, tests and pages do not count."""
import pathlib
import re
import sys

import tree

MOST = 2


def features(source):
    text = (source / "designs.cmake").read_text()
    return re.search(r"set\(HITPIPE_CORE_FEATURES\n(.*?)\)", text, re.S)[1].split()


def fields(source):
    """Those of CoreOptions that are of features, each called after its feature."""
    text = (source / "rtl_gen/core/core_options.hpp").read_text()
    of_features = text[text.index("// Of features."):text.index("/// Bits of a ray's number.")]
    return set(re.findall(r"^  \w+ (\w+)(?: = false|\{\});$", of_features, re.M))


def uses(text, field):
    """Places such as options.cache.kib, core.options.rings, and {.rings = true}."""
    of_options = r"\b(?:\w*options\w*|core|made|chosen|before|each|is|was)(?:\(\))?(?:\.|->)"
    return len(re.findall(of_options + field + r"\b(?!\()|[{,]\s*\." + field + r" = (?:true|false|\{\.kib)", text))


def main(source):
    texts = {name: (source / name).read_text() for name in tree.files(source)
             if name.endswith((".cpp", ".hpp", ".in")) and not name.startswith(("tests/", "docs/"))}
    # Others have numbers with the same names.
    texts = {name: text for name, text in texts.items() if "CoreOptions" in text or "rtl_gen/core/" in text}
    known = fields(source)
    right = len(known) >= 6
    print(f"{'feature':17} {'files':>5} {'places':>6}")
    for feature in features(source):
        if feature == "base":
            continue
        own = re.compile(rf"(^|/){feature}(_\w+)?\.\w+$")
        counts = {name: uses(text, feature) for name, text in texts.items()}
        outside = [name for name, count in counts.items() if count and not own.search(name)]
        if "rtl_gen/core/core_options.hpp" not in outside:
            outside.append("rtl_gen/core/core_options.hpp")  # where they are declared
        in_own = sum(count for name, count in counts.items() if own.search(name))
        good = feature in known and in_own > 0 and len(outside) <= MOST
        right = right and good
        print(f"{feature:17} {len(outside):5} {sum(counts[name] for name in outside) + 1:6}  {', '.join(outside)}"
              + ("" if good else "  NOT in its own files"))
    return 0 if right else 1


sys.exit(main(pathlib.Path(sys.argv[1])))
