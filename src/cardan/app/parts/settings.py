"""How the user likes to see things: language, light or dark, units, decimal sign."""

from __future__ import annotations

from nicegui import ui

from cardan.app.state.session import Session
from cardan.texts import LANGUAGES, _
from cardan.units import DIMENSIONS, label

from .menus import pop_up

CHOSEN = ("length", "angle", "angular_speed", "torque", "force", "mass", "stress", "power")
"""Dimensions whose unit a user may want otherwise."""


class SettingsMenu:
    """The menu of the user's choices."""

    def __init__(self, session: Session) -> None:
        self.session = session
        with ui.element("div").classes("languages").props("role=group"):
            for code, title in LANGUAGES.items():
                button = ui.button(code, on_click=lambda code=code: session.choose(language=code))
                button.props(f'flat dense no-caps size=sm aria-label="{title}"').props(f'data-mark="language-{code}"')
                if code == session.choices.language:
                    button.classes("on").props("aria-pressed=true")
        title = _("How to show it")
        with ui.button(icon="tune").props(f'flat dense round aria-label="{title}"').props('data-mark="settings"'):
            ui.tooltip(title)
            with pop_up(), ui.element("div").classes("settings"):
                themes = {"auto": _("as the system"), "light": _("light"), "dark": _("dark")}
                ui.label(_("Page")).classes("head")
                ui.toggle(
                    themes, value=session.choices.theme, on_change=lambda event: session.choose(theme=event.value)
                ).props("dense no-caps flat").props('data-mark="theme"')
                ui.label(_("Decimal sign")).classes("head")
                ui.toggle(
                    {".": "1.5", ",": "1,5"},
                    value=session.choices.decimal,
                    on_change=lambda event: session.choose(decimal=event.value),
                ).props("dense no-caps flat").props('data-mark="decimal"')
                ui.label(_("Units of the answers")).classes("head")
                for dimension, title in _dimensions().items():
                    options = {unit: label(unit) or unit for unit in DIMENSIONS[dimension]}
                    usual = next(iter(options))
                    with ui.element("div").classes("line"):
                        ui.label(title).classes("name")
                        ui.select(
                            options,
                            value=session.choices.units.get(dimension, usual),
                            on_change=lambda event, dimension=dimension: self._unit(dimension, event.value),
                        ).props(f'dense options-dense borderless aria-label="{title}" title="{title}"').props(
                            f'data-mark="unit-{dimension}"'
                        )

    def _unit(self, dimension: str, unit: str) -> None:
        kept = {one: held for one, held in self.session.choices.units.items() if one != dimension}
        usual = next(iter(DIMENSIONS[dimension]))
        self.session.choose(units=kept if unit == usual else {**kept, dimension: unit})


def _dimensions() -> dict[str, str]:
    titles = (
        _("length"),
        _("angle"),
        _("speed"),
        _("torque"),
        _("force"),
        _("mass"),
        _("stress"),
        _("power"),
    )
    return dict(zip(CHOSEN, titles, strict=True))
