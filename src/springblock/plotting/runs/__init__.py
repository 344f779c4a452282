"""Pictures of single runs and surfaces, still and moving, in the look of the study's figures."""
