# Two commands: `make demo` (events from a sentence) and `make test`. Each makes .venv if needed.

VENV := .venv
PROMPT ?= a red car drives left past two trees at dusk
DEMO_OUT ?= demo-output/demo.h5
# The first interpreter that is new enough; PYTHON=... overrides the search.
PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11; do \
	if $$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then echo $$p; break; fi; done)
PIP := $(VENV)/bin/python -m pip install --quiet --disable-pip-version-check -c constraints.txt

.PHONY: help demo test lint format clean

help:
	@echo "make demo    events, film, picture and page from a sentence, in $(dir $(DEMO_OUT))"
	@echo "make test    the default test suite"
	@echo "make lint    ruff, mypy, import rules"
	@echo "make format  let ruff rewrite the layout"
	@echo "make clean   remove .venv, caches and demo output"

demo: $(VENV)/.base
	@mkdir -p $(dir $(DEMO_OUT))
	$(VENV)/bin/texvent generate "$(PROMPT)" -o $(DEMO_OUT) --overwrite
	@echo "Open $(basename $(DEMO_OUT)).html in a browser, or watch $(basename $(DEMO_OUT)).mp4"

test: $(VENV)/.dev
	$(VENV)/bin/python -m pytest -q -n 2 --durations=5

lint: $(VENV)/.dev
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	$(VENV)/bin/mypy
	$(VENV)/bin/lint-imports --no-cache

format: $(VENV)/.dev
	$(VENV)/bin/ruff check --fix .
	$(VENV)/bin/ruff format .

clean:
	rm -rf $(VENV) .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache demo-output

$(VENV)/bin/python:
	@test -n "$(PYTHON)" || { echo "error: texvent needs Python 3.11 or newer; none was found. Install one, or name it: make PYTHON=/path/to/python3"; exit 2; }
	$(PYTHON) -m venv $(VENV)

$(VENV)/.base: $(VENV)/bin/python pyproject.toml constraints.txt
	@echo "installing texvent into $(VENV) (about a minute, once)"
	$(PIP) -e .
	@touch $@

$(VENV)/.dev: $(VENV)/bin/python pyproject.toml constraints.txt
	@echo "installing texvent and its test tools into $(VENV) (about a minute, once)"
	$(PIP) -e '.[dev]'
	@touch $@ $(VENV)/.base
