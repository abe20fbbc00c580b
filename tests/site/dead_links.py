# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

"""dead_links.py FOLDER: links of its HTML pages to files or headings that are not there, a line each;
what leaves the folder is not looked at. Exit code 1 if there are any."""
import pathlib
import sys
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.links, self.names = [], {""}
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("href", "src") and value:
                self.links.append(value)
            elif key in ("id", "name") and value:
                self.names.add(value)


def main(folder):
    pages = {file.resolve(): Page(file) for file in folder.rglob("*.html")}
    dead = looked = 0
    for file, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            looked += 1
            target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            names = pages[target].names if target in pages else {""}
            if not target.is_file() or unquote(parts.fragment) not in names:
                print(f"{file.relative_to(folder.resolve())}: {link}")
                dead += 1
    if looked == 0:
        print(f"{folder}: no links at all")
    return dead > 0 or looked == 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
