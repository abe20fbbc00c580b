# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

"""Sphinx makes a site of the documents as they lie in the source; README.md is its first page."""
import pathlib
import posixpath
import re
import sys

project = "percuss"
copyright = "The percuss authors"
extensions = ["myst_parser", "sphinx.ext.autodoc"]
# the package as it lies in the source, with the libraries of PERCUSS_LIBRARY; what it needs besides is not looked at
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "client" / "python"))
autodoc_mock_imports = ["numpy", "pandas", "matplotlib", "mujoco"]
autodoc_member_order = "bysource"
python_use_unqualified_type_names = True
# annotations name types of other packages and private ones
nitpick_ignore_regex = [("py:.*", ".*")]
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
    """The links of docs/index.md to other pages, in their order, are the contents of the site."""
    if name != root_doc:
        return
    index = pathlib.Path(app.srcdir, "docs", "index.md").read_text(encoding="utf-8")
    pages = [posixpath.normpath(f"docs/{page}") for page in re.findall(r"\]\(([^)#:]+)\.md[)#]", index)]
    pages = "\n".join(dict.fromkeys(["docs/index", *pages]))
    source[0] += f"\n```{{toctree}}\n:hidden:\n\n{pages}\n```\n"


def setup(app):
    app.connect("source-read", list_pages)
    return {"parallel_read_safe": True}
