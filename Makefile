# make          set up .venv, then run the whole study with the paper's parameters
# make quick    the same figures from small ensembles
# make test     set up .venv, then check and test the code
# make browser  install Chromium, in which the tests click through the report (as root, on Debian or
#               Ubuntu); without one they leave that out, where CI is set they fail
# make test-slurm  run the quick study through a Slurm of one node, which it installs and starts: root
#               on Debian, a quarter of an hour
# make bench    measure how fast it is, against C and LAMMPS: one table in some two and a half minutes;
#               make bench-release keeps a line of it for this release in benchmarks/history.csv
# make bench-ratios  fail if the kernel, over a C loop, or the start of a job, over the import of
#               numba, takes longer than it should: half a minute
# make full     the whole study, on which the pages in docs rest: two hours on two cores
# make verify   hold results/ against its checksums and the code of today
# make soak     kill the quick study ten times at random moments: its tables must stay the same
# make coverage list the lines and branches of the model that the tests do not reach: kernels run
#               interpreted, on few blocks; six minutes on two cores
# make mutants  put 300 errors into copies of the code, one into each, and count those that the tests
#               catch: an hour on two cores
# make docs     bring the pages in docs up to date with the study
# make archive  pack the study, code and results, into one file to deposit
# make redraw   draw all figures and pages again from results at hand, as those of an archive
# make test-versions  run the tests with the lowest versions that pyproject.toml allows, with the newest
#               and with pre-releases: some 40 minutes
# make lock     renew both lock files, for instance after changing a dependency in pyproject.toml, and
#               name the known vulnerabilities of what they pin
# make clean    remove .venv and caches; results/ stays

PYTHON ?= python3
VENV := .venv
PEERS := benchmarks/peers/peers.lock
BIN := $(VENV)/bin
PARALLEL := --numprocesses auto --dist loadfile --no-loadscope-reorder
# Tests of kernels on few blocks and in few steps, which together reach every line.
INTERPRETED := test_springs or test_release or test_laws or (small and 7-3) or wherever_it_is \
    or ((each_step or whole_runs) and grooves) or (stress_stays and leapfrog) or burst_alone \
    or collapses or turns_negative
PIP := $(BIN)/python -m pip --disable-pip-version-check
INSTALL := $(PIP) install --quiet --no-user --no-compile --no-build-isolation

# Settings of the user's shell that would send packages elsewhere or leave them uncompiled.
unexport PYTHONHOME PYTHONPATH PYTHONDONTWRITEBYTECODE PIP_PREFIX PIP_TARGET

.PHONY: all quick full test coverage browser test-slurm test-versions verify soak mutants bench bench-release bench-ratios docs \
    archive redraw setup lock clean

all: setup
	$(BIN)/snakemake

quick: setup
	$(BIN)/snakemake --configfile config/quick.yaml

full: setup
	$(BIN)/snakemake --configfile config/full.yaml

test: setup $(if $(CI),browser)
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/snakefmt --check Snakefile workflow
	$(BIN)/mypy
	$(BIN)/pytest $(PARALLEL)

# Coverage sees a kernel only if it is interpreted, and most of the rest is quicker if none is.
coverage: setup
	$(BIN)/coverage erase
	$(BIN)/coverage run -m pytest $(PARALLEL) $(addprefix tests/,model analysis simulation solver \
	    beyond cli claims/test_rule.py claims/test_samples.py validation/test_law_files.py) -k "not study_may"
	NUMBA_DISABLE_JIT=1 $(BIN)/coverage run -m pytest -W ignore $(PARALLEL) --dist load \
	    $(addprefix tests/solver/test_,springs.py release.py laws.py parallel.py) \
	    $(addprefix tests/simulation/test_,fields.py simulation.py) \
	    $(addprefix tests/validation/test_,lattice.py law_files.py specification.py) \
	    -k "$(INTERPRETED)"
	$(BIN)/coverage combine --quiet
	$(BIN)/coverage report

# What is there serves; Chrome does as well. Only this target, and CI, install anything.
browser:
	@for name in chromium chromium-browser google-chrome google-chrome-stable; do \
	    command -v $$name >/dev/null && exit; \
	done; \
	test -d "/Applications/Google Chrome.app" || \
	{ echo "Installing Chromium by apt-get" && apt-get update --quiet && \
	  apt-get install --yes --quiet --no-install-recommends chromium; }

verify: setup
	$(BIN)/springblock verify results

soak: setup
	$(BIN)/python tests/soak.py

