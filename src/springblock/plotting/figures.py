"""Figures of the study: titles, captions and data sources.

This module loads neither matplotlib nor pandas: a dry run of the study starts quickly. Figures 1 to
9 are numbered as in Costagliola, Bosia & Pugno, Int. J. Solids Struct. 243, 111525 (2022),
doi:10.1016/j.ijsolstr.2022.111525.
"""

from springblock.plotting.declaration import Declaration

#: Names that captions give to the intervals of `statistics.mean_interval` and of `correlation`.
INTERVALS = "95 % t intervals over realisations"
CORRELATION_INTERVALS = "95 % BCa bootstrap intervals over realisations"
SINGLE = 20  #: largest number of runs of an ensemble that are drawn one by one

#: Caption of the curves drawn by `curves.draw_mean_force` and `curves.draw_detachments`.
ENDS = """Realisations end after a set time, or after the first minimum that follows their force
    maximum; the mean force is dotted once the first of them has ended, and stops when half of them
    have."""

#: Keys of grooved pillars.
PATTERN = ("n_p2", "n_s2", "n_p3", "n_s3", "along_3", "direction")

#: By name: `springblock figure NAME` draws one; the report sorts them by name.
FIGURES: dict[str, Declaration] = {
    "figure_1": Declaration(
        title="The model",
        module="paper_surfaces",
        caption="""a) Blocks and internal springs from above; b) side view of the slider, moving at
        constant velocity v, and of the shear springs K_s. Figure 1 of the paper.""",
        draws="nothing",
    ),
    "figure_2": Declaration(
        title="Force and detachments, flat surface",
        module="paper_results",
        caption="""a), b) Friction force over the normal force and c), d) share of blocks that
        begin to slide or turn back in each sample interval, against time, on a flat surface; b)
        and d) enlarge the time around the force maximum. Figure 2 of the paper.""",
        groups=("flat",),
        marks="""Black: the realisation with the first seed; grey band in a), b): 5th to 95th
        percentile of the others. Dotted line: t_max, the time of the force maximum; solid
        line: t_avg, the mean first detachment time.""",
    ),
    "figure_3": Declaration(
        title="First detachment times, flat surface",
        module="paper_results",
        caption="""First detachment time t_det over t_max of each block of a flat surface, in the
        realisation that is black in figure 2. Figure 3 of the paper.""",
        groups=("flat",),
        batches=1,
        marks="""Blue blocks detach before the force maximum, red ones after it, on separate scales
        that cover all times.""",
    ),
    "figure_4": Declaration(
        title="Square pillars",
        module="paper_surfaces",
        caption="""Blocks in contact, from the solver's mask: a) nine pillars; b) one pillar with
        its coordinates (x_p, y_p) and the sides along which c_x and c_y are measured. Figure 4 of
        the paper.""",
        draws="pattern",
    ),
    "figure_5": Declaration(
        title="First detachment times on one pillar",
        module="paper_results",
        caption="""Mean first detachment time t_det over t_max on a pillar, over all pillars and
        realisations: a) of each block; b) of the parts of each ring of blocks, from the edge to the
        centre. Figure 5 of the paper; b) is an addition.""",
        groups=("pillars",),
        marks=f"""a) Blue: before the force maximum, red: after it, on separate scales. b) The
        {INTERVALS} are too narrow to be drawn; the legend gives half the width of the widest.""",
    ),
    "figure_6": Declaration(
        title="Force and detachments, pillars",
        module="paper_results",
        caption="""a) Friction force over the normal force and b) share of first detachments per
        bin, against time, on a flat surface and on pillars of the paper's sizes; c) static friction
        and d) t_max - t_avg against pillar size. Figure 6 of the paper; c), d) are additions.""",
        groups=("flat", "pillars"),
        also=("small_pillars",),
        keys=("n_p",),
        marks=f"""a) Lines: means; bands: 5th to 95th percentile of the realisations; filled
        symbols: t_max, open ones: t_avg. b) Lines: means; bands: {INTERVALS}; symbols: the largest
        share. c), d) Symbols: means; bars: {INTERVALS}; dots: realisations; dashed line with grey
        band: the flat surface. {ENDS}""",
    ),
    "figure_7": Declaration(
        title="Correlation of detachments on pillars",
        module="paper_results",
        caption="""Correlation of first detachment times along the sides of a pillar, c_x on sides
        along x and c_y on sides along y, against the distance r from the centre of the side,
        sliding along x: a) on a linear and b) on a logarithmic scale, up to the first interval that
        includes zero, with fits of exp(-r/l_c) and A exp(-r/l_d). c) Correlation length l_c and
        decay length l_d of c_x against pillar size. Figure 7 of the paper; fits with A free are an
        addition.""",
        draws="correlations",
        groups=("pillars",),
        marks=f"""Symbols: means over all pillars and realisations; bands and bars:
        {CORRELATION_INTERVALS}. b) exp(-r/l_c): solid over the range of the fit, dotted beyond; A
        exp(-r/l_d): dashed, where the range has three distances or more.""",
    ),
    "figure_8": Declaration(
        title="Grooved pillars",
        module="paper_surfaces",
        caption="""Blocks in contact on pillars with grooves along x, from the mask used by the
        solver: a) the whole surface; b) one pillar with its coordinates. A pillar alone on its
        surface has margins of n_s/2. Figure 8 of the paper.""",
        draws="pattern",
    ),
    "figure_9": Declaration(
        title="Force and detachments, grooved pillars",
        module="paper_results",
        caption="""Left: friction force over the normal force, from 70 % of the highest mean on;
        right: share of first detachments per bin; against time. Grooved pillars, sliding along and
        across the grooves; a row for each width of pawls and grooves, n_p2/n_s2, those with the
        clearest second load peak first. Figure 9 of the paper, which does not give its sizes.""",
        groups=("grooves",),
        keys=PATTERN,
        marks=f"""Thin lines: the first {SINGLE} realisations; thick lines: means; bands:
        {INTERVALS}. Triangles: peaks of the mean force that reach 90 % of its maximum, with a
        prominence of more than two standard errors and 1 % of the maximum; peaks of realisations at
        different times may average out. Above each row: how far the force of a realisation falls
        from its lesser peak to the minimum between its peaks, over its largest force (0 with one
        peak); means and 95 % t intervals.
        {ENDS}""",
    ),
    "supplement_levels": Declaration(
        title="A third level",
        module="supplement",
        caption="""As figure 9, on pillars cut once more by grooves of a third level, n_p3/n_s3;
        along and across refer to the grooves of the second level. The paper expects the effects of
        two levels to remain.""",
        groups=("third_level",),
        keys=PATTERN,
        marks=f"""Lines, bands, triangles and the numbers above are those of figure 9. {ENDS}""",
    ),
    "surfaces": Declaration(
        title="Surfaces of your own",
        module="supplement",
        caption="""One surface per row. Left: blocks in contact; middle: first detachment time t_det
        over t_max, mean over realisations; right: friction force over the normal force against
        time.""",
        groups=("surfaces",),
        keys=("folder",),
        marks=f"""Middle: blue before the force maximum and red after it, on separate scales; grey
        without contact, or where the block has not detached in every realisation. Right: thick
        line: mean; band: {INTERVALS}; thin lines: up to {SINGLE} realisations; dotted line: mean
        t_max. {ENDS}""",
    ),
    "work_precision": Declaration(
        title="Error against run time",
        module="accuracy",
        caption="""a-c) Error of first detachment times before the horizon, in single
        realisations on small surfaces, relative to a solution that locates every event, against
        force evaluations; both integrators, and plain Runge-Kutta, with friction evaluated in each
        stage. d-f) Bias of mean static friction, t_max and t_avg against the CPU time of one
        realisation, for the steps given at the top; relative to the same seeds at the finest step,
        and divided by the standard error of a mean over 20 seeds.""",
        draws="tables",
        tables=("work_precision", "production"),
        marks="""Circles: default. Blue areas: biases smaller than the standard error. Bars: 95 % t
        intervals.""",
    ),
    "stability": Declaration(
        title="Stiff and extreme cases",
        module="accuracy",
        caption="""a) Energy residual against the step over the largest stable one; b) error over
        the accepted error of each case; c-f) error against stiffness, strain, damping and
        speed.""",
        draws="tables",
        tables=("stability",),
        marks="""Refused cases are beyond the stability limit.""",
    ),
    "mechanism_friction": Declaration(
        title="Stress, load transfer, healing and overshoot",
        module="mechanism",
        caption="""a-d) Stress on the blocks of a pillar before any slip, over its mean, in a layer
        pulled along x; e) its standard deviation over its mean, over all contact blocks; f) static
        friction of independent blocks under this stress, of blocks with quasi-static load transfer,
        of blocks that stick again and heal, of blocks that overshoot as well, and of the full
        model. e), f) Against pillar size, on surfaces of 40 to 60 blocks a side with n_s = n_p; the
        same 10 seeds for each.""",
        draws="tables",
        tables=("mechanism",),
        marks=f"""e) Exact values. f) Symbols: means; bars:
        {INTERVALS.replace("realisations", "seeds")}.""",
    ),
    "continuum_friction": Declaration(
        title="Friction of a layer with a fracture energy",
        module="continuum",
        caption="""Static friction of unit cells with gaps as wide as the pillars, under slip
        weakening without healing. a) Stripes across and along the sliding direction, against their
        width over the decay length of the layer; b) square pillars, against their width over the
        layer thickness. Layers are 5, 10 and 20 µm thick; colours are kappa, d_c over the slip at
        which the springs of the layer bear the drop of friction.""",
        draws="tables",
        tables=("continuum",),
        marks="""Lines: theory, without a fit; symbols: simulation, open where the layer is not 10
        µm thick.""",
    ),
    "mechanism_sensitivities": Declaration(
        title="What friction and load peaks depend on",
        module="mechanism",
        caption="""a) Size of pillars n_p of lowest static friction, b) friction on the largest
        pillars minus that, c) t_max - t_avg on pillars of 6 blocks and d) prominence of the second
        load peak over the largest force, on pawls of 8 blocks that slide along their grooves; with
        the paper's surfaces and constants, and with one thing changed at a time, by a ratio or to
        the value given.""",
        groups=("sensitivities",),
        draws="tables",
        tables=("sensitivities",),
        marks=f"""a) Bars: sizes that may have the lowest friction. b-d) Symbols: means; bars:
        {INTERVALS}. Dotted lines: the paper's surfaces.""",
    ),
}
