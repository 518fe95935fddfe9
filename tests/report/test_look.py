"""A firm's own look of a report: one template file for PDF, HTML and workbook, or one clear message."""

import re
from dataclasses import fields, replace
from pathlib import Path

import openpyxl
import pypdf
import pytest

from cardan.drive.drive import Drive
from cardan.drive.settings import TitleBlock
from cardan.errors import InputError
from cardan.mechanisms import load_mechanism
from cardan.report.look import FIELDS, Colours, Line, Look, look_of, pieces
from cardan.report.mechanism import content as of_mechanism
from cardan.report.render.renderer import renderer_for
from cardan.report.report import report

SLIDER = Path(__file__).parents[2] / "examples" / "mechanisms" / "crank-slider.toml"
SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 60"><rect width="200" height="60" fill="#00f"/></svg>'
TEMPLATE = """format = 1
paper = "us-letter"
logo = "firm.svg"
style = "firm.css"

[colours]
accent = "#aa1111"

[type]
headings = "DejaVu Serif"
size_pt = 9

[head]
left = "{client}, {drawing_number}"
right = "{title}"

[foot]
left = "Axle & Sons <Ltd> #1 $"
middle = "{revision}"
right = "sheet {page} of {pages}"
"""


@pytest.fixture
def firm(tmp_path):
    (tmp_path / "firm.svg").write_text(SVG)
    (tmp_path / "firm.css").write_text("h1 { letter-spacing: 1px }")
    (tmp_path / "firm.toml").write_text(TEMPLATE)
    return tmp_path / "firm.toml"


@pytest.fixture
def drive():
    return replace(
        Drive.from_angles([0.2, 0.2]),
        name="two joints",
        report=TitleBlock(client='Müller "& Co', drawing_number="D-1"),
    )


def squeezed(text):
    return re.sub(r"\s", "", text)


def fonts_of(pdf):
    """Return the names of the fonts of a PDF, all in one."""
    return " ".join(
        str(font.get_object()["/BaseFont"]) for page in pdf.pages for font in page["/Resources"]["/Font"].values()
    )


@pytest.mark.slow
def test_paper_head_foot_and_type_of_a_pdf(firm, drive, tmp_path):
    pdf = pypdf.PdfReader(report(drive, None, tmp_path / "r.pdf", template=firm))
    assert [round(float(one)) for one in pdf.pages[0].mediabox[2:]] == [612, 792]  # 8.5 x 11 inches
    count = len(pdf.pages)
    texts = [squeezed(page.extract_text()) for page in pdf.pages]
    for k, text in enumerate(texts, start=1):
        assert squeezed(f"Axle & Sons <Ltd> #1 $sheet {k} of {count}") in text
        assert text.startswith(squeezed('Müller "& Co, D-1two joints')) == (k > 1)  # the first has a head of its own
    assert "DejaVuSerif-Bold" in fonts_of(pdf)
    usual = report(drive, None, tmp_path / "usual.pdf")
    assert "DejaVuSerif-Bold" not in fonts_of(pypdf.PdfReader(usual))
    assert [round(float(one)) for one in pypdf.PdfReader(usual).pages[0].mediabox[2:]] == [595, 842]


def test_colours_style_sheet_and_head_of_a_page(firm, drive, tmp_path):
    text = report(drive, None, tmp_path / "r.html", template=firm).read_text()
    assert ":root { --accent: #aa1111; }" in text
    assert "h1 { letter-spacing: 1px }" in text
    assert "size: letter" in text
    assert '@bottom-right { content: "sheet " counter(page) " of " counter(pages);' in text
    assert "Axle & Sons" not in text  # a string of CSS ends at no letter of the user
    assert r'@top-left { content: "Müller \22 \26  Co" ", " "D-1";' in text
    assert "data:image/svg+xml" in text
    usual = report(drive, None, tmp_path / "usual.html").read_text()
    assert "#aa1111" not in usual
    assert usual.count(":root") == 1


@pytest.mark.slow
def test_head_foot_and_colours_of_a_workbook(firm, drive, tmp_path):
    book = openpyxl.load_workbook(report(drive, None, tmp_path / "r.xlsx", template=firm))
    sheet = book.worksheets[1]
    said = (sheet.oddHeader.left, sheet.oddFooter.left, sheet.oddFooter.right)
    assert [one.text.strip() for one in said] == [
        'Müller "&& Co, D-1',  # & begins a command there
        "Axle && Sons <Ltd> #1 $",
        "sheet &P of &N",
    ]
    assert sheet.page_setup.paperSize == 1
    assert sheet["A1"].font.color.rgb == "FFAA1111"


