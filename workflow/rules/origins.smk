# What results are made of: code and conditions, in files whose names change with them. All that are
# not there yet are written by one job, and what depends on them runs again.

ABSENT = [file for file in ORIGINS if not Path(file).exists()]
KNOWN = f"{RESULTS}/origin/known"

# Nothing runs for a file that is missing between others that are there. A file of the year 1970
# beside it does it: the job's input is newer.
if ABSENT and workflow.is_main_process and Path(RESULTS).exists():
    os.makedirs(f"{RESULTS}/origin", exist_ok=True)
    Path(KNOWN).touch()
    os.utime(KNOWN, (1, 1))


rule origins:
    input:
        workflow.main_snakefile,
    output:
        [*ABSENT, KNOWN] if ABSENT else [],
    log:
        f"{RESULTS}/logs/origins.log",
    benchmark:
        f"{RESULTS}/benchmarks/origins.tsv"
    localrule: True
    message:
        "Writing down what results are made of"
    run:
        for file in ABSENT:
            origin.remember(Path(file), ORIGINS[file])
        Path(KNOWN).touch()


rule repair:
    log:
        f"{RESULTS}/logs/repair.log",
    localrule: True
    params:
        results=RESULTS,
    message:
        "Setting aside what cannot be used"
    shell:
        "springblock repair {params.results:q} 2>&1 | tee {log:q}"
