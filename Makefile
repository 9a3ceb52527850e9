# Two commands do everything, each from a fresh clone with Python 3.11+ and make:
#   make book    execute the chapters and build the site at _build/html/index.html
#   make test    run every test
# Others:
#   make bench   measure accuracy and time on this machine, beside other integrators (some minutes; installs the
#                bench extra first, and does without where it cannot be had); BENCH_ARGS=--quick for less
#   make accept  re-execute the source notebooks and store their new outputs (review them with git diff)
#   make lock    re-make requirements.lock from pyproject.toml
#   make clean   remove what was generated (the environment in .venv stays)
# Choose an interpreter with PYTHON=python3.12; pass options to pytest with PYTEST_ARGS="-k layers".

.DEFAULT_GOAL := help
.PHONY: help book test bench accept lock clean
.DELETE_ON_ERROR:

VERSION_CHECK := import sys; sys.exit(sys.version_info < (3, 11))
PYTHON ?= $(shell for p in python3 python3.11 python3.12 python3.13 python3.14; do \
	$$p -c '$(VERSION_CHECK)' >/dev/null 2>&1 && { echo $$p; break; }; done)
PYTEST_ARGS ?=
BENCH_ARGS ?=

VENV := .venv
READY := $(VENV)/.ready
BENCH_READY := $(VENV)/.ready-bench
RUN := $(VENV)/bin/python

help:
	@sed -n 's/^# \{0,1\}//p' Makefile

book: $(READY)
	@$(RUN) -m gearpair book

test: $(READY)
	@$(RUN) -m pytest $(PYTEST_ARGS)

bench: $(READY)
	@$(MAKE) --no-print-directory --silent $(BENCH_READY) || \
		echo "Going on without the bench extra; the next run tries again" >&2
	@$(RUN) -m benchmarks $(BENCH_ARGS)

$(BENCH_READY): $(READY)
	@echo "Adding the bench extra to $(VENV)"
	@$(RUN) -m pip install --quiet --disable-pip-version-check --retries 1 --constraint requirements.lock \
		$$($(RUN) -c 'import tomllib; \
		print(*tomllib.load(open("pyproject.toml", "rb"))["project"]["optional-dependencies"]["bench"])')
	@touch $@

accept: $(READY)
	@$(RUN) -m gearpair accept

$(READY): requirements.lock pyproject.toml
	@$(if $(PYTHON),$(PYTHON),false) -c '$(VERSION_CHECK)' || { \
		echo "gearpair needs Python 3.11 or newer; found $$($(or $(PYTHON),python3) --version 2>&1)." \
		"Install one, or name it: make PYTHON=/path/to/python3.11" >&2; exit 1; }
	@echo "Setting up $(VENV) from requirements.lock (a few minutes the first time)"
	@$(PYTHON) -m venv $(VENV)
	@$(RUN) -m pip install --quiet --disable-pip-version-check --requirement requirements.lock
	@$(RUN) -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	@$(RUN) -c 'import matplotlib.font_manager'
	@echo "Compiling the kernels (about a minute)"
	@$(RUN) -m gearpair.study.warm_up
	@touch $@

# The lock holds for every platform and for Python 3.11 and newer; pins that are already in it are kept where they
# still fit (delete the file first to take the newest of everything).
lock:
	@$(PYTHON) -m venv $(VENV)-lock
	@$(VENV)-lock/bin/python -m pip install --quiet --disable-pip-version-check uv
	$(VENV)-lock/bin/uv pip compile pyproject.toml --extra book --extra test --universal --python-version 3.11 \
		--quiet --no-emit-index-url --no-emit-find-links --annotation-style line \
		--custom-compile-command "make lock" --output-file requirements.lock

clean:
	rm -rf _build book/chapters .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	find gearpair tests benchmarks -name __pycache__ -type d -prune -exec rm -rf {} +

# The course (notebooks/assignments) has an environment of its own, .venv-teach, since nbgrader brings a notebook server:
#   make teach       grade the whole course headless: reference solutions, mistakes, hostile submissions, a class of forty
#   make lock-teach  re-make requirements.lock and, in step with it, requirements-teach.lock
.PHONY: teach lock-teach
TEACH_VENV := .venv-teach
TEACH_READY := $(TEACH_VENV)/.ready
TEACH_ARGS ?=

teach: $(TEACH_READY)
	@$(TEACH_VENV)/bin/python -m pytest -o addopts= -p no:cacheprovider -n 2 --dist loadfile tests/teach $(TEACH_ARGS)

$(TEACH_READY): requirements-teach.lock pyproject.toml
	@$(if $(PYTHON),$(PYTHON),false) -c '$(VERSION_CHECK)' || { echo "gearpair needs Python 3.11 or newer" >&2; exit 1; }
	@echo "Setting up $(TEACH_VENV) from requirements-teach.lock (a few minutes the first time)"
	@$(PYTHON) -m venv $(TEACH_VENV)
	@$(TEACH_VENV)/bin/python -m pip install --quiet --disable-pip-version-check --requirement requirements-teach.lock
	@$(TEACH_VENV)/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation \
		--editable .
	@$(TEACH_VENV)/bin/python -c 'import matplotlib.font_manager'
	@echo "Compiling the kernels (about a minute)"
	@$(TEACH_VENV)/bin/python -m gearpair.study.warm_up
	@touch $@

lock-teach: lock
	$(VENV)-lock/bin/uv pip compile pyproject.toml --extra teach --constraint requirements.lock --universal \
		--python-version 3.11 --quiet --no-emit-index-url --no-emit-find-links --annotation-style line \
		--custom-compile-command "make lock-teach" --output-file requirements-teach.lock
