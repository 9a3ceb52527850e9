"""Pictures of results: every function takes a result and, if you like, an Axes, and returns the Axes.

What they share is said here once. `ax` is what to draw on, a new figure in the book's style without it; `title` stands
above the picture, or inside it where the legend is above; `legend` is whether the colours are named. `look` is what
matplotlib calls it (``color``, ``lw`` or ``linewidth``, ``alpha``, ``label``, ``cmap``, ...), for what the picture is
of: its curve or dots, its bars, areas or image. It stands instead of the usual, for all of them where they are several;
what is drawn beside them keeps its own. ``colour`` is ``color``. A result that is not described is made as the example
shows: a `sweep` by `gearpair.sweep`, a plane by `gearpair.basins`, a grid by `gearpair.parameter_map`, survivors by
`gearpair.survival`, a `chart` by `gearpair.design.speed_chart`. Under the first sentence of each stands what its Axes
holds.

Colours say the same everywhere (`MOTION_COLOURS`): one for each period, dark grey for chaos; they stay apart for
colour-blind readers. On dark axes (``plt.style.use("dark_background")``) what would be lost there is lighter, and what
is pale on paper is dim. A legend that would leave the figure gets more rows. Nothing is set at import:
``plt.style.use(STYLE)``, or ``with plt.style.context(STYLE):``, gives the book's look.
"""

from gearpair.plotting.article import (
    boundaries_by_step,
    contact_ratio_cloud,
    coverage_by_phase,
    reached_motions,
    score_ranking,
    stiffness_trends,
)
from gearpair.plotting.bifurcations import bifurcation_curves, branches
from gearpair.plotting.boundaries import chaotic_saddle, manifolds
from gearpair.plotting.diagrams import (
    attractor_shares,
    bifurcation_diagram,
    exponents,
    extremes,
    mark_boundaries,
    motion_shares,
    range_lanes,
    range_strips,
)
from gearpair.plotting.maps import (
    attractor_points,
    basins,
    finite_exponents,
    impact_map,
    impact_states,
    period_map,
    quantity_map,
)
from gearpair.plotting.methods import (
    certificate,
    certified_steps,
    drawn_diagram,
    interpolation_error,
    step_convergence,
    work_precision,
)
from gearpair.plotting.motions import gallery, phase_portrait, poincare_section, portrait, spectrum, time_history
from gearpair.plotting.passages import order_map, passage_factor, passage_path, shock_margins
from gearpair.plotting.service import fold_curves, rattling_share
from gearpair.plotting.speed_chart import CHANGES, dynamic_factors, load_map, rattle, tooth_loads, tornado
from gearpair.plotting.style import MOTION_COLOURS, STYLE, add_motion_legend, bare, motion_colour
from gearpair.plotting.survivors import survival_curve, survival_curves
from gearpair.plotting.teeth import (
    compliance_stack,
    finite_element_check,
    load_shares,
    mesh_curves,
    pair_stiffness,
    per_width,
    tooth_outlines,
    under_load,
)
from gearpair.plotting.waves import harmonics, stiffness_wave

__all__ = [
    "CHANGES",
    "MOTION_COLOURS",
    "STYLE",
    "add_motion_legend",
    "attractor_points",
    "attractor_shares",
    "bare",
    "basins",
    "bifurcation_curves",
    "bifurcation_diagram",
    "boundaries_by_step",
    "branches",
    "certificate",
    "certified_steps",
    "chaotic_saddle",
    "compliance_stack",
    "contact_ratio_cloud",
    "coverage_by_phase",
    "drawn_diagram",
    "dynamic_factors",
    "exponents",
    "extremes",
    "finite_element_check",
    "finite_exponents",
    "fold_curves",
    "gallery",
    "harmonics",
    "impact_map",
    "impact_states",
    "interpolation_error",
    "load_map",
    "load_shares",
    "manifolds",
    "mark_boundaries",
    "mesh_curves",
    "motion_colour",
    "motion_shares",
    "order_map",
    "pair_stiffness",
    "passage_factor",
    "passage_path",
    "per_width",
    "period_map",
    "phase_portrait",
    "poincare_section",
    "portrait",
    "quantity_map",
    "range_lanes",
    "range_strips",
    "rattle",
    "rattling_share",
    "reached_motions",
    "score_ranking",
    "shock_margins",
    "spectrum",
    "step_convergence",
    "stiffness_trends",
    "stiffness_wave",
    "survival_curve",
    "survival_curves",
    "time_history",
    "tooth_loads",
    "tooth_outlines",
    "tornado",
    "under_load",
    "work_precision",
]
