#!/usr/bin/env python3
"""links.py ROOT: each link and picture of the pages leads to a file, and each anchor to a heading of its page.

The pages are README.md, CONTRIBUTING.md, CHANGELOG.md, docs/*.md and docs/measured/*.md. Sources name only pages, scripts and
pictures of docs/ that are there. An anchor is made of a heading as GitHub makes it.
"""
import pathlib, re, sys

root = pathlib.Path(sys.argv[1]).resolve()
FOLDERS = 'area_model bench cli designs.cmake docs examples hls host library rtl_gen sim sw_ref tests thesis README.md CONTRIBUTING.md'.split()
TEXT = {'.c', '.cmake', '.cpp', '.h', '.hpp', '.md', '.py', '.sh', '.txt', '.v'}


def without_code(text):
    return re.sub(r'^```.*?^```$', '', text, flags=re.M | re.S)


def anchors(page):
    """Of each heading: lower case, without punctuation, blanks as hyphens; a number behind those that repeat."""
    found = {}
    for heading in re.findall(r'^#+ (.*)$', without_code(page.read_text()), re.M):
        heading = re.sub(r'\[([^\]]*)\]\([^)]*\)', r'\1', heading)
        anchor = re.sub(r'[^\w\- ]', '', heading.strip().lower()).replace(' ', '-')
        yield f'{anchor}-{found[anchor]}' if anchor in found else anchor
        found[anchor] = found.get(anchor, 0) + 1


def wrong_links(page):
    text = re.sub(r'`[^`\n]*`', '', without_code(page.read_text()))
    for link in re.findall(r'\]\(([^)\s]+)\)', text):
        if re.match(r'https?:', link): continue
        path, _, anchor = link.partition('#')
        target = (page.parent / path).resolve() if path else page
        reason = None
        if not target.exists(): reason = 'no such file'
        elif anchor and anchor not in anchors(target): reason = 'no such heading'
        yield link, reason


def main():
    pages = [root / name for name in ('README.md', 'CONTRIBUTING.md', 'CHANGELOG.md')]
    pages += sorted((root / 'docs').glob('*.md')) + sorted((root / 'docs/measured').glob('*.md'))
    links = named = wrong = 0
    for page in pages:
        for link, reason in wrong_links(page):
            links += 1
            if reason is None: continue
            wrong += 1
            print(f'{page.relative_to(root)}: {link}: {reason}')
    for folder in FOLDERS:
        base = root / folder
        for file in sorted(base.rglob('*')) if base.is_dir() else [base]:
            if file.suffix not in TEXT: continue
            for name in re.findall(r'(?<![\w/.])docs/[\w/.-]+\.(?:md|py|sh|svg|png|csv)\b', file.read_text(errors='replace')):
                named += 1
                if (root / name).exists(): continue
                wrong += 1
                print(f'{file.relative_to(root)}: {name}: no such file')
    if links < 150 or named < 60:
        wrong += 1
        print(f'only {links} links and {named} names were found')
    sys.exit(wrong > 0)


main()
