"""What only a process of its own shows: imports, interruption, a reader that leaves, terminals, streams."""

import os
import pty
import signal
import subprocess
import sys

import pytest

from cardan.register import QUESTIONS
from cardan.version import VERSION
from tests.cli.conftest import EXAMPLES

TRUCK = EXAMPLES / "truck-printed-angles.toml"
HEAVY = ("numpy", "scipy", "matplotlib", "plotly", "numba", "jinja2", "tomlkit")
PIPES = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}


def modules_after(*arguments):
    """Return the names of all modules that a command has imported."""
    code = "import sys; from cardan.cli.main import main; main(sys.argv[1:]); print(*sys.modules, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=True)
    return set(done.stderr.split())


@pytest.mark.slow
@pytest.mark.parametrize("arguments", [("--help",), (), ("--version",)], ids=" ".join)
def test_help_imports_nothing_heavy(arguments):
    found = modules_after(*arguments)
    assert not found & set(HEAVY)
    assert {name for name in found if name.startswith("cardan.")} <= {
        "cardan.cli", "cardan.cli.main", "cardan.cli.app", "cardan.cli.shared.source",
        "cardan.texts", "cardan.errors", "cardan.later", "cardan.version",
        "cardan.register", "cardan.answers", "cardan.answers.question",
    }  # fmt: skip


@pytest.mark.slow
def test_motion_imports_no_plotting_and_no_compiler():
    found = modules_after("motion", str(TRUCK))
    assert not found & {"scipy", "matplotlib", "plotly", "numba", "jinja2", "tomlkit"}


