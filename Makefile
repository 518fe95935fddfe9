# Every target sets up what it needs in .venv; a machine needs Python 3.11 or later and make, nothing else.

PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11; do \
	command -v $$p >/dev/null 2>&1 && $$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null \
	&& echo $$p && break; done)
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt
EXAMPLE ?= truck-printed-angles
WORKERS ?= 2

FILE ?=

# Every process that tests, pages and examples start would compile the modules anew.
unexport PYTHONDONTWRITEBYTECODE
# Workers share the processors, so that each does its sums on one.
test quick: export OPENBLAS_NUM_THREADS = 1

.PHONY: help report app test quick lint docs dist bench clean all

help:
	@echo "make report   the report of a shipped example (EXAMPLE=$(EXAMPLE)) as out/$(EXAMPLE).html"
	@echo "make app      the app in the browser, with a drive of your own by FILE=drive.toml"
	@echo "make test     all tests, docstring and documentation examples"
	@echo "make quick    the tests but for the slow ones, in under 3 minutes on two cores; one: make quick FILE=tests/drive/test_line.py"
	@echo "make lint     format, lint, types, import contracts; scripts of the app too where there is node"
	@echo "make docs     the documentation as docs/_build/html/index.html"
	@echo "make dist     wheel and source archive in dist/, checked and tried in an empty environment; list of parts out/sbom.json"
	@echo "make bench    benchmarks as JSON lines, each against its yardstick"
	@echo "make clean    remove everything made here"

report: $(VENV)/.run
	@mkdir -p out
	$(BIN)/cardan report examples/$(EXAMPLE).toml -o out/$(EXAMPLE).html

app: $(VENV)/.app
	$(BIN)/cardan app $(FILE)

test: $(VENV)/.test
	$(BIN)/python -m pytest -n $(WORKERS) --dist worksteal -q

quick: $(VENV)/.test
	$(BIN)/python -m pytest -n $(WORKERS) --dist worksteal -q -m "not slow" $(FILE)

lint: $(VENV)/.lint
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-logo
	$(BIN)/python -m tests.javascript

docs: $(VENV)/.docs
	@rm -f docs/_build/.whole
	$(BIN)/python -m sphinx -W --keep-going -j auto -b html docs docs/_build/html
	@touch docs/_build/.whole
	@echo "docs/_build/html/index.html"

dist: $(VENV)/.dist
	rm -rf dist out/empty
	$(BIN)/python -m build --outdir dist .
	$(BIN)/twine check --strict dist/*
	@mkdir -p out
	$(PYTHON) -m venv out/empty
	out/empty/bin/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt dist/*.whl
	cd out && empty/bin/cardan example $(EXAMPLE) --force && empty/bin/cardan report $(EXAMPLE).toml
	$(BIN)/cyclonedx-py environment --output-file out/sbom.json out/empty/bin/python
	@ls dist out/sbom.json

bench: $(VENV)/.run
	$(BIN)/python -m benchmarks

$(VENV)/.made:
	@test -n "$(PYTHON)" || { echo "cardan needs Python 3.11 or later; none was found (set PYTHON=...)" >&2; exit 1; }
	$(PYTHON) -m venv $(VENV)
	@touch $@

# One stamp for each set of extras; the package is installed in place, so sources need no new install.
$(VENV)/.run: $(VENV)/.made pyproject.toml constraints.txt
	$(PIP) --editable .
	@touch $@

$(VENV)/.app: $(VENV)/.made pyproject.toml constraints.txt
	$(PIP) --editable '.[app,pdf,signals,xlsx]'
	@touch $@ $(VENV)/.run

$(VENV)/.test: $(VENV)/.made pyproject.toml constraints.txt
	$(PIP) --editable '.[test,docs]'
	@touch $@ $(VENV)/.run $(VENV)/.app $(VENV)/.docs

$(VENV)/.lint: $(VENV)/.made pyproject.toml constraints.txt
	$(PIP) --editable '.[lint]'
	@touch $@ $(VENV)/.run

$(VENV)/.dist: $(VENV)/.made pyproject.toml constraints.txt
	$(PIP) --editable '.[release]'
	@touch $@ $(VENV)/.run

$(VENV)/.docs: $(VENV)/.made pyproject.toml constraints.txt
	$(PIP) --editable '.[docs]'
	@touch $@ $(VENV)/.run

clean:
	rm -rf $(VENV) out docs/_build build dist .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
