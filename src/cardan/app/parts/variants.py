"""Variants of the drive, kept side by side: keep one, go back to one, compare them."""

from __future__ import annotations

from collections.abc import Callable

from nicegui import ui

from cardan.app.state import papers
from cardan.app.state.document import read
from cardan.app.state.jobs import Jobs
from cardan.app.state.session import Session
from cardan.app.state.variants import LONGEST
from cardan.errors import InputError
from cardan.report.block import Page
from cardan.texts import _

from . import toasts
from .blocks import PageView
from .dialogs import asking
from .download import Exports
from .making import Making
from .menus import drop_down


class VariantsMenu:
    """The menu of the variants.

    jobs: where they are compared.
    """

    def __init__(self, session: Session, jobs: Jobs) -> None:
        self.session = session
        self._jobs = jobs
        ui.add_head_html('<link rel="stylesheet" href="/cardan/variants.css">')
        with drop_down(_("Variants"), "variants-menu").on("before-show", self._filled) as self._button:
            self._list = ui.element("div").classes("variants")
        self._listed: object = None
        session.listen("variants", self._count)
        self._count()

    def keep(self) -> None:
        """Ask for a name and keep the drive as it is."""
        session = self.session
        if not session.document.valid or session.drive is None:
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
        self._button.props["label"] = f"{_('Variants')} ({count})" if count else _("Variants")
        self._filled()

    def _filled(self) -> None:
        """Fill the menu as it opens, where it would show something else."""
        session = self.session
        shown = session.variants.of_text(session.document.text)
        now = [one.name for one in session.variants], shown and shown.name
        if now == self._listed:
            return
        self._listed = now
        self._list.clear()
        with session.speaking(), self._list:
            self._act("bookmark_add", _("Keep this as a variant …"), self.keep, "keep")
            self._act("folder_open", _("Keep a file as a variant …"), self._keep_file, "keep-file")
            self._act("compare_arrows", _("Compare …"), self.compare, "compare")
            if len(session.variants):
                ui.separator()
            for one in session.variants:
                here = shown is not None and one.name == shown.name
                with (
                    ui.element("div")
                    .classes("row on" if here else "row")
                    .props(f'role=group aria-label="{_quoted(one.name)}"')
                ):
                    go = ui.button(one.name, on_click=lambda name=one.name: self._switch(name))
                    go.props(f'flat no-caps align=left icon={"check" if here else "none"} data-mark="variant"').classes(
                        "name"
                    )
                    self._small("edit", _("Rename {name}"), one.name, self._rename)
                    self._small("download", _("Save {name} as a file"), one.name, self._save)
                    self._small("delete", _("Delete {name}"), one.name, self._delete)

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
        session = self.session
        with asking("variant-files") as dialog:
            ui.label(_("Files of the folder, the newest first")).classes("head")
            names = session.workspace.names()
            if not names:
                ui.label(_("There is no drive file yet.")).classes("hint")
            with ui.element("div").classes("files"):
                for name in names:

                    def taken(name: str = name) -> None:
                        dialog.close()
                        self._take(name)

                    ui.button(name, on_click=taken).props('flat no-caps align=left data-mark="variant-file"')
            ui.button(_("Close"), on_click=dialog.close).props("flat no-caps")

    def _take(self, name: str) -> None:
        session = self.session
        with session.speaking():
            try:
                found = read(session.workspace.read(name), session.workspace.enclosed)
                if found.drive is None:
                    raise InputError(found.problems)
                label = name.removesuffix(".toml")[:LONGEST]
                session.keep(session.variants.keeping(label, found.text, found.drive))
            except InputError as error:
                toasts.refused(str(error))

    def _ask(self, title: str, proposed: str, act: str, named: Callable[[str], object]) -> None:
        """Ask for a name."""
        with asking("variant-naming") as dialog:
            ui.label(title).classes("head")
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
