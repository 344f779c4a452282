# What results are made of: code and conditions, in files whose names change with them. All that are
# not there yet are written by one job, and what depends on them runs again.

ABSENT = [file for file in ORIGINS if not Path(file).exists()]


rule origins:
    output:
        ABSENT,
    log:
        f"{RESULTS}/logs/origins.log",
    benchmark:
        f"{RESULTS}/benchmarks/origins.tsv"
    localrule: True
    message:
        "Writing down what results are made of"
    run:
        for file in output:
            origin.remember(Path(file), ORIGINS[file])


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
