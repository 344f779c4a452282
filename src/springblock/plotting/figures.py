"""Figures of the study: titles, captions, and what each is drawn from.

This module loads neither matplotlib nor pandas: a dry run of the study starts quickly. Figures 1 to
9 are numbered as in Costagliola, Bosia & Pugno, Int. J. Solids Struct. 243, 111525 (2022),
doi:10.1016/j.ijsolstr.2022.111525.
"""

from dataclasses import replace
from itertools import chain

from springblock.model.scene import Scene
from springblock.plotting.declaration import (
    CorrelationsSource,
    Declaration,
    PatternSource,
    RealisationsSource,
    Scenes,
    Source,
    TableSource,
)

#: Names that captions give to the intervals of `statistics.mean_interval` and of `correlation`.
INTERVALS = "95 % t intervals over realisations"
CORRELATION_INTERVALS = "95 % BCa bootstrap intervals over realisations"
SINGLE = 20  #: largest number of runs of an ensemble that are drawn one by one

#: Caption of the curves drawn by `curves.draw_mean_force` and `curves.draw_detachments`.
ENDS = """Realisations end after a set time, or after the first minimum behind their force maximum;
    from where the first has ended the force is dotted, the mean of those that go on, and it ends
    with half of them."""


def main_surfaces(flat: Scenes, pillars: Scenes, grooves: Scenes) -> list[Scene]:
    """Return flat surfaces, pillars, and of the grooved ones those with the first's pattern."""
    return [*flat, *pillars, *one_pattern(grooves)]


def one_pattern(*groups: Scenes) -> list[Scene]:
    """Return the scenes of all groups with the pattern of the last group's first one."""
    last = groups[-1][0]
    size, direction = last.n_blocks, last.direction
    return [s for s in chain(*groups) if replace(s, n_blocks=size, direction=direction) == last]


def one_of_each(*groups: Scenes) -> list[Scene]:
    """Return a flat, a pillared and a grooved surface, each with those of other sizes, if any."""
    found = []
    for group, varied in zip(groups[::2], groups[1::2], strict=True):
        directions = {scene.direction for scene in varied}
        scenes = one_pattern(group, varied) if varied else []
        found += [scene for scene in scenes if scene.direction in directions]
    return found


def sizes_varied(pillars: Scenes, spacing: Scenes) -> list[Scene]:
    """Return pillars of the sizes whose distance is varied."""
    sizes = {scene.n_p for scene in spacing}
    return [scene for scene in (*pillars, *spacing) if scene.n_p in sizes]


def with_and_without(grooves: Scenes, third_level: Scenes) -> list[Scene]:
    """Return the first pattern of three levels along x and y, with and without its third level."""
    cut = third_level[0]
    whole = replace(cut, n_p3=0, n_s3=0, along_3="")
    wanted = {replace(pattern, direction=way) for pattern in (cut, whole) for way in ("x", "y")}
    return [scene for scene in (*grooves, *third_level) if scene in wanted]


_MAIN_SURFACES = RealisationsSource(
    groups=("flat", "pillars", "grooves"), keys=("n_p", "n_p2", "direction"), pick=main_surfaces
)

