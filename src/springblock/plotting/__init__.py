"""Pictures and films of single runs, sweeps, and what figures of the study share."""
