"""How the pages are built: everything is made here, nothing is fetched, neither by the builder nor by a reader."""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE / "extensions"), str(HERE.parent)]

import cardan  # noqa: E402

project = "cardan"
author = "the cardan authors"
copyright = author
version = release = cardan.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "numpydoc", "mathtext", "site_pages"]
exclude_patterns = ["_build", "extensions", "paper", "pictures", "reference/generated/*.md"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
nitpicky = False
language = "en"

myst_enable_extensions = ["dollarmath", "deflist", "colon_fence", "attrs_block"]
myst_heading_anchors = 3
myst_dmath_double_inline = False

autodoc_member_order = "bysource"
autodoc_typehints = "none"
autodoc_default_options = {"members": True}
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

html_theme = "furo"
html_title = f"cardan {version}"
html_static_path = ["static"]
html_css_files = ["cardan.css"]
html_math_renderer = "mathtext"
html_show_copyright = False
html_copy_source = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#00695c", "color-brand-content": "#00695c"},
    "dark_css_variables": {"color-brand-primary": "#4db6ac", "color-brand-content": "#4db6ac"},
}
pygments_style = "a11y-light"
pygments_dark_style = "a11y-high-contrast-dark"