#: By name, in the order of names in the report: `springblock figure NAME` draws one.
FIGURES: dict[str, Declaration] = {
    "figure_1": Declaration(
        title="The model",
        module="paper_surfaces",
        caption="""The model: a) the mesh of internal springs, drawn from a list of bonds that is
        tested against the energy of all springs; b) side view of the slider, moving at constant
        velocity v, and of the shear springs K_s. Figure 1 of the paper.""",
        source=Source(),
    ),
    "figure_2": Declaration(
        title="Force and detachments, flat surface",
        module="paper_results",
        caption="""a), b) Friction force over the normal force and c), d) share of blocks that
        detach in each sample interval, on a flat surface; b) and d) enlarge the time around the
        force maximum. Figure 2 of the paper.""",
        source=RealisationsSource(groups=("flat",)),
        marks="""Black: the realisation of the first seed; grey band: 5th to 95th percentile of the
        others. Dotted line: t_max, the time of the force maximum; solid line: t_avg, the mean first
        detachment time.""",
    ),
    "figure_3": Declaration(
        title="First detachment times, flat surface",
        module="paper_results",
        caption="""First detachment times t_det over t_max, block by block, in the realisation that
        figure 2 shows. Figure 3 of the paper.""",
        source=RealisationsSource(groups=("flat",), batches=1),
        marks="""Blue blocks detach before the force maximum, red ones after it; each side has its
        own scale, which covers all times.""",
    ),
    "figure_4": Declaration(
        title="Square pillars",
        module="paper_surfaces",
        caption="""Square pillars, from the mask that the solver uses: a) the first three each way;
        b) one pillar with its coordinates (x_p, y_p) and the sides along which c_x and c_y are
        measured. Figure 4 of the paper.""",
        source=PatternSource(),
    ),
    "figure_5": Declaration(
        title="First detachment times on one pillar",
        module="paper_results",
        caption="""First detachment times t_det over t_max on one pillar, means over all pillars and
        realisations: a) by place on the pillar; b) by part of each ring of blocks, from the edge to
        the middle. Figure 5 of the paper; b) is an addition.""",
        source=RealisationsSource(groups=("pillars",)),
        marks=f"""a) Blue: before the force maximum, red: after it, each on its own scale. b) The
        legend gives half the widest of the {INTERVALS}, which are too narrow to be drawn.""",
    ),
    "figure_6": Declaration(
        title="Force and detachments, pillars",
        module="paper_results",
        caption="""a) Friction force over the normal force and b) share of first detachments per
        bin, against time; c) static friction and d) t_max - t_avg against the size of the pillars;
        on a flat surface and on pillars. Figure 6 of the paper; c), d) and further sizes are
        additions.""",
        source=RealisationsSource(
            groups=("flat", "pillars"), also=("small_pillars",), keys=("n_p",)
        ),
        marks=f"""a) Means; bands: 5th to 95th percentile of the realisations; filled symbols:
        t_max, open ones: t_avg. b) Means; bands: {INTERVALS}; symbols: the largest share. c) Means;
        bars: {INTERVALS}. d) Dots: realisations; dashes: medians. Dashed line in c), d): mean of
        the flat surface. {ENDS}""",
    ),
    "figure_7": Declaration(
        title="Correlation of detachments on pillars",
        module="paper_results",
        caption="""Correlation of first detachment times along the sides of a pillar, against the
        distance r from the middle of the side, sliding along x; c_x on sides along x, c_y on sides
        along y; 1 at r = 0. a) Linear; b) logarithmic, up to the last distance before the interval
        holds zero, with fits: exp(-r/l_c), solid over the range of the fit and dotted beyond, and A
        exp(-r/l) with A free, dashed, where its range has three distances or more. c) l_c and l of
        c_x against the size of the pillars. Figure 7 of the paper; fits with A free are an
        addition.""",
        source=CorrelationsSource(groups=("pillars",)),
        marks=f"""Means over all pillars and realisations; bands and bars:
        {CORRELATION_INTERVALS}.""",
    ),
    "figure_8": Declaration(
        title="Grooved pillars",
        module="paper_surfaces",
        caption="""Pillars with grooves along x, from the mask that the solver uses: a) the whole
        surface; b) one pillar with its coordinates. Where the surface holds a single pillar, half
        the distance n_s lies on each side of it. Figure 8 of the paper.""",
        source=PatternSource(),
    ),
    "figure_9": Declaration(
        title="Force and detachments, grooved pillars",
        module="paper_results",
        caption="""Left: friction force over the normal force; right: share of first detachments per
        bin; against time, from where a force has reached 80 % of its maximum. Pillars with grooves,
        sliding along and across them; a row for each width of pawls and grooves, n_p2/n_s2. Figure
        9 of the paper, which does not give its sizes.""",
        source=RealisationsSource(groups=("grooves",), keys=("n_p2", "n_s2", "direction")),
        marks=f"""Thin lines: single realisations, the first {SINGLE}; thick lines: means; bands:
        {INTERVALS}. Triangles: peaks of the mean force that stand out by more than two standard
        errors and 1 % of the largest force and reach 90 % of it. Lesser peak: prominence of the
        second most prominent peak of each realisation over its largest force, however small, 0
        where there is one peak alone; mean and 95 % t interval. A peak of single realisations whose
        times differ may be none of the mean. {ENDS}""",
    ),
    "supplement_spacing": Declaration(
        title="Distance between pillars",
        module="supplement",
        caption="""a) Static friction and b) t_max - t_avg against the distance n_s between pillars,
        which the paper leaves open, for each size n_p.""",
        source=RealisationsSource(
            groups=("pillars", "spacing"), keys=("n_p", "n_s"), pick=sizes_varied
        ),
        marks=f"""a) Means; bars: {INTERVALS}. b) Dots: realisations; dashes: medians.""",
    ),
    "supplement_size": Declaration(
        title="Size of the surface",
        module="supplement",
        caption="""a) Static friction over its mean at the largest N and b) t_max - t_avg, against
        the side N of the surface; for a flat surface, a pillared one, and a grooved one where the
        study varies its size. Figures of the paper are at N = 120.""",
        source=RealisationsSource(
            groups=("flat", "size_flat", "pillars", "size_pillars"),
            also=("grooves", "size_grooves"),
            keys=("n_p", "n_p2", "direction", "n_blocks"),
            pick=one_of_each,
        ),
        marks=f"""a) Means; bars: {INTERVALS}. b) Dots: realisations; dashes: medians. Surfaces of
        one N are drawn a little apart.""",
    ),
    "supplement_angle": Declaration(
        title="Sliding at an angle to grooves",
        module="supplement",
        caption="""a) Static friction, b) t_max - t_avg and c) prominence of the lesser load peak
        against the angle between sliding direction and grooves, which is 0 or 90 degrees in the
        paper. The prominence is how far the second most prominent peak of a realisation stands out
        of the force around it, over the largest force, small waves included; 0 where there is one
        peak alone.""",
        source=RealisationsSource(
            groups=("grooves", "angles"), keys=("direction",), pick=one_pattern
        ),
        marks=f"""Small dots: realisations, a little apart; large dots in a), c): means; bars:
        {INTERVALS}. b) has no means, as realisations may lie in two clusters.""",
    ),
    "supplement_levels": Declaration(
        title="A third level",
        module="supplement",
        caption="""Friction force over the normal force against time, towards the end of the run,
        sliding a) along and b) across the grooves, on patterns of two and of three levels. The
        paper expects that its effects remain on further levels.""",
        source=RealisationsSource(
            groups=("grooves", "third_level"), keys=("direction", "level"), pick=with_and_without
        ),
        marks=f"""Lines: means; bands: {INTERVALS}. Legends: size and gap of each level in blocks,
        and the lesser peak, as in figure 9; triangles as there. {ENDS}""",
    ),
    "supplement_repetitions": Declaration(
        title="Number of realisations",
        module="supplement",
        caption="""Half the 95 % interval of static friction against the number k of realisations,
        which the paper does not give.""",
        source=_MAIN_SURFACES,
        marks="""Symbols: t intervals, mean over random subsets of the ensembles; lines: 1.96
        standard deviations of the whole ensemble over the root of k. t intervals of few
        realisations are wider, as they estimate their own scatter badly.""",
    ),
    "supplement_restick": Declaration(
        title="Blocks that let go again",
        module="supplement",
        caption="""Blocks that have come to rest and let go again up to 80 %, 90 % and 100 % of
        t_max, as a share of all blocks in contact, for each surface; the re-stick rule can matter
        for no more. The paper does not say when a sliding block sticks; of the two integrators,
        `rk4` lets every block that turns back stick, `leapfrog` only those that static friction can
        hold.""",
        source=_MAIN_SURFACES,
        marks="""Dots: realisations; dashes: medians.""",
    ),
    "surfaces": Declaration(
        title="Surfaces of one's own",
        module="supplement",
        caption="""Surfaces, a row each. Left: blocks in contact; middle:
        first detachment times t_det over t_max, means over realisations; right: friction force over
        the normal force against time.""",
        source=RealisationsSource(groups=("surfaces",), keys=("folder",)),
        marks=f"""Middle: blue before the force maximum and red after it, each on its own scale;
        grey where there is no contact or the block has not let go in a realisation. Right: mean,
        with a band for its {INTERVALS}; thin lines: up to {SINGLE} single realisations; dotted
        line: mean t_max. {ENDS}""",
    ),
    "work_precision": Declaration(
        title="Error against run time",
        module="accuracy",
        caption="""a-c) Error of first detachment times before the horizon, up to which single
        realisations can be compared, against force evaluations, of single realisations, compared
        with a solution that locates every event. d-f) Bias of mean static friction against the
        step, of ensembles compared with the same seeds at a fine step; on small surfaces and, where
        the study has `production: true`, with 120 × 120 blocks. Both integrators, and Runge-Kutta
        with the friction of each stage, which does not converge.""",
        source=TableSource(("work_precision", "production")),
        marks="""Blue areas: 95 % of the means over 20 seeds. Bars: 95 % t intervals. The axis of
        biases is linear within ±1 % and logarithmic beyond.""",
    ),
    "total_error": Declaration(
        title="Error against CPU time at full size",
        module="accuracy",
        caption="""Errors of ensembles with 120 × 120 blocks over CPU time. a-c) Bias of the mean
        against the finest step with the same seeds, with its 95 % interval, over the CPU time of a
        realisation; numbers above are steps in ns. d-j) Total error, the root of bias² +
        variance/k, of k seeds over the CPU time of all, prelude included: dots stand for 1, 10, 100
        and 1000 seeds, rings for the study's at the default step; lines hold the estimated bias,
        shades the ends of its interval; grey lies the least error at any step.""",
        source=TableSource(("production",)),
        upon_request=True,
    ),
    "stability": Declaration(
        title="Stiff and extreme cases",
        module="accuracy",
        caption="""a) Energy residual against the step, over the largest stable one; b) error over
        the accepted one in all stiff and extreme cases; c-f) error against stiffness, strain,
        damping and speed.""",
        source=TableSource(("stability",)),
        marks="""Refused cases are beyond the stability limit; failing ones end in an exception.""",
    ),
    "mechanism_friction": Declaration(
        title="Stress, load transfer and overshoot",
        module="mechanism",
        caption="""a-d) Stress on the blocks of a pillar before any slip, over its mean, in a layer
        pulled along x; e) its standard deviation over its mean for all blocks in contact; f) static
        friction of independent blocks under this stress, with load transfer between them in
        equilibrium, with blocks that overshoot and stick again, and of the full model; against the
        size of pillars, on surfaces of 40 to 48 blocks a side with gaps as wide as the pillars. The
        same 10 seeds for each.""",
        source=TableSource(("mechanism",)),
        marks=f"""e) Chance plays no part: no bars. f) Means; bars:
        {INTERVALS.replace("realisations", "seeds")}.""",
    ),
    "mechanism_budget": Declaration(
        title="What edges and core bear of the load",
        module="mechanism",
        caption=f"""Force over time, over the normal force, on pawls of 8 blocks between grooves of
        2 on a pillar of 58 (N = 120), sliding a) along the grooves and b) across them: on all
        blocks, on the edges, which are the blocks in contact beside one without, and on the core,
        the others in contact. Solid: full model; dashed: blocks that overshoot and stick again, in
        which time is the slider's way over its velocity, until each has let go once. Means over 5
        seeds; bands: {INTERVALS.replace("realisations", "seeds")}.""",
        source=TableSource(("mechanism_budget",)),
    ),
    "beyond_lattice": Declaration(
        title="Lattice or layer",
        module="beyond",
        caption="""a) Correlation of detachment times along the sides of the largest pillars,
        sliding along x, on lattices of different spacing l, with the layer's thickness l_z and all
        sizes in metres unchanged. b) Decay length l of A exp(-r/l) on these pillars against the
        spacing, against the spacing with the same disorder per area, and against l_z. Static
        friction against the size of pillars for c) different l and d) different l_z.""",
        source=RealisationsSource(groups=("lattice", "disorder", "layer"), keys=("folder",)),
        marks="""Bands and bars: 95 % intervals over realisations. b) Grey lines have slopes 0 and
        1. c), d) Crosses at the foot: size with the lowest mean, and bars to those that cannot be
        told from it.""",
    ),
    "beyond_disorder": Declaration(
        title="Scatter of thresholds, and of friction",
        module="beyond",
        caption="""a) Decay length l of A exp(-r/l) against the standard deviation of the static
        coefficients, on pillars of n_p blocks. b) Static friction against n_p for each standard
        deviation. c) Variance of static friction between realisations against the number of blocks
        of the surface.""",
        source=RealisationsSource(
            groups=("flat", "pillars", "scatter", "variance"), keys=("folder",)
        ),
        marks="""Bars: 95 % intervals over realisations. c) Grey lines: as of independent
        blocks.""",
    ),
    "beyond_friction": Declaration(
        title="Size of pillars and contact fraction",
        module="beyond",
        caption="""Static friction at one total load, a) by size n_p and distance n_s of pillars; b)
        against n_p for each contact fraction.""",
        source=RealisationsSource(groups=("friction",), keys=("folder",)),
        marks=f"""a) Means; the contact fraction is the same along grey lines. b) Means; bars:
        {INTERVALS}; dashes: the sum of a number for each size and one for each contact
        fraction.""",
    ),
    "beyond_peaks": Declaration(
        title="Load peaks over groove widths and direction",
        module="beyond",
        caption="""Prominence of the second most prominent load peak in percent of the largest
        force, mean over realisations, by angle between sliding direction and grooves and width of
        pawls n_p2; on pillars (left) and over the whole surface (right), with narrow (above) and
        wide grooves (below).""",
        source=RealisationsSource(groups=("peaks",), keys=("folder",)),
        marks="""A prominence cannot be negative: scatter alone leaves what light cells have.""",
    ),
    "beyond_precursors": Declaration(
        title="Clusters of precursors, and correlation by direction",
        module="beyond",
        caption="""a) Share of the blocks that detach before the force maximum in clusters of a size
        or more, 4 neighbours together. b) Correlation of detachment times along the edges of
        grooves within pillars, by the angle between sliding direction and grooves.""",
        source=RealisationsSource(
            groups=("flat", "pillars", "grooves", "angles"), keys=("folder",)
        ),
        marks="""a) Solid: observed; dashed: as many blocks anywhere in contact; dotted: blocks in
        the same places, each from another realisation. b) Bands: 95 % intervals over
        realisations.""",
    ),
}