mutants: setup
	$(BIN)/python tests/mutants.py

test-slurm: setup
	$(BIN)/python -m tests.slurm

# Without the extras `slurm` and `topography`, which need newer packages than the others do.
test-versions:
	@dir=$$(mktemp -d) && trap 'rm -rf "$$dir"' EXIT && \
	$(PYTHON) -m venv "$$dir/uv" && "$$dir/uv/bin/python" -m pip install --quiet --no-user uv && \
	for versions in "lowest-direct --prerelease=disallow" highest "highest --prerelease=allow"; do \
	    echo "Tests with --resolution=$$versions" && $(PYTHON) -m venv --clear "$$dir/venv" && \
	    "$$dir/uv/bin/uv" pip install --quiet --no-config --python "$$dir/venv" --group dev \
	        --resolution=$$versions --editable ".[study,mp4]" && \
	    PATH="$$dir/venv/bin:$$PATH" "$$dir/venv/bin/python" -m pytest --quiet --numprocesses auto \
	        --dist loadfile --no-loadscope-reorder || exit; \
	done

# Peers that cannot be installed are rows of the table that say so.
bench bench-release: setup
	$(INSTALL) --require-hashes -r $(PEERS) || echo "Going on without some peers." >&2
	$(BIN)/python -m benchmarks $(if $(filter bench-release,$@),--release)

bench-ratios: setup
	$(BIN)/python -m benchmarks.ratios

docs: full
	$(BIN)/springblock dictionary --output docs/tables.md
	cp results/accuracy.md results/claims.md results/mechanism.md results/beyond.md results/figures/figure_6.png docs
	$(BIN)/springblock simulate --n-blocks 120 --n-p 20 --n-s 20 --output results/front.parquet
	$(BIN)/springblock animate results/front.parquet --output docs/front.gif

# Files that git tracks and the results, without logs, run times and what `repair` has set aside.
archive:
	git ls-files -z | tar --create --gzip --file springblock-study.tar.gz --exclude results/logs \
	    --exclude results/benchmarks --exclude results/set-aside --null --files-from - results

# An archive lacks Snakemake's records: once every file is compared with what it says of itself,
# --touch says that nothing is out of date.
redraw: verify
	$(BIN)/snakemake --touch
	rm -rf results/figures results/*.md results/report.html
	$(BIN)/snakemake

setup: $(VENV)/installed

# Both stamps are written last, so an interrupted setup is done again.
# setuptools comes first because one of the packages is built with it. Bytecode is compiled at last,
# on all cores, which pip would do on one.
$(VENV)/locked: environment.lock
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || \
	    { echo "Python 3.11 or newer is needed; name one with: make PYTHON=/path/to/python3" >&2; exit 1; }
	rm -rf $(VENV)
	$(PYTHON) -m venv $(VENV)
	sed -n '/^setuptools==/,/[^\\]$$/p' $< | $(INSTALL) --require-hashes -r /dev/stdin
	$(INSTALL) --require-hashes -r $<
	$(BIN)/python -m compileall -q -j 0 -x olefile2 $(VENV)/lib # a module in Python 2
	touch $@

$(VENV)/installed: $(VENV)/locked pyproject.toml
	$(INSTALL) --no-deps --editable .
	touch $@

# One set of versions for every platform and every Python from 3.11 on.
lock:
	@dir=$$(mktemp -d) && trap 'rm -rf "$$dir"' EXIT && \
	$(PYTHON) -m venv "$$dir" && "$$dir/bin/python" -m pip install --quiet --no-user uv pip-audit && \
	lock="$$dir/bin/uv pip compile --upgrade --universal --python-version 3.11 --generate-hashes \
	    --fork-strategy fewest --no-config --no-emit-index-url --quiet" && \
	$$lock --custom-compile-command "make lock" --output-file environment.lock \
	    --group dev --extra study --extra slurm --extra mp4 --extra topography pyproject.toml && \
	$$lock --custom-compile-command "make lock" --output-file $(PEERS) --group peers && \
	{ "$$dir/bin/pip-audit" --strict --disable-pip --require-hashes --progress-spinner off \
	    -r environment.lock -r $(PEERS) --output "$$dir/found" || \
	    cat "$$dir/found" 2>/dev/null || \
	    echo "The new locks are not checked for vulnerabilities: no advisories could be had." >&2; }

clean:
	rm -rf $(VENV) .mypy_cache .pytest_cache .ruff_cache
	find src tests workflow benchmarks -name __pycache__ -type d -prune -exec rm -rf {} +
