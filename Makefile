# Two commands do everything, each from a fresh clone with Python 3.11+ and make:
#   make book         execute the chapters that changed and build the site at _build/html/index.html
#   make test         run every test
# Others:
#   make test-quick   the tests that are not marked slow, in some minutes
#   make teach        grade the whole course headless, in an environment of its own: reference solutions, mistakes,
#                     hostile submissions, a class of forty
#   make course       pack the course: gearpair-course-student.zip without solutions, gearpair-course-teacher.zip with them
#   make pdf          build the book, then print it to _build/gearpair.pdf (needs a Chromium, see check-site)
#   make check-site   build the book, then open every page and check it; needs Java, npm and a Chromium on the PATH (or
#                     CHROMIUM=/path/to/it); SITE_ARGS="-k links" for some of the gates
#   make check-all    test, teach, check-site, pdf, check-wheel, and the short ways of bench and stability, to their ends
#   make check-wheel  build the wheel, install it alone in an empty environment, run the README's example there
#   make bench        measure accuracy and time on this machine, beside other integrators (some minutes; installs the
#                     bench extra first, and does without where it cannot be had); BENCH_ARGS=--quick for less
#   make stability    run the chapters on other terms (another processor, one thread, other rounding) and compare their
#                     outputs with the stored ones (half an hour); CHAPTERS="impacts method" for some of them
#   make accept       re-execute the source notebooks and store their new outputs (review them with git diff);
#                     CHAPTERS="impacts method" for some of them
#   make lock-teach   re-make requirements.lock from pyproject.toml and, in step with it, requirements-teach.lock
#   make clean        remove what was generated (the environments stay)
# Choose an interpreter with PYTHON=python3.12; pass options to pytest with PYTEST_ARGS="-k layers".

.DEFAULT_GOAL := help
.PHONY: help book test test-quick bench stability accept lock clean check-all
.DELETE_ON_ERROR:

VERSION_CHECK := import sys; sys.exit(sys.version_info < (3, 11))
PYTHON ?= $(shell for p in python3 python3.11 python3.12 python3.13 python3.14; do \
	$$p -c '$(VERSION_CHECK)' >/dev/null 2>&1 && { echo $$p; break; }; done)
PYTEST_ARGS ?= -n 2 --dist loadfile --no-loadscope-reorder
BENCH_ARGS ?=
CHAPTERS ?=

VENV := .venv
READY := $(VENV)/.ready
BENCH_READY := $(VENV)/.ready-bench
RUN := $(VENV)/bin/python

help:
	@sed -n '/^#/!q; s/^# //p' Makefile

book: $(READY)
	@$(RUN) -m gearpair book

test: $(READY)
	@$(RUN) -m pytest $(PYTEST_ARGS)

test-quick: $(READY)
	@$(RUN) -m pytest $(PYTEST_ARGS) -m "not slow"

check-all:
	@$(MAKE) --no-print-directory test teach check-site pdf check-wheel
	@$(MAKE) --no-print-directory bench BENCH_ARGS=--quick
	@$(MAKE) --no-print-directory stability CHAPTERS="library method"

bench: $(READY)
	@$(MAKE) --no-print-directory --silent $(BENCH_READY) || \
		echo "Going on without the bench extra; the next run tries again" >&2
	@$(RUN) -m benchmarks $(BENCH_ARGS)

$(BENCH_READY): $(READY)
	@echo "Adding the bench extra to $(VENV)"
	@$(call install,$(VENV)) --constraint requirements.lock $(call extra,bench)
	@touch $@

stability: $(READY)
	@$(RUN) -m tools.other_terms $(CHAPTERS)

accept: $(READY)
	@$(RUN) -m tools.accept $(CHAPTERS)

# Before anything is written: an interpreter that will do, and leave to write.
CAN_START = @$(if $(PYTHON),$(PYTHON),false) -c '$(VERSION_CHECK)' || { \
	echo "gearpair needs Python 3.11 or newer; found $$($(or $(PYTHON),python3) --version 2>&1)." \
	"Install one, or name it: make PYTHON=/path/to/python3.11" >&2; exit 1; }; \
	test -w . || { echo "Nothing can be written in $(CURDIR): clone it to a directory of your own" >&2; exit 1; }

