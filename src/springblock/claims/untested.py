"""Statements of the paper that the study does not test, and why."""

#: Section of the paper, what it says, why it is not tested.
UNTESTED = (
    (
        "1",
        "When the motion begins, grooves aligned with the sliding direction favor the rupture "
        "front propagation, so that the force peak is smaller.",
        "a front has no definition that its speed could be measured by; that the peak is smaller "
        "is tested",
    ),
    (
        "2",
        "The model provides a good qualitative understanding at small computational costs with "
        "respect to three-dimensional methods.",
        "needs such a method for comparison",
    ),
    (
        "2",
        "The model is more effective in estimating static friction than dynamic friction.",
        "needs experiments for comparison",
    ),
    (
        "2",
        "Runge-Kutta with h = 1e-8 s suffices, as one would first write it.",
        "how friction acts within its steps is not said; the error of the plainest reading is "
        "known of single runs on small surfaces, not as a bias of ensembles: see `accuracy.md`",
    ),
    (
        "3.1",
        "A non-uniform distribution of residual strains appears at the force minimum, and is "
        "removed at the beginning of the dynamic phase, in localized stick-slip motions.",
        "displacements after the peak are not kept",
    ),
    (
        "3.1",
        "t_avg corresponds roughly to the propagation instant of the wave fronts.",
        '"roughly" and "instant" leave open what would contradict it',
    ),
    (
        "3.2",
        "The number of wave fronts crossing a pillar is influenced by the random coefficients.",
        "a front has no definition that could be counted",
    ),
    (
        "3.2",
        "The asymmetry of sides along and across the sliding direction was observed in "
        "experiments.",
        "about experiments",
    ),
    (
        "3.2",
        "When the precursor length scale is much smaller than the pattern size, the transition is "
        "similar to that of a non-patterned surface.",
        "needs pillars much larger than n_p = 60; that the trend goes there is tested",
    ),
    (
        "3.2",
        "Such a minimum of static friction is observed in experiments, and real precursors have a "
        "characteristic length.",
        "about experiments",
    ),
    (
        "3.3",
        "An anisotropic shape of the second level is necessary for two load peaks.",
        "needs a second level of square pawls",
    ),
    (
        "3.3",
        "The results can be generalized to more complex geometries and other surface patterns.",
        "no limit is set to them",
    ),
    (
        "4",
        "Between the load peaks the whole contact surface is in a stressed state.",
        "stress after the first detachment is not kept",
    ),
    (
        "4",
        "Between the load peaks a small additional force can lead to full detachment.",
        "needs runs with a force added between the peaks",
    ),
    (
        "4",
        "The results are consistent with seismic data; precursors could be correlated to fault "
        "geometry.",
        "about earthquakes",
    ),
    (
        "5",
        "Patterns can be designed to tune the transition to sliding, with applications in devices.",
        "about what could be done",
    ),
)
