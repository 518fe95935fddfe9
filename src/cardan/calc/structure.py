"""Calculations of structure: pairs, counting formulas, true mobility, releases, groups of links."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.analysis.finite_mobility import CLOSED, finite_mobility
from cardan.analysis.mobility import mobility
from cardan.analysis.release import release
from cardan.errors import InputError, Problem, check
from cardan.mechanism.groups import MOST, group, minus_groups, zero_groups
from cardan.mechanism.mechanism import Mechanism
from cardan.mechanism.pair import PAIRS, Pair, pair_problems
from cardan.mechanism.partition import Join, partition
from cardan.texts import _

from .calculation import Calculation, Given, Values, given, gives, record, rows

SOURCE = "structure of mechanisms by screws; Book p. 11-16, 74-77; tmm (1.1)-(1.5)"


def _word(key: str, doc: str, **options: Any) -> Given:
    return given(key, doc, kind="word", **options)


def _way(key: str, doc: str, **options: Any) -> Given:
    return given(key, doc, axes=(1,), width=3, **options)


TYPE = _word("type", _("kind of pair"), choices=tuple(PAIRS))

FRAME = _word("frame", _("the link at rest"))

JOINTS = rows(
    "joints",
    _("the joints, in the position in which they are assembled"),
    _word("id", _("name of the joint")),
    TYPE,
    given("links", _("the two links it joins"), kind="word", axes=(1,)),
    given("point_m", _("a point of its axis"), "length", axes=(1,), width=3),
    _way("axis", _("its axis, or the normal of its plane"), default=None),
    _way("axis2", _("second axis of U and L4"), default=None),
    given("pitch_m_per_rad", _("lead of a helical pair"), "pitch", default=None),
)

LINKS = (
    _word("input_link", _("link that is driven"), default=""),
    _word("output_link", _("link that is to move"), default=""),
)


def _row(vector: Any) -> tuple[float, float, float] | None:
    return None if vector is None else (float(vector[0]), float(vector[1]), float(vector[2]))


def _pair(row: Values) -> Pair:
    kind = PAIRS[row["type"]]
    point = _row(row["point"])
    assert point is not None
    return Pair(
        id=row["id"],
        type=row["type"],
        links=(row["links"][0], row["links"][1]),
        point=point,
        axis=_row(row["axis"]),
        axis2=_row(row["axis2"]) if kind.needs_second else None,
        pitch=row["pitch"] if kind.screw else None,
    )


def _two_links(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield joints that do not join two links."""
    for k, row in enumerate(values.get("joints") or values.get("pairs") or ()):
        ends = row.get("links")
        if ends is not None and len(ends) != 2:
            name = "joints" if "joints" in values else "pairs"
            text = _("{count} links given; a joint joins two")
            yield Problem(f"{key(name)}[{k}].links", text.format(count=len(ends)))


def _mechanism(values: Values) -> Mechanism:
    return Mechanism(
        frame=values["frame"],
        joints=tuple(_pair(row) for row in values["joints"]),
        input_link=values.get("input_link", ""),
        output_link=values.get("output_link", ""),
    )


def _class(values: Values) -> Values:
    kind = PAIRS[values["type"]]
    axis, axis2 = _row(values["axis"]), _row(values["axis2"])
    given_axes = {"axis": axis or (0.0, 0.0, 1.0), "axis2": axis2 or (1.0, 0.0, 0.0)}
    if axis or axis2:  # what is given is looked at, what is not is no matter here
        whole = Pair(
            id="",
            type=values["type"],
            links=("0", "1"),
            point=(0.0, 0.0, 0.0),
            axis=axis or (given_axes["axis"] if axis2 is None else None),
            axis2=(axis2 or None) if kind.needs_second else None,
            pitch=0.0 if kind.screw else None,
        )
        check(one for one in pair_problems(whole) if values[one.field] is not None)
    return {"freedoms": kind.freedoms, "constraints": kind.constraints, "genus": kind.freedoms}


def _formula(values: Values) -> Values:
    links = values["moving_links"]
    counts = [values[f"p{f}"] for f in range(1, 6)]
    formula = 6 * links - sum((6 - f) * count for f, count in enumerate(counts, 1))
    return {"W_formula": formula, "q": values["required_mobility"] - formula, "loops": sum(counts) - links}


def _planar(values: Values) -> Values:
    links, lower, higher = (values[name] for name in ("moving_links", "p1", "p2"))
    return {"W": 3 * links - 2 * lower - higher, "loops": lower + higher - links}


def _instantaneous(values: Values) -> Values:
    found = mobility(_mechanism(values))
    return {
        "moving_links": found.links,
        "loops": found.loops,
        "sum_constraints": found.constraints,
        "rank": found.rank,
        "W": found.mobility,
        "q": found.redundant,
        "W_formula": found.formula,
        "local_mobilities": found.local,
        "parasitic_mobilities": found.parasitic,
        "rank_certain": found.certain,
        "strained_joints": list(found.strained),
    }


