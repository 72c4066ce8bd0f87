# simart-kit. `make` lists what there is; every target makes the environment that it needs.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip install --quiet --constraint constraints.txt
# Stamps: an environment is made again only when what it depends on has changed.
APP := $(VENV)/app.stamp
DEV := $(VENV)/dev.stamp
DOCS := README.md $(wildcard docs/*.md)
# Help texts in the docs do not depend on the width of a terminal.
COG := COLUMNS=80 $(BIN)/cog
SCHEMA := $(BIN)/python -c 'from simart_kit import asset_schema, describe; \
	print(describe.schema_text(asset_schema.AssetTable), end="")'
WHEEL := build/wheel
# Modules are compiled once, also where the environment keeps Python from writing what it compiles.
COMPILE := $(BIN)/python -m compileall -q simart_kit plugins exporters
PYTEST := PYTHONDONTWRITEBYTECODE= $(BIN)/pytest
# A process for each processor; one that runs out of tests takes those of another.
PARALLEL := -n auto --dist worksteal

JUDGE := PYTHONPATH=tests $(BIN)/python -m judges --judges "$(JUDGES)" --assets "$(ASSETS)"

.PHONY: help demo test coverage slow check lint types docs docs-check fmt wheel bench real-objects judges judges-light \
	browser clean
.DEFAULT_GOAL := help

help:  ## List the targets.
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  %-12s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

demo: $(APP)  ## Convert the example cabinet to URDF, MJCF and USD.
	$(BIN)/simart-kit convert examples/cabinet.glb --out out/cabinet

test: $(DEV)  ## Run the tests, on all processors.
	$(PYTEST) $(PARALLEL)

coverage: $(DEV)  ## The same, more slowly, and report what they cover of the core.
	$(BIN)/coverage erase
	$(BIN)/coverage run -m pytest $(PARALLEL)
	$(BIN)/coverage combine --quiet
	$(BIN)/coverage report

slow: $(DEV)  ## Run the tests that take long: full-size model, trainings, installations.
	$(PYTEST) -m slow

check: lint types test docs-check  ## All of lint, types, test and docs-check.

lint: $(DEV)  ## Check style and format.
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(DEV)  ## Check types.
	$(BIN)/mypy

docs: $(DEV)  ## Write the generated tables of the documentation.
	$(COG) -r $(DOCS)
	$(SCHEMA) > docs/asset.schema.json

docs-check: $(DEV)  ## Check that the generated tables are current.
	$(COG) --check $(DOCS)
	$(SCHEMA) | diff docs/asset.schema.json -

fmt: $(DEV)  ## Format the code and fix what can be fixed.
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

wheel: $(DEV)  ## Build a wheel from the sdist and run the tests against it in a fresh environment.
	rm -rf dist $(WHEEL)
	$(BIN)/python -m build --no-isolation
	$(BIN)/check-wheel-contents dist/*.whl
	$(PYTHON) -m venv $(WHEEL)/venv
	$(WHEEL)/venv/bin/python -m pip install --quiet --constraint constraints.txt "$$(echo dist/*.whl)[test]"
	cp -r tests docs examples README.md pyproject.toml $(WHEEL)
	cd $(WHEEL) && venv/bin/pytest $(PARALLEL)

bench: $(APP)  ## Time conversions, scoring, label transfer, voxelisation and USD against its public converter.
	$(BIN)/python tests/bench.py
	$(BIN)/python tests/bench_scoring.py
	$(BIN)/python tests/bench_transfer.py
	$(BIN)/python tests/bench_voxels.py
	$(BIN)/python tests/bench_usd.py

real-objects: $(APP)  ## Make real objects with ground truth of public packages (560 MB to download); OUT=folder.
	$(BIN)/python -m tests.public_objects $(or $(OUT),out/real-objects)

judges: $(DEV)  ## Ask other tools about our exports, each in its own environment (4.5 GB); JUDGES=a,b ASSETS=c,d.
	$(JUDGE) --seeded

judges-light: $(DEV)  ## The same, but only the tools that the tests need anyway.
	$(JUDGE) --seeded --light

browser:  ## Install chromium by apt for the tests of pages, where no browser is found.
	@for name in chromium chromium-browser google-chrome google-chrome-stable; do \
		if command -v $$name > /dev/null; then echo "browser found: $$name"; exit 0; fi; \
	done; \
	echo "no browser found: installing Debian's chromium with apt-get, about 400 MB"; \
	as_root=$$([ "$$(id -u)" = 0 ] || echo sudo); \
	$$as_root apt-get update --quiet && $$as_root apt-get install --quiet --yes --no-install-recommends chromium

clean:  ## Remove what was built, but not the environment.
	rm -rf build dist out .coverage .mypy_cache .ruff_cache .pytest_cache

$(BIN)/python:
	$(PYTHON) -m venv $(VENV)

$(APP): pyproject.toml constraints.txt | $(BIN)/python
	@echo "installing into $(VENV): a minute or two, about 1.4 GB"
	$(PIP) --editable .
	@$(COMPILE)
	@touch $@

$(DEV): pyproject.toml constraints.txt | $(BIN)/python
	@echo "installing the test and lint tools too into $(VENV)"
	$(PIP) --editable '.[dev]'
	@$(COMPILE)
	@touch $@
