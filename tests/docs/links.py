#!/usr/bin/env python3
"""links.py ROOT: each link and picture of the pages leads to a file, and each anchor to a heading of its page.

The pages are README.md, CONTRIBUTING.md, CHANGELOG.md, docs/*.md and docs/measured/*.md. Sources name only pages, scripts and
pictures of docs/ that are there. An anchor is made of a heading as GitHub makes it. Paths that a page has in backquotes, and
those in comments of the sources, are there; so are classes and functions in backquotes. A word in capitals in a path stands for
any name.
"""
import pathlib, re, sys

root = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(root / 'tests/platform'))
import tree

FILES = [root / name for name in tree.files(root) if name != 'CHANGELOG.md']
FOLDERS = sorted({file.relative_to(root).parts[0] for file in FILES if file.parent != root and not file.relative_to(root).parts[0].startswith('.')})
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


SOURCES = {'.c', '.cpp', '.h', '.hpp', '.in', '.py', '.sh', '.cmake', '.txt', '.json', '.v'}
PATH = rf'(?:{"|".join(FOLDERS)})/[\w/.-]*\w'
CLASS = r'(?:\w+::)*[A-Z][a-z0-9]+(?:[A-Z][a-z0-9]*)+(?:::\w+)*(?:\(\))?|(?:\w+::)+\w+(?:\(\))?|[a-z]\w*\(\)'
OTHERS = {'MaxArraySize', 'hitpipe', 'std'}  # of Slurm; namespaces


def is_there(path):
    """Of `rtl --hls` there are files hls/NAME.EXTENSION too, in the folder of the user."""
    return bool(re.search(r'(?<![A-Za-z])[A-Z]{3,}(?![A-Za-z])', path) or re.fullmatch(r'hls/[\w.]+', path) or (root / path).exists()
                or any(root.glob(path + '.*')))


def names_that_are_gone():
    """Each with the file that has it, and how many were looked at."""
    sources = [file for file in FILES if file.suffix in SOURCES and file.relative_to(root).parts[0] in FOLDERS]
    texts = {file: file.read_text(errors='replace') for file in sources}
    code = set()
    for file, text in texts.items():
        comment = r'//.*' if file.suffix in ('.c', '.cpp', '.h', '.hpp', '.in') else r'(?m)^\s*#.*'
        code |= set(re.findall(r'\w+', re.sub(comment, '', text)))
    for page in [root / 'README.md', root / 'CONTRIBUTING.md', *sorted((root / 'docs').glob('*.md'))]:
        for name in re.findall(r'`([^`\n]+)`', without_code(page.read_text())):
            if re.fullmatch(PATH, name): yield page, name, is_there(name)
            elif re.fullmatch(CLASS, name): yield page, name, set(re.findall(r'\w+', name)) <= code | OTHERS or 'NAME' in name
    for file, text in texts.items():
        # The Verilog and the headers that a test expects are in its text.
        if file.suffix not in ('.cpp', '.hpp') or file.name in ('module_test.cpp', 'copied_slabs_test.cpp'): continue
        for comment in re.findall(r'//.*', text):
            for name in re.findall(r'(?<![\w/.])' + PATH, comment): yield file, name, is_there(name)


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
    for file in FILES:
        if file.suffix not in TEXT: continue
        for name in re.findall(r'(?<![\w/.])docs/[\w/.-]+\.(?:md|py|sh|svg|png|csv)\b', file.read_text(errors='replace')):
            named += 1
            if (root / name).exists(): continue
            wrong += 1
            print(f'{file.relative_to(root)}: {name}: no such file')
    looked = 0
    for file, name, there in names_that_are_gone():
        looked += 1
        if there: continue
        wrong += 1
        print(f'{file.relative_to(root)}: {name}: not there')
    if links < 150 or named < 60 or looked < 300:
        wrong += 1
        print(f'only {links} links, {named} pages and {looked} names were found')
    sys.exit(wrong > 0)


main()