def _release(values: Values) -> Values:
    wanted = values["release"]
    mechanism = _mechanism(values)
    try:
        found = release(mechanism, wanted["joint"], wanted["kind"], wanted["axis"])
    except InputError as error:
        raise error.renamed(lambda field: f"release.{field}") from None
    return {"delta_q": found.redundant, "delta_W": found.mobility}


def _finite(values: Values) -> Values:
    names = {"angle": "drive", "tolerance": "closure_tolerance"}
    mechanism = _mechanism(values)
    try:
        found = finite_mobility(
            mechanism,
            driven_joint=values["driven_joint"],
            angle=values["drive"],
            tolerance=values["closure_tolerance"],
            steps=values["steps"],
        )
    except InputError as error:
        raise error.renamed(lambda field: names.get(field, field)) from None
    return {
        "closes": found.closes,
        "max_residual": float(np.max(found.residual)),
        "residual_at_end": float(found.residual[-1]),
        "max_gap_m": float(np.max(found.gap)),
        "max_turn_deg": float(np.max(found.turn)),
    }


def _partition(values: Values) -> Values:
    pairs = [Join(links=(row["links"][0], row["links"][1]), constraints=row["constraints"]) for row in values["pairs"]]
    found = partition(pairs, frame=values["frame"], input_link=values["input_link"])
    groups = found.groups
    return {
        "W_formula": found.formula,
        "q_structural": found.redundant,
        "W_structural": found.mobility,
        "overconstrained_links": list(found.overconstrained),
        "removed_groups": None if groups is None else [{"links": list(g.links), "W": g.mobility} for g in groups],
    }


def _zero(values: Values) -> Values:
    found = zero_groups(values["links"])
    return {"count": len(found), "formulas": [list(one.constraints) for one in found]}


def _minus(values: Values) -> Values:
    tables = {m: minus_groups(values["constraints"], m) for m in range(1, 5 + 1)}
    formulas = {str(m): [list(one.constraints) for one in found] for m, found in tables.items() if found}
    return {"count_by_links": {m: len(found) for m, found in formulas.items()}, "formulas": formulas}


def _classify(values: Values) -> Values:
    names = {"constraints": "pair_constraints"}
    try:
        found = group(values["pair_constraints"].tolist())
    except InputError as error:
        raise error.renamed(lambda f: f.replace("constraints", names["constraints"], 1)) from None
    return {"links": found.links, "W": found.mobility, "kind": found.kind, "net_constraints": found.net}


def _count(key: str, doc: str, **options: Any) -> Given:
    return given(key, doc, kind="whole", low=0.0, **options)


