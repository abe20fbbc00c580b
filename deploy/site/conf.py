# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

"""Sphinx makes a site of the documents as they lie in the source; README.md is its first page."""
import re

project = "percuss"
copyright = "The percuss authors"
extensions = ["myst_parser"]
root_doc = "README"
include_patterns = ["README.md", "SECURITY.md", "CHANGELOG.md", "CONTRIBUTING.md", "docs/**", "client/python/README.md"]
source_suffix = {".md": "markdown"}
# links into a page, as repositories' hosts make them of headings
myst_heading_anchors = 4
html_theme = "alabaster"
html_theme_options = {"fixed_sidebar": True, "page_width": "1100px", "show_powered_by": False}
html_show_sourcelink = False
html_copy_source = False
# index.html leads to the first page
html_extra_path = ["extra"]
# blocks without a language are no Python
highlight_language = "none"


def list_pages(app, name, source):
    """README's links to other pages, in their order, are the contents of the site."""
    if name != root_doc:
        return
    pages = re.findall(r"\]\(([^)#:]+)\.md[)#]", source[0])
    pages = "\n".join(dict.fromkeys(pages))
    source[0] += f"\n```{{toctree}}\n:hidden:\n\n{pages}\n```\n"


def setup(app):
    app.connect("source-read", list_pages)
    return {"parallel_read_safe": True}