@pytest.mark.parametrize(
    ("lines", "says"),
    [
        ("[colours]\nink = 'red'", "colours.ink: 'red' is not a colour; write it as #1f4e8c"),
        ("[colours]\nacent = '#ffffff'", "colours.acent: unknown key; the nearest known one is accent"),
        ("[head]\nleft = '{firm}'", "head.left: {firm} stands for nothing; known are {title}"),
        ("[foot]\nleft = '{page:>9}'", "foot.left: {page} stands for nothing"),
        ("[foot]\nmiddle = '{page'", "foot.middle: '{page' cannot be read"),
        ("paper = 'a3'", "paper: 'a3' is none of a4, us-letter"),
        ("format = 2", "format: 2 is not allowed"),
        ("[type]\nsize_pt = 40", "type.size_pt: 40 is not allowed; allowed is at least 7 and at most 14"),
        ("[type]\nfolder = 'nowhere'", "type.folder: there is no such folder"),
        ("style = 'nowhere.css'", "style: cannot be read: No such file or directory"),
        ("style = 'bad.css'", "style: holds </"),
        ("logo = 'bad.css'", "logo: bad.css is not a picture in PNG or SVG"),
        ("colours = 3", "colours: must be a table, not 3"),
        ("a = ", "is not TOML"),
    ],
)
def test_what_is_wrong_with_a_template_is_told_with_its_key(tmp_path, lines, says):
    (tmp_path / "bad.css").write_text("</style><script>")
    (tmp_path / "bad.toml").write_text(lines)
    with pytest.raises(InputError) as caught:
        look_of(tmp_path / "bad.toml")
    (problem,) = caught.value.problems
    assert says in str(problem)
    assert str(tmp_path / "bad.toml") in str(problem)


def test_all_that_is_wrong_is_told_at_once_and_nothing_written(tmp_path):
    (tmp_path / "bad.toml").write_text("[colours]\nink = '1'\nmuted = '2'\n[head]\nleft = '{x}'\nlevel = 1")
    with pytest.raises(InputError) as caught:
        report(Drive.from_angles([0.2]), None, tmp_path / "r.html", template=tmp_path / "bad.toml")
    assert len(caught.value.problems) == 4
    assert not (tmp_path / "r.html").exists()


@pytest.mark.slow
def test_a_font_that_is_not_there_is_named(tmp_path):
    (tmp_path / "firm.toml").write_text("[type]\nfont = 'Nowhere Grotesk'")
    with pytest.raises(InputError, match=r"template: type\.font: no font 'Nowhere Grotesk' is installed"):
        report(Drive.from_angles([0.2]), None, tmp_path / "r.pdf", template=tmp_path / "firm.toml")
    assert not (tmp_path / "r.pdf").exists()


def test_an_empty_template_is_the_usual_look(tmp_path):
    (tmp_path / "firm.toml").write_text("")
    assert look_of(tmp_path / "firm.toml") == Look()


def test_placeholders_without_a_word_leave_nothing():
    assert list(pieces("{client}", {})) == []
    assert list(pieces("a {{b}}", {})) == [("words", "a {"), ("words", "b}")]
    assert {one.name for one in fields(TitleBlock)} - {"logo"} <= set(FIELDS)
    assert Colours().changed() == {}
    assert Line() == Line(left="", middle="", right="")


@pytest.mark.slow
def test_the_report_of_a_mechanism_wears_the_look_in_every_form(firm, tmp_path):
    said = of_mechanism(load_mechanism(SLIDER), TitleBlock(client="Axle & Co"), look=look_of(firm))
    made = {}
    for suffix in (".pdf", ".html", ".xlsx"):
        made[suffix] = tmp_path / f"m{suffix}"
        made[suffix].write_bytes(renderer_for(made[suffix], interactive=False)(said))
    pdf = pypdf.PdfReader(made[".pdf"])
    count = len(pdf.pages)
    assert [round(float(one)) for one in pdf.pages[0].mediabox[2:]] == [612, 792]
    assert "DejaVuSerif-Bold" in fonts_of(pdf)
    for k, page in enumerate(pdf.pages, start=1):
        assert squeezed(f"Axle & Sons <Ltd> #1 $sheet {k} of {count}") in squeezed(page.extract_text())
    text = made[".html"].read_text("utf8")
    assert ":root { --accent: #aa1111; }" in text
    assert "h1 { letter-spacing: 1px }" in text
    assert "data:image/svg+xml" in text
    book = openpyxl.load_workbook(made[".xlsx"])
    for sheet in book.worksheets:
        assert sheet.oddHeader.left.text.strip() == "Axle && Co,"  # without a drawing number
        assert sheet.oddFooter.right.text.strip() == "sheet &P of &N"
    assert book.worksheets[1]["A1"].font.color.rgb == "FFAA1111"
