"""Structure: pairs, counting formulas, true mobility, releases, groups of links."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.errors import InputError, Problem, check
from cardan.mechanism.counting import MOST, Join, group, minus_groups, partition, zero_groups
from cardan.mechanism.mechanism import PAIRS, Mechanism, Pair, pair_problems
from cardan.questions.mobility.constraint_release import release
from cardan.questions.mobility.finite_mobility import CLOSED, finite_mobility
from cardan.questions.mobility.mobility import mobility
from cardan.reading.given import given, gives, positive, record, rows, vector, whole, word
from cardan.texts import _

formula = Formulas(__doc__)

SOURCE = "structure of mechanisms by screws; Kozhevnikov & Perfil'ev (1978), pp. 11–16, 74-77; tmm (1.1)-(1.5)"

TYPE = word("type", "kind of pair", *PAIRS)

FRAME = word("frame", "the link at rest")

JOINTS = rows(
    "joints",
    "the joints, in the position in which they are assembled",
    word("id", "name of the joint"),
    TYPE,
    word("links", "the two links it joins", axes=1),
    given("point_m", "a point of its axis", axes=1, width=3),
    vector("axis", "its axis, or the normal of its plane", default=None),
    vector("axis2", "second axis of U and L4", default=None),
    given("pitch_m_per_rad", "lead of a helical pair", default=None),
)

LINKS = (word("input_link", "link that is driven", default=""), word("output_link", "link that is to move", default=""))


def _row(vector: Any) -> tuple[float, float, float] | None:
    return None if vector is None else (float(vector[0]), float(vector[1]), float(vector[2]))


def _pair(row: Values) -> Pair:
    kind = PAIRS[row.type]
    point = _row(row.point)
    assert point is not None
    return Pair(
        id=row.id,
        type=row.type,
        links=(row.links[0], row.links[1]),
        point=point,
        axis=_row(row.axis),
        axis2=_row(row.axis2) if kind.needs_second else None,
        pitch=row.pitch if kind.screw else None,
    )


def _two_links(v: Values) -> Problems:
    """Yield joints that do not join two links."""
    for k, row in enumerate(v.get("joints") or v.get("pairs") or ()):
        ends = row.get("links")
        if ends is not None and len(ends) != 2:
            name = "joints" if "joints" in v else "pairs"
            text = _("{count} links given; a joint joins two")
            yield Problem(f"{v.key(name)}[{k}].links", text.format(count=len(ends)))


def _mechanism(v: Values) -> Mechanism:
    return Mechanism(
        frame=v.frame,
        joints=tuple(_pair(row) for row in v.joints),
        input_link=v.get("input_link", ""),
        output_link=v.get("output_link", ""),
    )


@formula(
    "freedoms and constraints of a kind of kinematic pair",
    "Kozhevnikov & Perfil'ev (1978), p. 11, Table 1; tmm Table 1",
    TYPE,
    vector("axis", "its axis, looked at if given", default=None),
    vector("axis2", "second axis of U and L4, looked at if given", default=None),
    "freedoms: relative freedoms f",
    "constraints: constraints s = 6 - f",
    "genus: genus of the pair, as Kozhevnikov & Perfil'ev (1978) count it: f",
)
def _pair_class(v: Values) -> Any:
    kind = PAIRS[v.type]
    axis, axis2 = _row(v.axis), _row(v.axis2)
    given_axes = {"axis": axis or (0.0, 0.0, 1.0), "axis2": axis2 or (1.0, 0.0, 0.0)}
    if axis or axis2:  # what is given is looked at, what is not is no matter here
        whole = Pair(
            id="",
            type=v.type,
            links=("0", "1"),
            point=(0.0, 0.0, 0.0),
            axis=axis or (given_axes["axis"] if axis2 is None else None),
            axis2=(axis2 or None) if kind.needs_second else None,
            pitch=0.0 if kind.screw else None,
        )
        check(one for one in pair_problems(whole) if v[one.field] is not None)
    return kind.freedoms, kind.constraints, kind.freedoms


@formula(
    "mobility by counting, and the redundant constraints that a wanted mobility implies",
    "Kozhevnikov & Perfil'ev (1978), eq. 1; tmm (1.3)-(1.5), Somov and Malyshev",
    whole("moving_links", "moving links", low=1.0),
    whole("p1", "pairs with 1 freedom", low=0, default=0),
    whole("p2", "pairs with 2 freedoms", low=0, default=0),
    whole("p3", "pairs with 3 freedoms", low=0, default=0),
    whole("p4", "pairs with 4 freedoms", low=0, default=0),
    whole("p5", "pairs with 5 freedoms", low=0, default=0),
    whole("required_mobility", "mobility that it has in truth", default=1),
    "W_formula: 6n - Σs",
    "q: redundant constraints; negative: spare mobility",
    "loops: independent loops",
)
def _mobility_formula(v: Values) -> Any:
    links = v.moving_links
    counts = [v[f"p{f}"] for f in range(1, 6)]
    formula = 6 * links - sum((6 - f) * count for f, count in enumerate(counts, 1))
    return formula, v.required_mobility - formula, sum(counts) - links


@formula(
    "mobility of a planar mechanism by counting",
    "tmm (1.2), (1.4), Chebyshev",
    whole("moving_links", "moving links", low=1.0),
    whole("p1", "pairs with one freedom in the plane", low=0, default=0),
    whole("p2", "pairs with two freedoms in the plane", low=0, default=0),
    "W: 3n - 2p1 - p2",
    "loops: independent loops",
)
def _planar_mobility(v: Values) -> Any:
    links, lower, higher = (v[name] for name in ("moving_links", "p1", "p2"))
    return 3 * links - 2 * lower - higher, lower + higher - links


@formula(
    "true mobility and redundant constraints of a mechanism in its position, by the rank of its constraints",
    SOURCE,
    (FRAME, JOINTS, *LINKS),
    "moving_links = links: moving links n",
    "loops: independent loops k",
    "sum_constraints = constraints: Σs",
    "rank: how many constraints differ",
    "W = mobility: true mobility",
    "q = redundant: redundant constraints",
    "W_formula = formula: mobility by counting, W - q",
    "local_mobilities = local: motions in which neither input nor output moves",
    "parasitic_mobilities = parasitic: other motions left while the input stands still",
    "rank_certain = certain: whether the singular values fall into two groups far apart",
    "strained_joints: joints that parts which are off can strain",
    check=_two_links,
)
def _instantaneous_mobility(v: Values) -> Any:
    found = mobility(_mechanism(v))
    return found, {"strained_joints": list(found.strained)}


@formula(
    "what one more freedom at a joint does to redundant constraints and mobility",
    SOURCE,
    (FRAME, JOINTS, *LINKS),
    record(
        "release",
        "the freedom that is added",
        word("joint", "at which joint"),
        word("kind", "turning or sliding", "rot", "trans"),
        vector("axis", "about or along which direction, through the joint's point"),
    ),
    "delta_q: change of the redundant constraints",
    gives("delta_W", "change of the mobility", None),
    check=_two_links,
)
def _release_analysis(v: Values) -> Any:
    wanted = v.release
    mechanism = _mechanism(v)
    try:
        found = release(mechanism, wanted["joint"], wanted["kind"], wanted["axis"])
    except InputError as error:
        raise error.renamed(lambda field: f"release.{field}") from None
    return found.redundant, found.mobility


@formula(
    "whether the loops of a mechanism close while a joint is driven far",
    "closure of the loops by least squares, products of exponentials",
    (FRAME, JOINTS, *LINKS),
    word("driven_joint", "joint that is driven; it turns"),
    given("drive_deg", "how far"),
    positive("closure_tolerance", "residual below which loops are closed", default=CLOSED),
    whole("steps", "steps on the way; below 4° each by default", low=1.0, default=None),
    "closes: whether they close at every step",
    "max_residual: largest residual: root of the sum of squares of gaps [m] and turns [rad]",
    "residual_at_end: residual at the last step",
    "max_gap_m: largest gap at a cut joint",
    "max_turn_deg: largest turn at a cut joint",
    check=_two_links,
)
def _finite_mobility(v: Values) -> Any:
    mechanism = _mechanism(v)
    found = finite_mobility(mechanism, **v.of("driven_joint", "steps", angle="drive", tolerance="closure_tolerance"))
    most = [float(np.max(one)) for one in (found.residual, found.gap, found.turn)]
    return found.closes, most[0], float(found.residual[-1]), *most[1:]


@formula(
    "what counting alone tells of a graph of links: where it is held too much, and its groups",
    "Kozhevnikov & Perfil'ev (1978), pp. 12–14, 76-77; minimum over sets of links",
    FRAME,
    word("input_link", "link that is driven"),
    rows(
        "pairs",
        "pairs of the graph",
        word("links", "the two links", axes=1),
        whole("constraints", "how many motions it holds", low=1.0, high=float(MOST)),
    ),
    "W_formula = formula: 6n - Σs",
    "q_structural = redundant: constraints too many, whatever the geometry",
    "W_structural = mobility: formula and these together",
    "overconstrained_links: links among which they are",
    "removed_groups: groups of links from the output end on, with their mobility",
    check=_two_links,
)
def _structural_partition(v: Values) -> Any:
    pairs = [Join(links=(row.links[0], row.links[1]), constraints=row.constraints) for row in v.pairs]
    found = partition(pairs, frame=v.frame, input_link=v.input_link)
    groups = found.groups
    return found, {
        "overconstrained_links": list(found.overconstrained),
        "removed_groups": None if groups is None else [{"links": list(g.links), "W": g.mobility} for g in groups],
    }


@formula(
    "all zero groups that are simple chains of so many links",
    "Kozhevnikov & Perfil'ev (1978), Table 2, restored by enumeration",
    whole("links", "links of the group", low=1.0, high=100.0),
    "count: how many there are",
    "formulas: their strings of constraints, in descending order",
)
def _zero_groups(v: Values) -> Any:
    found = zero_groups(v.links)
    return len(found), [list(one.constraints) for one in found]


@formula(
    "all simple chains that impose so many constraints",
    "Kozhevnikov & Perfil'ev (1978), Table 3, restored by enumeration",
    whole("constraints", "constraints imposed", low=1.0, high=float(MOST)),
    "count_by_links: how many there are by number of links",
    "formulas: their strings of constraints by number of links",
)
def _minus_groups(v: Values) -> Any:
    tables = {m: minus_groups(v.constraints, m) for m in range(1, 5 + 1)}
    formulas = {str(m): [list(one.constraints) for one in found] for m, found in tables.items() if found}
    return {m: len(found) for m, found in formulas.items()}, formulas


@formula(
    "what a chain of pairs is: zero, minus or plus group",
    "Kozhevnikov & Perfil'ev (1978), eq. 2",
    whole("pair_constraints", "constraints of each pair along the chain", axes=1),
    "links: links",
    "W: 6m - Σs",
    "kind: zero, minus or plus",
    "net_constraints: constraints that it imposes, -W",
)
def _classify_group(v: Values) -> Any:
    found = group(v.pair_constraints.tolist())
    return found.links, found.mobility, found.kind, found.net
