# Needs Python 3.11 or later, make and git; everything else goes into .venv.

PYTHON ?= python3
VENV := .venv
LOWEST := .venv-lowest
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet
# An installation is as old as the files that say what it consists of.
INSTALLATION := pyproject.toml hatch_build.py src/mudline/basics/version.py $(wildcard grammar/*.lark)
OUT := demo-output
CORE := $(addprefix tests/,language model/curves model/contact model/scene editing/comparison)
# More arguments for pytest or the benchmarks: make test ARGS="-k curves --no-cov", make bench ARGS=--quick
ARGS ?=

.DEFAULT_GOAL := help
.PHONY: help install demo test test-all test-fast test-lowest lint format typecheck index docs tutorials pictures studies dynamics bench fuzz mutants extension site serve build clean

help: ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-10s %s\n", $$1, $$2 }' Makefile

install: $(VENV)/.developer ## the project with every extra and the developer's tools, in .venv

# The file pip is what a venv that was broken off half-way does not have.
$(BIN)/pip:
	@$(PYTHON) -c 'import sys; sys.version_info >= (3, 11) or sys.exit("mudline needs Python 3.11 or later: make PYTHON=python3.11")'
	$(PYTHON) -m venv $(VENV)

$(VENV)/.user: $(INSTALLATION) | $(BIN)/pip
	$(PIP) install --editable .
	@touch $@

# Dependency groups are new in pip 25.1; Python 3.11 comes with an older one.
$(VENV)/.developer: $(INSTALLATION) | $(BIN)/pip
	$(PIP) install "pip>=25.1"
	$(PIP) install --group dev --editable ".[all,archive]"
	@touch $(VENV)/.user $@

# ------------------------------------------------------------------------------------------------------------- a look

SCREEN := 22
# run COMMAND,CODE: print it as a reader would type it, run it, show a screen of what it prints; it ends with CODE or 0.
define run
@printf '\n$$ %s\n' '$(1)'; PATH="$(CURDIR)/$(BIN):$$PATH"; $(1) >$(OUT)/screen.txt 2>&1; code=$$?; \
	awk 'NR <= $(SCREEN) { print } END { if (NR > $(SCREEN)) printf "... and %d lines more\n", NR - $(SCREEN) }' \
		$(OUT)/screen.txt; test $$code -eq $(or $(2),0)
endef

demo: $(VENV)/.user ## a look at what mudline does, on samples/
	@mkdir -p $(OUT)
	$(call run,mudline lint samples/broken.keyxm,1)
	$(call run,mudline convert samples/legacy-flowline.keyxm -o $(OUT)/legacy-flowline.json)
	$(call run,mudline convert samples/legacy-flowline.keyxm --to yaml)
	$(call run,mudline migrate --verify samples/legacy-flowline.keyxm -o $(OUT)/migrated-flowline.keyxm)
	$(call run,mudline curves samples/scr-touchdown.keyxm)
	$(call run,mudline evaluate samples/scr-touchdown.keyxm)
	@rm -f $(OUT)/screen.txt
	@printf '\nWhat was written is in $(OUT). To go on, in this terminal:\n\n    . $(BIN)/activate\n    mudline lint samples\n'

# ----------------------------------------------------------------------------------------------------------- the work

# Without the table of lines that no test meets, which takes as long as the total: .venv/bin/coverage report prints it.
test: $(VENV)/.developer ## the whole test suite, with coverage
	$(BIN)/python -m pytest --numprocesses auto --dist worksteal --cov --cov-report= $(ARGS)

test-all: $(VENV)/.developer ## the same with every case, and ten times as many examples of each property
	MUDLINE_TESTS=all $(BIN)/python -m pytest --numprocesses auto --dist worksteal $(ARGS)

test-fast: $(VENV)/.developer ## the unit tests of the core, in about a minute
	$(BIN)/python -m pytest --numprocesses auto -m "not slow" $(CORE) $(ARGS)

# Old libraries use what newer ones, which they depend on, warn of.
test-lowest: $(LOWEST)/.installed ## the tests but the slow ones, with the oldest libraries that are allowed
	$(LOWEST)/bin/python -m pytest --numprocesses auto -m "not slow and not untraced" -W ignore::DeprecationWarning $(ARGS)

# The oldest libraries were built for Python 3.11 and 3.12.
$(LOWEST)/.installed: pyproject.toml tests/helpers/lowest.py
	$(PYTHON) -m venv $(LOWEST)
	$(LOWEST)/bin/python -m pip --disable-pip-version-check --quiet install "pip>=25.1"
	$(LOWEST)/bin/python tests/helpers/lowest.py > $(LOWEST)/constraints.txt
	$(LOWEST)/bin/python -m pip --disable-pip-version-check --quiet install \
		--constraint $(LOWEST)/constraints.txt --group test --editable ".[all,archive]"
	@touch $@

lint: $(VENV)/.developer ## style, layout of the code, and the order of the layers
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports --no-logo

typecheck: $(VENV)/.developer ## mypy --strict on the code and the tests
	$(BIN)/mypy

format: $(VENV)/.developer ## put the code into its canonical layout
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

index: $(VENV)/.developer ## the index and the type stubs of the keywords' declarations again, after one is added
	$(BIN)/python -m tests.language.keywords.index

docs: index ## regenerate what docs/ takes from the program
	$(BIN)/python -m tests.docs.make

tutorials: $(VENV)/.developer ## execute the notebooks of docs/tutorials again
	$(BIN)/python -m tests.docs.tutorials

pictures: $(VENV)/.developer ## redraw the pictures of docs/images
	$(BIN)/python -m tests.docs.pictures
	$(BIN)/python -m tests.tools.reporting.browser

studies: $(VENV)/.developer ## measure the tables of docs/studies/ again (1 minute)
	$(BIN)/python -m tests.benchmarks.studies $(ARGS)

dynamics: $(VENV)/.developer ## time integration of a line on the seabed, and MoorDyn: docs/studies/benchmark.md (15 minutes)
	$(BIN)/python -m tests.benchmarks.dynamics $(ARGS)

bench: $(VENV)/.developer ## measure speed beside other programs, and write docs/benchmarks.md (25 minutes)
	$(BIN)/python -m tests.benchmarks $(ARGS)

fuzz: $(VENV)/.developer ## look for inputs that break a promise: ARGS="--seconds N --target NAME"
	$(BIN)/python -m tests.fuzz $(ARGS)

mutants: $(VENV)/.developer ## put small faults into a package, and see whether its tests notice: ARGS=curves (10 minutes)
	nice $(BIN)/python -m tests.mutants $(ARGS)

extension: ## the extension for VS Code, in editors/vscode (needs npm)
	npm install --silent --prefix editors/vscode
	npm run --silent --prefix editors/vscode package

# The pages are written first: with hooks, no other program than MkDocs could build the site of them.
site: $(VENV)/.developer ## the pages of docs/ as a site, in site/
	$(BIN)/python -m tests.docs.site build/site
	NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --strict --quiet --config-file build/site/mkdocs.yml --site-dir $(CURDIR)/site

serve: site ## the site at http://127.0.0.1:8000
	$(BIN)/python -m http.server --bind 127.0.0.1 --directory site 8000

build: $(VENV)/.developer ## the source archive and the wheel, in dist/
	$(BIN)/python -m hatchling build

clean: ## remove everything that can be made again
	rm -rf editors/vscode/node_modules editors/vscode/dist editors/vscode/LICENSE.txt editors/vscode/*.vsix
	rm -rf $(VENV) $(LOWEST) .bench $(OUT) dist build site htmlcov .coverage .coverage.* .hypothesis .import_linter_cache .mypy_cache .pytest_cache .ruff_cache
	find src tests -type d -name __pycache__ -prune -exec rm -rf {} +