@pytest.mark.slow
def test_version_and_help(process):
    done = process("--version", capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (0, f"cardan {VERSION}\n")
    bare = process(capture_output=True, text=True)
    helped = process("--help", capture_output=True, text=True)
    assert bare.returncode == helped.returncode == 0
    assert bare.stdout == helped.stdout
    for command in ("motion", "phasing", "articulation", "report", "init", "example", "convert", "schema", "calc"):
        assert command in helped.stdout
    assert max(map(len, helped.stdout.splitlines())) <= 80


@pytest.mark.parametrize(
    "command", ["motion", "phasing", "articulation", "report", "init", "example", "convert", "schema", "calc"]
)
def test_every_command_has_help_with_examples(cardan, command):
    done = cardan(command, "--help")
    assert done.code == 0
    assert f"$ cardan {command}" in done.out
    assert max(map(len, done.out.splitlines())) <= 80


@pytest.mark.parametrize("question", QUESTIONS.values(), ids=lambda one: one.name)
def test_every_question_is_a_command_with_the_help_of_the_register(cardan, question):
    *group, name = (question.command or question.name).split()
    if name.startswith("--"):  # an option of the command of another question
        said = " ".join(cardan(*group, "--help").out.split())
        assert f" {name} " in said
        assert all(f" {name}" in example for example in question.examples)
        return
    for called in (name, *question.aliases) if group != ["calc"] else ():
        said = " ".join(cardan(*group, called, "--help").out.split())
        assert question.help in said
        assert all(f"$ {example}"[:60] in said for example in question.examples)


def defaults():
    """Let ctrl-C reach the child even where the tests themselves run without it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.slow
def test_ctrl_c_ends_long_work_in_one_line(process):
    """The pipe is full and nobody reads on, so the command is still at work when the signal comes."""
    child = process(
        "motion", TRUCK, "--angle-step", 0.01, "--csv", start=subprocess.Popen, preexec_fn=defaults, **PIPES
    )
    assert child.stdout.readline().startswith(b"angle_deg")
    child.send_signal(signal.SIGINT)
    _out, err = child.communicate(timeout=300)
    assert child.returncode == 130
    assert err.decode().splitlines() == ["error: interrupted; nothing was written"]


def test_ctrl_c_while_a_module_is_loaded_is_no_fault_of_cardan(cardan, monkeypatch):
    def interrupt(*_arguments, **_options):
        try:
            raise KeyboardInterrupt
        except KeyboardInterrupt as stopped:
            raise RuntimeError("Error calling __set_name__") from stopped

    monkeypatch.setattr("cardan.cli.loads.check.read", interrupt)
    done = cardan("check", TRUCK)
    assert (done.code, done.err.splitlines()) == (130, ["error: interrupted; nothing was written"])


def test_ctrl_c_while_a_file_is_written_leaves_no_file(cardan, tmp_path, monkeypatch):
    def interrupt(*_ways):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "replace", interrupt)
    for command in (("report", TRUCK), ("motion", TRUCK, "--plot", "out.svg"), ("convert", TRUCK, "out.json")):
        done = cardan(*command)
        assert done.code == 130
        assert "interrupted" in done.err
        assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.parametrize("arguments", [("motion", TRUCK, "--angle-step", 0.01, "--csv"), ("motion", TRUCK)])
def test_a_reader_that_leaves_is_no_error(process, arguments):
    child = process(*arguments, start=subprocess.Popen, **PIPES)
    child.stdout.readline()
    child.stdout.close()
    with child.stderr:
        assert child.stderr.read() == b""
    assert child.wait(timeout=300) == 0


@pytest.mark.slow
def test_a_reader_that_was_never_there_is_no_error(process):
    reading, writing = os.pipe()
    os.close(reading)
    for arguments in (("--help",), ("motion", TRUCK), ("motion", TRUCK, "--json"), ("example",)):
        done = process(*arguments, stdout=writing, stderr=subprocess.PIPE)
        assert (done.returncode, done.stderr) == (0, b"")
    os.close(writing)


@pytest.mark.slow
@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
def test_a_full_output_is_told(process):
    with open("/dev/full", "w") as full:
        done = process("motion", TRUCK, stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 2
    assert done.stderr == "error: standard output: no space left on device\n"


@pytest.mark.slow
@pytest.mark.parametrize(("number", "name"), [(1, "out"), (2, "err")])
def test_streams_that_the_caller_closed_do_no_harm(process, number, name):
    def closed(*arguments):
        kept = {"stderr" if name == "out" else "stdout": subprocess.PIPE}
        return process(*arguments, text=True, preexec_fn=lambda: os.close(number), **kept)

    done, wrong = closed("motion", TRUCK), closed("motion", "nowhere.toml")
    assert (done.returncode, wrong.returncode) == (0, 2)
    assert not done.stderr
    assert not wrong.stdout


@pytest.mark.slow
def test_streams_without_a_reader_do_no_harm(process):
    done = process("motion", TRUCK, "--csv", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    assert done.returncode == 0


@pytest.mark.slow
def test_other_encodings_get_what_they_can_show(process):
    done = process("motion", TRUCK, capture_output=True, environment={"PYTHONUTF8": "0", "PYTHONIOENCODING": "ascii"})
    assert done.returncode == 0
    assert b"truck power unit" in done.stdout


def on_terminal(process, *arguments, **environment):
    """Return what a command prints on a terminal, and its exit code."""
    ours, theirs = pty.openpty()
    done = process(*arguments, stdout=theirs, stderr=theirs, environment={"TERM": "xterm-256color", **environment})
    os.close(theirs)
    parts = []
    try:
        while part := os.read(ours, 65536):
            parts.append(part)
    except OSError:  # the other side is closed
        pass
    os.close(ours)
    return done.returncode, b"".join(parts).decode()


@pytest.mark.slow
def test_colours_only_on_terminals_that_want_them(process):
    even = EXAMPLES / "z-arrangement.toml"
    code, coloured = on_terminal(process, "phases", even, NO_COLOR="")
    assert code == 0
    assert "\033[" in coloured
    assert "●" in coloured
    assert "\033[3" not in on_terminal(process, "phases", even, NO_COLOR="1")[1]
    assert "\033[" not in process("phases", even, capture_output=True, text=True, environment={"NO_COLOR": ""}).stdout
    assert "\033[1;31merror:" in on_terminal(process, "phases", "missing", NO_COLOR="")[1]
    assert "\033[" not in on_terminal(process, "phases", "missing", NO_COLOR="1")[1]


@pytest.mark.slow
def test_completion_knows_commands_options_and_names(process):
    def completed(line):
        environment = {
            "_CARDAN_COMPLETE": "complete_bash",
            "COMP_WORDS": line,
            "COMP_CWORD": str(len(line.split(" ")) - 1),
            "_TYPER_COMPLETE_ARGS": line,
        }
        return process(capture_output=True, text=True, environment=environment).stdout.split()

    assert completed("cardan mo") == ["motion", "mobility"]
    assert "--fix" in completed("cardan phasing --f")
    assert completed("cardan calc single_joint_e") == ["single_joint_extremes"]
    assert completed("cardan example single") == ["single-20deg"]
