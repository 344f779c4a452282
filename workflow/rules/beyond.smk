# What goes beyond the paper: maps and sweeps, which take longer than the paper itself.


rule beyond:
    input:
        expand(
            f"{RESULTS}/tables/beyond/{{table}}.parquet",
            table=["realisations", "correlation", "correlation_length"],
        ),
    localrule: True
    message:
        f"What goes beyond the paper is in {RESULTS}/tables/beyond"
