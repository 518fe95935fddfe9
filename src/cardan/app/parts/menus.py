"""Menus that the browser opens and closes by itself.

NiceGUI's own menus have the server say back whether they are open: on a busy server the answer to a click comes after
the next one, and closes a menu the user has just opened, or opens one that was closed.
"""

from __future__ import annotations

from nicegui import ui


def drop_down(title: str, mark: str, *, icon: str = "", look: str = "", closes: bool = True) -> ui.element:
    """Return a button with a menu below it; what is built within stands in the menu.

    icon: name of the icon before the title, none if empty; look: more of the button's properties.
    closes: whether a click in the menu closes it.
    """
    button = ui.element("q-btn-dropdown").props("flat dense no-caps color=primary").props(look)
    button.props["label"] = title
    button.props["data-mark"] = mark
    if icon:
        button.props["icon"] = icon
    return button.props("auto-close" if closes else "")


def pop_up() -> ui.element:
    """Return a menu that opens when what it stands in is clicked, and stays while its content is used."""
    return ui.element("q-menu").props("max-height=80vh")
