"""The top of the page: which file, undo and redo, variants, reports, how the user likes to see things."""

from __future__ import annotations

from collections.abc import Callable

from nicegui import events, ui

from cardan.app.state import work as papers
from cardan.app.state.document import full_name, read
from cardan.app.state.jobs import Jobs
from cardan.app.state.session import Session
from cardan.app.state.variants import LONGEST
from cardan.errors import InputError, Problem
from cardan.io import starter
from cardan.reading.limits import MAX_BYTES
from cardan.report.block import Page
from cardan.texts import LANGUAGES, _, visible
from cardan.units import DIMENSIONS, label

from . import widgets as toasts
from .blocks import PageView
from .download import Exports, Making, ReportMenu
from .widgets import Live, Timer, asking, drop_down, menu_item, pop_up, sending

LOOK = 2.0  # seconds between two looks whether somebody else changed the file


class Header:
    """The top of the page. jobs: where reports are made."""

    def __init__(self, session: Session, jobs: Jobs) -> None:
        self.session = session
        with ui.element("header").classes("top"):
            ui.link(_("Skip to the drive"), "#main").classes("skip").props('data-mark="skip"')
            ui.link("cardan", "/").classes("brand")
            self.title = Live(tag="h1").classes("unseen") if not session.empty else None
            self.name = ui.label().classes("name").props('data-mark="file-name"').props("role=status")
            ui.element("div").classes("gap")
            if not session.empty:
                self.undo = _button("undo", _("Undo (ctrl Z)"), session.undo)
                self.redo = _button("redo", _("Redo (ctrl shift Z)"), session.redo)
                self.variants = VariantsMenu(session, jobs)
                self.report = ReportMenu(session, jobs)
            self._files()
            SettingsMenu(session)
        self._disk()
        self._follow()
        session.listen("file", self._follow)

    def _follow(self) -> None:
        session = self.session
        if session.empty:
            self.name.set_text("")
            return
        state = _("saved") if session.saved else _("not saved")
        foreign = session.foreign is not None
        if foreign:
            state = _("changed on the disk")
        name = visible(session.name) or _("new drive")
        if self.title is not None:
            self.title.say(name)
        self.name.set_text(f"{name} {'○' if session.saved and not foreign else '●'} {state}")
        self.disk.set_visibility(foreign)
        if foreign:
            self.told.set_text(_("Somebody else has changed {name} on the disk.").format(name=name))
        self.undo.set_enabled(bool(session.history.before))
        self.redo.set_enabled(bool(session.history.behind))

    def _disk(self) -> None:
        """Tell once somebody else writes the file, and offer what can be done."""
        with ui.element("div").classes("disk").props('role=alert data-mark="disk"') as self.disk:
            self.told = ui.label()
            self._ways(lambda: None)
        self.disk.set_visibility(False)
        Timer(self.session, self.disk, LOOK, self.session.look, once=False)

    def _ways(self, then: Callable[[], object]) -> None:
        """Offer to take what somebody else wrote, or to keep both."""

        def act(how: Callable[[], None], told: str) -> None:
            if self._try(how):
                then()
                with self.session.speaking():
                    toasts.done(told.format(name=visible(self.session.name)))

        def apart() -> None:
            self.session.save(self.session.workspace.free(self.session.name))

        again, kept = _("{name} is read again; undo goes back."), _("{name} is saved.")
        reload = ui.button(_("Read it again"), on_click=lambda: act(self.session.reload, again))
        reload.props('flat dense no-caps data-mark="disk-reload"')
        both = ui.button(_("Keep both"), on_click=lambda: act(apart, kept))
        both.props('flat dense no-caps data-mark="disk-both"')

    def _files(self) -> None:
        with drop_down(_("File"), "file-menu"):
            menu_item(_("New"), lambda: self._leave(lambda: self.session.open(starter(), saved=False)), "file-new")
            menu_item(_("Open …"), self.open, "file-open")
            menu_item(_("Send a file …"), self.send, "file-send")
            if not self.session.empty:
                menu_item(_("Save"), self.save, "file-save")
                menu_item(_("Save as …"), self.save_as, "file-save-as")
                menu_item(_("Download"), self.download, "file-download")
            menu_item(_("Examples"), lambda: self._leave(lambda: self.session.open("")), "file-examples")

    def _leave(self, then: Callable[[], object]) -> None:
        """Do what leaves the present file, after a question where it is not saved."""
        if self.session.empty or self.session.saved or not self.session.history.before:
            then()
            return
        with self.session.speaking(), asking("leave-file") as dialog:
            ui.label(_("The drive is not saved. Leave it?"))
            with ui.row().classes("ends"):
                ui.button(_("Stay"), on_click=dialog.close).props("flat no-caps")
                ui.button(_("Leave"), on_click=lambda: self._after(dialog, then)).props("no-caps color=negative").props(
                    'data-mark="leave"'
                )

    def open(self) -> None:
        """Offer the files of the workspace."""
        with self.session.speaking(), asking("open-file") as dialog:
            _of_folder(self.session, dialog, lambda name: self._after(dialog, lambda: self._take(name)), "", "file")

    def _after(self, dialog: ui.dialog, then: Callable[[], object]) -> None:
        """Close a dialog and go on."""
        dialog.close()
        with self.session.speaking():
            then()

    def _take(self, name: str) -> None:
        self._leave(lambda: self._try(lambda: self.session.open(self.session.workspace.read(name), name)))

    def send(self) -> None:
        """Take a file from the user's disk."""

        async def taken(event: events.UploadEventArguments) -> Callable[[], None]:
            content = await event.file.read()
            return lambda: self._sent(event.file.name, content)

        with self.session.speaking():
            title = _("A drive file, at most {size} MB").format(size=MAX_BYTES // 10**6)
            sending("send-file", title, taken, upload="upload", suffixes=(".toml", ".json"), most=MAX_BYTES)

    def _sent(self, name: str, content: bytes) -> None:
        with self.session.speaking():
            self._leave(lambda: self._try(lambda: self.session.take(name, content)))

    def save(self) -> None:
        """Write the file; ask for a name first where it has none."""
        if not self.session.name:
            self.save_as()
        else:
            self._write(self.session.name, lambda: None)

    def save_as(self) -> None:
        """Ask for a name and write the file."""
        session = self.session
        with session.speaking(), asking("save-file-as") as dialog:
            proposed = session.name or session.workspace.free(session.example or "drive")
            ui.label(_("Save as …")).classes("head")
            name = ui.input(_("name"), value=proposed).props('autofocus outlined dense data-mark="save-name"')

            def named() -> None:
                self._write(name.value.strip(), dialog.close)

            name.on("keydown.enter", named)
            with ui.row().classes("ends"):
                ui.button(_("Close"), on_click=dialog.close).props("flat no-caps")
                ui.button(_("Save"), on_click=named).props("no-caps").props('data-mark="save-named"')

    def _write(self, name: str, then: Callable[[], object], *, over: bool = False) -> None:
        """Write the file under a name; ask where something stands there that is not ours."""

        def act() -> None:
            obstacle = "" if over else self.session.obstacle(name)
            if obstacle:
                self._ask_over(name, obstacle, then)
                return
            self.session.save(name, over=over)
            then()
            toasts.done(_("{name} is saved.").format(name=visible(self.session.name)))

        self._try(act)

    def _ask_over(self, name: str, obstacle: str, then: Callable[[], object]) -> None:
        """Ask whether to write over what stands there."""
        told = _("There is another file {name}. Replace it?")
        if obstacle == "changed":
            told = _("Somebody else has changed {name} on the disk since it was read here. Replace it?")
        with asking("write-over", role="alertdialog") as dialog:

            def left() -> None:
                dialog.close()
                then()

            def replaced() -> None:
                dialog.close()
                self._write(name, then, over=True)

            ui.label(told.format(name=visible(full_name(name))))
            with ui.row().classes("ends"):
                ui.button(_("Stay"), on_click=dialog.close).props("flat no-caps autofocus")
                if obstacle == "changed":
                    self._ways(left)
                ui.button(_("Replace"), on_click=replaced).props('no-caps color=negative data-mark="replace"')

    def download(self) -> None:
        """Give the file to the browser."""
        ui.download.content(self.session.document.text, self.session.name or "drive.toml", "application/toml")

    def _try(self, act: Callable[[], None]) -> bool:
        with self.session.speaking():
            try:
                act()
            except InputError as error:
                toasts.refused(error)
                return False
        return True


def _of_folder(session: Session, dialog: ui.dialog, taken: Callable[[str], None], mark: str, classes: str = "") -> None:
    """Show the files of the folder to choose one, in a dialog."""
    ui.label(_("Files of the folder, the newest first")).classes("head")
    names = session.workspace.names()
    if not names:
        ui.label(_("There is no drive file yet.")).classes("hint")
    with ui.element("div").classes("files"):
        for name in names:
            button = ui.button(visible(name), on_click=lambda name=name: taken(name))
            button.props(f"flat no-caps align=left{mark}").classes(classes)
    ui.button(_("Close"), on_click=dialog.close).props("flat no-caps")


def _button(icon: str, title: str, act: Callable[[], None]) -> ui.button:
    button = ui.button(icon=icon, on_click=act).props(f'flat dense round data-mark="{icon}"')
    return button.props(f'aria-label="{title}" title="{title}"')


# How the user likes to see things: language, light or dark, units, decimal sign.

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
        button = ui.button(icon="tune").props(f'flat dense round aria-label="{title}" title="{title}"')
        with button.props('data-mark="settings"'), pop_up(title), ui.element("div").classes("settings"):
            themes = {"auto": _("as the system"), "light": _("light"), "dark": _("dark")}
            ui.label(_("Page")).classes("head")
            ui.toggle(
                themes, value=session.choices.theme, on_change=lambda event: session.choose(theme=event.value)
            ).props("dense no-caps flat").props('data-mark="theme"')
            ui.label(_("Decimal sign")).classes("head")
            ui.toggle(
                {".": "1.5", ",": "1,5"},
                value=session.reader.sign,
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
    titles = (_("length"), _("angle"), _("speed"), _("torque"), _("force"), _("mass"), _("stress"), _("power"))
    return dict(zip(CHOSEN, titles, strict=True))


# Variants of the drive, kept side by side: keep one, go back to one, compare them.


class VariantsMenu:
    """The menu of the variants. jobs: where they are compared."""

    def __init__(self, session: Session, jobs: Jobs) -> None:
        self.session = session
        self._jobs = jobs
        with (
            drop_down(_("Variants"), "variants-menu", role="dialog").on("before-show", self._mark_own) as self._menu,
            ui.element("div").classes("variants"),
        ):
            self._act("bookmark_add", _("Keep this as a variant …"), self.keep, "keep")
            self._act("folder_open", _("Keep a file as a variant …"), self._keep_file, "keep-file")
            self._act("compare_arrows", _("Compare …"), self.compare, "compare")
            self._list = ui.element("div")
        self._rows: dict[str, tuple[ui.element, ui.button]] = {}
        session.listen("variants", self._count)
        self._count()

    def keep(self) -> None:
        """Ask for a name and keep the drive as it is."""
        session = self.session
        if session.document.drive is None or session.drive is None:
            toasts.refused(_("Only a drive without mistakes can be kept as a variant."))
            return
        text, drive = session.document.text, session.drive
        self._ask(
            _("Keep this as a variant"),
            session.variants.free_name(),
            _("Keep"),
            lambda name: session.keep(session.variants.keeping(name, text, drive)),
        )

    def compare(self) -> None:
        """Show the variants and the drive as it is side by side."""
        with self.session.speaking():
            rows = self.session.variants.compared(self.session.document.text, self.session.drive)
            if len(rows) < 2:
                self._explain()
                return
            question = papers.asked_for(self.session, papers.COMPARE, variants=rows)
            if question is not None:
                Making(self.session, self._jobs, question, _("Variants side by side"), self._show)

    def _count(self) -> None:
        count = len(self.session.variants)
        slot = self._menu.parent_slot
        assert slot is not None
        slot.parent.props["label"] = f"{_('Variants')} ({count})" if count else _("Variants")
        self._filled()

    def _filled(self) -> None:
        """List the variants; not as the menu opens: what is pressed there must still be there."""
        names = [one.name for one in self.session.variants]
        if names == list(self._rows):
            return
        self._list.clear()
        self._rows.clear()
        with self.session.speaking(), self._list:
            if names:
                ui.separator()
            for name in names:
                with ui.element("div").classes("row").props(f'role=group aria-label="{_quoted(name)}"') as row:
                    go = ui.button(name, on_click=lambda name=name: self._switch(name))
                    go.props('flat no-caps align=left icon=none data-mark="variant"').classes("name")
                    self._small("edit", _("Rename {name}"), name, self._rename)
                    self._small("download", _("Save {name} as a file"), name, self._save)
                    self._small("delete", _("Delete {name}"), name, self._delete)
                self._rows[name] = row, go
        self._mark_own()

    def _mark_own(self) -> None:
        """Mark the variant that the drive is as it stands."""
        shown = self.session.variants.of_text(self.session.document.text)
        for name, (row, go) in self._rows.items():
            here = shown is not None and shown.name == name
            row.classes(**{"add" if here else "remove": "on"})
            go.props(f"icon={'check' if here else 'none'}")

    def _act(self, icon: str, title: str, act: Callable[[], None], mark: str) -> None:
        def done() -> None:
            with self.session.speaking():
                act()

        ui.button(title, icon=icon, on_click=done).props(f'flat no-caps align=left data-mark="variants-{mark}"')

    def _small(self, icon: str, title: str, name: str, act: Callable[[str], None]) -> None:
        def done() -> None:
            with self.session.speaking():
                act(name)

        button = ui.button(icon=icon, on_click=done)
        button.props(
            f'flat dense round size=sm aria-label="{_quoted(title.format(name=name))}" data-mark="variant-{icon}"'
        )

    def _switch(self, name: str) -> None:
        with self.session.speaking():
            self.session.rewrite(self.session.variants.named(name).text)
            ui.notify(_("{name} is what you work on now; undo goes back.").format(name=name), position="top")

    def _rename(self, name: str) -> None:
        session = self.session
        self._ask(_("Another name"), name, _("Rename"), lambda new: session.keep(session.variants.renaming(name, new)))

    def _save(self, name: str) -> None:
        text = self.session.variants.named(name).text
        ui.download.content(text, f"{papers.safe(name, 'variant')}.toml", "application/toml")

    def _delete(self, name: str) -> None:
        with asking("variant-delete", role="alertdialog") as dialog:
            ui.label(_("Delete the variant {name}?").format(name=name))
            with ui.row().classes("ends"):
                ui.button(_("Stay"), on_click=dialog.close).props("flat no-caps")

                def gone() -> None:
                    dialog.close()
                    self.session.keep(self.session.variants.without(name))

                ui.button(_("Delete"), on_click=gone).props('no-caps color=negative data-mark="variant-gone"')

    def _keep_file(self) -> None:
        """Offer the files of the folder to be kept as variants."""
        with asking("variant-files") as dialog:

            def taken(name: str) -> None:
                dialog.close()
                self._take(name)

            _of_folder(self.session, dialog, taken, ' data-mark="variant-file"')

    def _take(self, name: str) -> None:
        session = self.session
        with session.speaking():
            try:
                found = read(session.workspace.read(name), session.workspace.enclosed)
                if found.drive is None:
                    raise InputError(found.problems or [Problem(name, _("describes a mechanism; variants are drives"))])
                label = name.removesuffix(".toml")[:LONGEST]
                session.keep(session.variants.keeping(label, found.text, found.drive))
            except InputError as error:
                toasts.refused(str(error))

    def _ask(self, title: str, proposed: str, act: str, named: Callable[[str], object]) -> None:
        """Ask for a name."""
        with asking("variant-naming") as dialog:
            ui.label(title).classes("head")
            ui.label(_("Save as …")).classes("head")
            name = ui.input(_("name"), value=proposed).props(
                f'autofocus outlined dense maxlength={LONGEST} data-mark="variant-name"'
            )

            def done() -> None:
                with self.session.speaking():
                    try:
                        named(str(name.value or ""))
                    except InputError as error:
                        toasts.refused(str(error))
                        return
                    dialog.close()

            name.on("keydown.enter", done)
            with ui.row().classes("ends"):
                ui.button(_("Close"), on_click=dialog.close).props("flat no-caps")
                ui.button(act, on_click=done).props('no-caps data-mark="variant-named"')

    def _explain(self) -> None:
        with asking("compare-explained") as dialog:
            ui.label(_("Nothing to compare with yet")).classes("head")
            ui.label(_("Keep the drive as a variant, change it, then compare: both stand side by side."))
            with ui.row().classes("ends"):
                ui.button(_("Close"), on_click=dialog.close).props("flat no-caps")

                def kept() -> None:
                    dialog.close()
                    with self.session.speaking():
                        self.keep()

                ui.button(_("Keep this as a variant …"), on_click=kept).props("no-caps")

    def _show(self, page: Page) -> None:
        """Show the variants side by side, over the whole window."""
        with asking("comparison", names="comparison", whole=True) as dialog:
            with ui.element("div").classes("bar"):
                ui.label(page.title).classes("title").props("role=heading aria-level=2")
                close = ui.button(icon="close", on_click=dialog.close)
                close.props(f'flat round dense autofocus aria-label="{_("Close")}" data-mark="comparison-close"')
            with ui.element("div").classes("body"):
                view = PageView(Exports(self.session, self._jobs))
            view.show(page)


def _quoted(text: str) -> str:
    """Return a text for an attribute in quotes."""
    return text.replace("\\", " ").replace('"', "'")
