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
ENDS = """Runs end after a set time, or after the first minimum behind their force maximum. From
    where the first has ended the force is dotted, the mean over those that go on, and it ends with
    half of them; no block is left to detach for the first time in a run that has ended, so these
    shares are of all runs throughout."""


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
        caption="""Friction force on a flat surface over the normal force, and share of blocks that
        detach in each sample interval. Dotted: t_max, the time of the force maximum; solid: t_avg,
        the mean first detachment time. One realisation, the first seed, in front of the whole
        ensemble. Figure 2 of the paper.""",
        source=RealisationsSource(groups=("flat",)),
    ),
    "figure_3": Declaration(
        title="First detachment times, flat surface",
        module="paper_results",
        caption="""First detachment times t_det over t_max of the realisation shown in figure 2:
        blue blocks detach before the force peak, red ones after it. One realisation; a map of
        single events has no error bar. Figure 3 of the paper.""",
        source=RealisationsSource(groups=("flat",), batches=1),
    ),
    "figure_4": Declaration(
        title="Square pillars",
        module="paper_surfaces",
        caption="""Square pillars, drawn from the mask that the solver uses, with the coordinates
        (x_p, y_p) of one pillar. Figure 4 of the paper.""",
        source=PatternSource(),
    ),
    "figure_5": Declaration(
        title="First detachment times on one pillar",
        module="paper_results",
        caption=f"""First detachment times t_det over t_max on one pillar, means over all pillars
        and realisations: a) by place on the pillar, blue before the force maximum and red after it,
        on a scale of its own for each; b) by part of each ring of blocks from the edge to the
        middle, with {INTERVALS}. Figure 5 of the paper; b) is an addition.""",
        source=RealisationsSource(groups=("pillars",)),
    ),
    "figure_6": Declaration(
        title="Force and detachments, pillars",
        module="paper_results",
        caption=f"""a) Friction force over the normal force and b) share of first detachments in
        each bin, on a flat surface and on pillars of several sizes; markers: a) t_max, or t_avg
        where they are open, b) the largest share. c) Static friction and d) t_max - t_avg over the
        size of the pillars; dashed: flat surface. Means with {INTERVALS}. {ENDS} Figure 6 of the
        paper; c) and d) are additions.""",
        source=RealisationsSource(groups=("flat", "pillars"), keys=("n_p",)),
    ),
    "figure_7": Declaration(
        title="Correlation of detachments on pillars",
        module="paper_results",
        caption=f"""Correlation of first detachment times along the sides of a pillar, from the
        middle of the side, sliding along x: c_x on sides along x, c_y on sides along y. Solid:
        exp(-r/l_c), which is 1 at r = 0, dotted beyond the range of the fit; dashed: A exp(-r/l_c)
        with A free, over that range, where it has three distances or more. Inset: l_c of c_x over
        the size of the pillars; open: with A free. Means over all pillars and realisations; bands
        and bars are {CORRELATION_INTERVALS}. Figure 7 of the paper; fits with A free are an
        addition.""",
        source=CorrelationsSource(groups=("pillars",)),
    ),
    "figure_8": Declaration(
        title="Grooved pillars",
        module="paper_surfaces",
        caption="""Pillars with grooves along x, drawn from the mask that the solver uses, with the
        coordinates of one pillar. Two pillars each way show the distance between them; the surfaces
        of figure 9 hold as many as their N has room for. Figure 8 of the paper.""",
        source=PatternSource(),
    ),
    "figure_9": Declaration(
        title="Force and detachments, grooved pillars",
        module="paper_results",
        caption=f"""Friction force over the normal force, at the left, and share of first
        detachments in each bin, at the right, on pillars with grooves, for each sliding direction;
        a row for each width of pawls and grooves, n_p2/n_s2. Thin lines: single runs, the first
        {SINGLE}; thick ones: means with {INTERVALS}. The panels begin where a force has reached
        80 % of its maximum; before, it grows with time. {ENDS} Triangles are load peaks of the mean
        as long as all runs go on: those that stand out by more than two standard errors and 1 % of
        the largest force, and reach 90 % of it. Figure 9 of the paper, which does not give its
        sizes.""",
        source=RealisationsSource(groups=("grooves",), keys=("n_p2", "n_s2", "direction")),
    ),
    "supplement_spacing": Declaration(
        title="Distance between pillars",
        module="supplement",
        caption=f"""a) Static friction and b) t_max - t_avg over the distance between pillars, n_s,
        which the paper leaves open; a line for each size of the pillars. Means with
        {INTERVALS}.""",
        source=RealisationsSource(
            groups=("pillars", "spacing"), keys=("n_p", "n_s"), pick=sizes_varied
        ),
    ),
    "supplement_size": Declaration(
        title="Size of the surface",
        module="supplement",
        caption=f"""a) Static friction and b) t_max - t_avg over the side N of the surface: a flat
        one, a pillared one, and a grooved one where the study varies its size. Means with
        {INTERVALS}. Figures of the paper are at N = 120.""",
        source=RealisationsSource(
            groups=("flat", "size_flat", "pillars", "size_pillars"),
            also=("grooves", "size_grooves"),
            keys=("n_p", "n_p2", "direction", "n_blocks"),
            pick=one_of_each,
        ),
    ),
    "supplement_angle": Declaration(
        title="Sliding at an angle to grooves",
        module="supplement",
        caption=f"""a) Static friction, b) t_max - t_avg and c) prominence of the lesser load peak
        over the angle between the sliding direction and the grooves, 0 and 90 degrees in the paper.
        The prominence is how far the second most prominent load peak of a run stands out of the
        force around it, over the largest force, small waves included; 0 where there is one peak
        alone. Small dots: single runs; large ones: means with {INTERVALS}.""",
        source=RealisationsSource(
            groups=("grooves", "angles"), keys=("direction",), pick=one_pattern
        ),
    ),
    "supplement_levels": Declaration(
        title="A third level",
        module="supplement",
        caption=f"""Friction force over the normal force towards the end of a run, on patterns of
        two and of three levels, sliding a) along and b) across the grooves. Means with {INTERVALS};
        triangles are load peaks of the mean, as in figure 9. {ENDS} The paper expects that its
        effects remain on further levels.""",
        source=RealisationsSource(
            groups=("grooves", "third_level"), keys=("direction", "level"), pick=with_and_without
        ),
    ),
    "supplement_repetitions": Declaration(
        title="Number of realisations",
        module="supplement",
        caption="""Half the 95 % interval of a) static friction and b) t_max - t_avg over the number
        k of realisations, which the paper does not give. Markers: t intervals, mean over random
        subsets of the ensembles; lines: 1.96 standard deviations of the whole ensemble over the
        root of k. Few realisations know their own scatter badly: t intervals are wider for it.""",
        source=_MAIN_SURFACES,
    ),
    "supplement_restick": Declaration(
        title="Blocks that let go again",
        module="supplement",
        caption=f"""Blocks that have come to rest and let go again, over time, as a share of all
        blocks in contact; the re-stick rule can matter for no more. Means with {INTERVALS}. The
        paper does not say when a sliding block sticks; of the two integrators, `rk4` lets every
        block that turns back stick, `leapfrog` only those that static friction can hold.""",
        source=_MAIN_SURFACES,
    ),
    "surfaces": Declaration(
        title="Surfaces of one's own",
        module="supplement",
        caption=f"""Each surface of the group `surfaces`: at the left which blocks are in contact;
        in the middle their first detachment times t_det over t_max, means over realisations, blue
        before the force maximum and red after it, on a scale of its own for each, and grey where
        there is no contact or a run in which the block has not let go; at the right the friction
        force over the normal force, mean with {INTERVALS}, up to 20 single runs, and t_max, the
        mean over realisations, as a dotted line. Runs end after a set time, or after the first
        minimum behind their force maximum; from where the first has ended the force is dotted, the
        mean over those that go on, and it ends with half of them.""",
        source=RealisationsSource(groups=("surfaces",), keys=("folder",)),
    ),
    "work_precision": Declaration(
        title="Error against run time",
        module="accuracy_errors",
        caption="""Error against cost of both integrators, and of Runge-Kutta with the friction of
        each stage, which does not converge. Single runs are compared with an event-located
        reference solution, ensembles with the same seeds at a fine step, with 95 % t intervals. The
        grey area lies below the disagreement of the finest step with the reference, the blue band
        holds 95 % of the means over 20 seeds. Axes of biases are linear within ±1 % and logarithmic
        beyond.""",
        source=TableSource("work_precision"),
    ),
    "total_error": Declaration(
        title="Error against CPU time at full size",
        module="accuracy_errors",
        caption="""Errors of ensembles with 120 × 120 blocks over CPU time. a-c) Bias of the mean
        against the finest step with the same seeds, with its 95 % interval, over the CPU time of a
        realisation; numbers above are steps in ns. d-j) Total error, the root of bias² +
        variance/k, of k seeds over the CPU time of all, prelude included: dots stand for 1, 10, 100
        and 1000 seeds, rings for the study's at the default step; lines hold the estimated bias,
        shades the ends of its interval; grey lies the least error at any step. k) Total error at
        each step over that at the best, for the CPU time at the rings, with the same three
        biases.""",
        source=TableSource("production"),
        upon_request=True,
    ),
    "stability": Declaration(
        title="Stiff and extreme cases",
        module="accuracy_cases",
        caption="""Energy residual and error in stiff and extreme cases. Refused cases are beyond
        the stability limit; failing ones end in an exception.""",
        source=TableSource("stability"),
    ),
    "mechanism_friction": Declaration(
        title="Stress, load transfer and overshoot",
        module="mechanism",
        caption=f"""a-d) Stress on the blocks of a pillar before any slip, over its mean, in a layer
        pulled along x; on surfaces of 40 to 48 blocks a side with gaps as wide as the pillars.
        e) Its standard deviation over its mean for all blocks in contact; no error bars, as chance
        plays no part. f) Static friction over the size of pillars: of independent blocks under this
        stress, with load transfer between them in equilibrium, with blocks that overshoot and
        stick again, and of the full model, on the same surfaces and the same 10 seeds each. Means
        with {INTERVALS.replace("realisations", "seeds")}.""",
        source=TableSource("mechanism"),
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
        source=TableSource("mechanism_budget"),
    ),
    "beyond_lattice": Declaration(
        title="Lattice or layer",
        module="beyond",
        caption="""a) Correlation of detachment times along the sides of the largest pillars,
        sliding along x, on lattices of different spacing l, with the layer's thickness l_z and all
        sizes in metres unchanged; bands are 95 % intervals over realisations. b) Correlation length
        of A exp(-r/l_c) on these pillars over l, over l with the same disorder per area, and over
        l_z; grey lines have slope 0 and 1. Static friction over the size of pillars for c)
        different l and d) different l_z; crosses at the foot: size of the friction-minimising
        pillar. Bars are 95 % intervals over realisations.""",
        source=RealisationsSource(groups=("lattice", "disorder", "layer"), keys=("folder",)),
    ),
    "beyond_disorder": Declaration(
        title="Scatter of thresholds, and of friction",
        module="beyond",
        caption="""a) Correlation length of A exp(-r/l_c) over the standard deviation of the static
        coefficients, for pillars of n_p blocks. b) Static friction over n_p for each standard
        deviation. c) Variance of static friction between realisations over the number of blocks of
        the surface; grey: as of independent blocks. Bars are 95 % intervals over realisations.""",
        source=RealisationsSource(
            groups=("flat", "pillars", "scatter", "variance"), keys=("folder",)
        ),
    ),
    "beyond_friction": Declaration(
        title="Size of pillars and contact fraction",
        module="beyond",
        caption="""Static friction at one total load. a) Over size n_p and distance n_s of pillars;
        on grey lines the contact fraction is the same. b) Over n_p for each contact fraction, with
        95 % intervals over realisations; dashes: the sum of a number for each size and one for each
        contact fraction.""",
        source=RealisationsSource(groups=("friction",), keys=("folder",)),
    ),
    "beyond_peaks": Declaration(
        title="Load peaks over groove widths and direction",
        module="beyond",
        caption="""Prominence of the second most prominent load peak in percent of the largest
        force, mean over realisations, over the angle between sliding direction and grooves and the
        width of pawls n_p2: on pillars (left) and over the whole surface (right), with narrow
        (above) and wide grooves (below). A prominence cannot be negative; what scatter alone leaves
        is that of light cells.""",
        source=RealisationsSource(groups=("peaks",), keys=("folder",)),
    ),
    "beyond_precursors": Declaration(
        title="Clusters of precursors, and correlation by direction",
        module="beyond",
        caption="""a) Share of the blocks that detach before the force maximum in clusters of a size
        or more, 4 neighbours together: solid, observed; dashed, as many blocks anywhere in contact;
        dotted, blocks in the same places, each from another realisation. b) Correlation of
        detachment times along the edges of grooves within pillars, by the angle between sliding
        direction and grooves, with 95 % intervals over realisations.""",
        source=RealisationsSource(
            groups=("flat", "pillars", "grooves", "angles"), keys=("folder",)
        ),
    ),
}