CALCULATIONS = (
    Calculation(
        name="pair_class",
        doc=_("freedoms and constraints of a kind of kinematic pair"),
        source="Book p. 11, Table 1; tmm Table 1",
        takes=(
            TYPE,
            _way("axis", _("its axis, looked at if given"), default=None),
            _way("axis2", _("second axis of U and L4, looked at if given"), default=None),
        ),
        returns=(
            gives("freedoms", _("relative freedoms f")),
            gives("constraints", _("constraints s = 6 - f")),
            gives("genus", _("genus of the pair, as the Book counts it: f")),
        ),
        answer=_class,
    ),
    Calculation(
        name="mobility_formula",
        doc=_("mobility by counting, and the redundant constraints that a wanted mobility implies"),
        source="Book (1); tmm (1.3)-(1.5), Somov and Malyshev",
        takes=(
            given("moving_links", _("moving links"), kind="whole", low=1.0),
            *(_count(f"p{f}", _("pairs with {f} freedoms").format(f=f), default=0) for f in range(1, 6)),
            given("required_mobility", _("mobility that it has in truth"), kind="whole", default=1),
        ),
        returns=(
            gives("W_formula", _("6n - Σs")),
            gives("q", _("redundant constraints; negative: spare mobility")),
            gives("loops", _("independent loops")),
        ),
        answer=_formula,
    ),
    Calculation(
        name="planar_mobility",
        doc=_("mobility of a planar mechanism by counting"),
        source="tmm (1.2), (1.4), Chebyshev",
        takes=(
            given("moving_links", _("moving links"), kind="whole", low=1.0),
            _count("p1", _("pairs with one freedom in the plane"), default=0),
            _count("p2", _("pairs with two freedoms in the plane"), default=0),
        ),
        returns=(gives("W", _("3n - 2p1 - p2")), gives("loops", _("independent loops"))),
        answer=_planar,
    ),
    Calculation(
        name="instantaneous_mobility",
        doc=_("true mobility and redundant constraints of a mechanism in its position, by the rank of its constraints"),
        source=SOURCE,
        takes=(FRAME, JOINTS, *LINKS),
        returns=(
            gives("moving_links", _("moving links n")),
            gives("loops", _("independent loops k")),
            gives("sum_constraints", _("Σs")),
            gives("rank", _("how many constraints differ")),
            gives("W", _("true mobility")),
            gives("q", _("redundant constraints")),
            gives("W_formula", _("mobility by counting, W - q")),
            gives("local_mobilities", _("motions in which neither input nor output moves")),
            gives("parasitic_mobilities", _("other motions left while the input stands still")),
            gives("rank_certain", _("whether the singular values fall into two groups far apart")),
            gives("strained_joints", _("joints that parts which are off can strain")),
        ),
        answer=_instantaneous,
        check=_two_links,
    ),
    Calculation(
        name="release_analysis",
        doc=_("what one more freedom at a joint does to redundant constraints and mobility"),
        source=SOURCE,
        takes=(
            FRAME,
            JOINTS,
            *LINKS,
            record(
                "release",
                _("the freedom that is added"),
                _word("joint", _("at which joint")),
                _word("kind", _("turning or sliding"), choices=("rot", "trans")),
                _way("axis", _("about or along which direction, through the joint's point")),
            ),
        ),
        returns=(
            gives("delta_q", _("change of the redundant constraints")),
            gives("delta_W", _("change of the mobility")),
        ),
        answer=_release,
        check=_two_links,
    ),
    Calculation(
        name="finite_mobility",
        doc=_("whether the loops of a mechanism close while a joint is driven far"),
        source="closure of the loops by least squares, products of exponentials",
        takes=(
            FRAME,
            JOINTS,
            *LINKS,
            _word("driven_joint", _("joint that is driven; it turns")),
            given("drive_deg", _("how far"), "angle"),
            given("closure_tolerance", _("residual below which loops are closed"), above=0.0, default=CLOSED),
            given("steps", _("steps on the way; below 4° each by default"), kind="whole", low=1.0, default=None),
        ),
        returns=(
            gives("closes", _("whether they close at every step")),
            gives("max_residual", _("largest residual: root of the sum of squares of gaps [m] and turns [rad]")),
            gives("residual_at_end", _("residual at the last step")),
            gives("max_gap_m", _("largest gap at a cut joint"), "length"),
            gives("max_turn_deg", _("largest turn at a cut joint"), "angle"),
        ),
        answer=_finite,
        check=_two_links,
    ),
    Calculation(
        name="structural_partition",
        doc=_("what counting alone tells of a graph of links: where it is held too much, and its groups"),
        source="Book p. 12-14, 76-77; minimum over sets of links",
        takes=(
            FRAME,
            _word("input_link", _("link that is driven")),
            rows(
                "pairs",
                _("pairs of the graph"),
                given("links", _("the two links"), kind="word", axes=(1,)),
                given("constraints", _("how many motions it holds"), kind="whole", low=1.0, high=float(MOST)),
            ),
        ),
        returns=(
            gives("W_formula", _("6n - Σs")),
            gives("q_structural", _("constraints too many, whatever the geometry")),
            gives("W_structural", _("formula and these together")),
            gives("overconstrained_links", _("links among which they are")),
            gives("removed_groups", _("groups of links from the output end on, with their mobility")),
        ),
        answer=_partition,
        check=_two_links,
    ),
    Calculation(
        name="zero_groups",
        doc=_("all zero groups that are simple chains of so many links"),
        source="Book Table 2, restored by enumeration",
        takes=(given("links", _("links of the group"), kind="whole", low=1.0, high=100.0),),
        returns=(
            gives("count", _("how many there are")),
            gives("formulas", _("their strings of constraints, in descending order")),
        ),
        answer=_zero,
    ),
    Calculation(
        name="minus_groups",
        doc=_("all simple chains that impose so many constraints"),
        source="Book Table 3, restored by enumeration",
        takes=(given("constraints", _("constraints imposed"), kind="whole", low=1.0, high=float(MOST)),),
        returns=(
            gives("count_by_links", _("how many there are by number of links")),
            gives("formulas", _("their strings of constraints by number of links")),
        ),
        answer=_minus,
    ),
    Calculation(
        name="classify_group",
        doc=_("what a chain of pairs is: zero, minus or plus group"),
        source="Book (2)",
        takes=(given("pair_constraints", _("constraints of each pair along the chain"), kind="whole", axes=(1,)),),
        returns=(
            gives("links", _("links")),
            gives("W", _("6m - Σs")),
            gives("kind", _("zero, minus or plus")),
            gives("net_constraints", _("constraints that it imposes, -W")),
        ),
        answer=_classify,
    ),
)