# $(call install,WHERE) PACKAGES: by uv, else by pip; $(call extra,NAME): what an extra of the project asks for.
install = $(PYTHON) tools/uv.py $(1) pip install
extra = $$($(RUN) -c 'import tomllib; \
	print(*tomllib.load(open("pyproject.toml", "rb"))["project"]["optional-dependencies"]["$(1)"])')

# $(call environment,WHERE,LOCK): the packages, the library, its kernels. The packages' files are compiled here, by all
# cores and without the packages' own tests, and not by the processes that first need them.
define environment
	$(CAN_START)
	@echo "Setting up $(1) from $(2)"
	@$(PYTHON) -m venv $(1)
	@$(call install,$(1)) --requirement $(2)
	@$(call install,$(1)) --no-deps --no-build-isolation --editable .
	@$(1)/bin/python -m compileall -qq -j 0 -x '/tests?/' $(1)/lib || true # a package may hold a file of another Python
	@$(1)/bin/python -c 'import matplotlib.font_manager'
	@echo "Compiling the kernels (a minute)"
	@$(1)/bin/python -m tools.warm_up
	@touch $@
endef

$(READY): requirements.lock pyproject.toml
	$(call environment,$(VENV),requirements.lock)

# The lock holds for every platform and for Python 3.11 and newer; pins that are already in it are kept where they
# still fit (delete the file first to take the newest of everything).
LOCK = $(PYTHON) tools/uv.py $(VENV)-lock pip compile pyproject.toml --universal --python-version 3.11 \
	--no-emit-index-url --no-emit-find-links --annotation-style line

lock:
	@$(PYTHON) -m venv $(VENV)-lock
	@$(LOCK) --extra book --extra test --custom-compile-command "make lock" --output-file requirements.lock

clean:
	rm -rf _build book/chapters .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	find gearpair tools tests benchmarks -name __pycache__ -type d -prune -exec rm -rf {} +

# The gates of the site, in a real browser, and the whole book as one PDF; both bring their own packages.
.PHONY: check-site pdf
SITE_ARGS ?=
SITE_READY := $(VENV)/.ready-site
AXE := axe-core@4.14.1

check-site: $(SITE_READY) book
	@GEARPAIR_SITE=_build/html $(RUN) -m pytest tests/site -p no:nbval --override-ini addopts= $(SITE_ARGS)
	@$(RUN) -m codespell_lib

pdf: $(SITE_READY) book
	@$(RUN) -m tools.pdf

$(SITE_READY): $(READY)
	$(CAN_START)
	@echo "Adding the site extra to $(VENV)"
	@$(call install,$(VENV)) --constraint requirements.lock $(call extra,site)
	@npm install --silent --no-save --no-audit --no-fund --prefix $(VENV) $(AXE)
	@touch $@

.PHONY: check-wheel
check-wheel: $(READY)
	$(CAN_START)
	@rm -rf dist $(VENV)-wheel
	@$(RUN) -m pip wheel --quiet --disable-pip-version-check --no-deps --no-build-isolation --wheel-dir dist .
	@$(PYTHON) -m venv $(VENV)-wheel
	@$(call install,$(VENV)-wheel) dist/*.whl
	@$(RUN) -m tools.check_wheel $(VENV)-wheel/bin/python
	@echo "The wheel works by itself: $$(ls dist)"

# The course (notebooks/assignments) has an environment of its own, since nbgrader brings a notebook server.
.PHONY: teach course lock-teach
TEACH_VENV := .venv-teach
TEACH_READY := $(TEACH_VENV)/.ready
TEACH_ARGS ?=

teach: $(TEACH_READY)
	@$(TEACH_VENV)/bin/python -m pytest -o addopts= -p no:cacheprovider -n 3 --no-loadscope-reorder \
		tests/teach $(TEACH_ARGS)

course: $(TEACH_READY)
	@$(TEACH_VENV)/bin/python -m tools.course_packs

$(TEACH_READY): requirements-teach.lock pyproject.toml
	$(call environment,$(TEACH_VENV),requirements-teach.lock)

lock-teach: lock
	@$(LOCK) --extra teach --constraint requirements.lock \
		--custom-compile-command "make lock-teach" --output-file requirements-teach.lock
