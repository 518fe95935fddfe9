"""Calculations of structure: pairs, counting formulas, true mobility, releases, groups of links."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.calc.calculation import Calculation, Given, Values, given, gives, record, rows
from cardan.errors import InputError, Problem, check
from cardan.mechanism.groups import MOST, group, minus_groups, zero_groups
from cardan.mechanism.mechanism import Mechanism
from cardan.mechanism.pair import PAIRS, Pair, pair_problems
from cardan.mechanism.partition import Join, partition
from cardan.questions.mobility.finite_mobility import CLOSED, finite_mobility
from cardan.questions.mobility.mobility import mobility
from cardan.questions.mobility.release import release
from cardan.texts import _, mark

SOURCE = "structure of mechanisms by screws; Kozhevnikov & Perfil'ev (1978), pp. 11–16, 74-77; tmm (1.1)-(1.5)"


def _word(key: str, doc: str, **options: Any) -> Given:
    return given(key, doc, kind="word", **options)


def _way(key: str, doc: str, **options: Any) -> Given:
    return given(key, doc, axes=(1,), width=3, **options)


TYPE = _word("type", mark("kind of pair"), choices=tuple(PAIRS))

FRAME = _word("frame", mark("the link at rest"))

JOINTS = rows(
    "joints",
    mark("the joints, in the position in which they are assembled"),
    _word("id", mark("name of the joint")),
    TYPE,
    given("links", mark("the two links it joins"), kind="word", axes=(1,)),
    given("point_m", mark("a point of its axis"), "length", axes=(1,), width=3),
    _way("axis", mark("its axis, or the normal of its plane"), default=None),
    _way("axis2", mark("second axis of U and L4"), default=None),
    given("pitch_m_per_rad", mark("lead of a helical pair"), "pitch", default=None),
)

LINKS = (
    _word("input_link", mark("link that is driven"), default=""),
    _word("output_link", mark("link that is to move"), default=""),
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
        doc=mark("freedoms and constraints of a kind of kinematic pair"),
        source="Kozhevnikov & Perfil'ev (1978), p. 11, Table 1; tmm Table 1",
        takes=(
            TYPE,
            _way("axis", mark("its axis, looked at if given"), default=None),
            _way("axis2", mark("second axis of U and L4, looked at if given"), default=None),
        ),
        returns=(
            gives("freedoms", mark("relative freedoms f")),
            gives("constraints", mark("constraints s = 6 - f")),
            gives("genus", mark("genus of the pair, as Kozhevnikov & Perfil'ev (1978) count it: f")),
        ),
        answer=_class,
    ),
    Calculation(
        name="mobility_formula",
        doc=mark("mobility by counting, and the redundant constraints that a wanted mobility implies"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 1; tmm (1.3)-(1.5), Somov and Malyshev",
        takes=(
            given("moving_links", mark("moving links"), kind="whole", low=1.0),
            _count("p1", mark("pairs with 1 freedom"), default=0),
            _count("p2", mark("pairs with 2 freedoms"), default=0),
            _count("p3", mark("pairs with 3 freedoms"), default=0),
            _count("p4", mark("pairs with 4 freedoms"), default=0),
            _count("p5", mark("pairs with 5 freedoms"), default=0),
            given("required_mobility", mark("mobility that it has in truth"), kind="whole", default=1),
        ),
        returns=(
            gives("W_formula", mark("6n - Σs")),
            gives("q", mark("redundant constraints; negative: spare mobility")),
            gives("loops", mark("independent loops")),
        ),
        answer=_formula,
    ),
    Calculation(
        name="planar_mobility",
        doc=mark("mobility of a planar mechanism by counting"),
        source="tmm (1.2), (1.4), Chebyshev",
        takes=(
            given("moving_links", mark("moving links"), kind="whole", low=1.0),
            _count("p1", mark("pairs with one freedom in the plane"), default=0),
            _count("p2", mark("pairs with two freedoms in the plane"), default=0),
        ),
        returns=(gives("W", mark("3n - 2p1 - p2")), gives("loops", mark("independent loops"))),
        answer=_planar,
    ),
    Calculation(
        name="instantaneous_mobility",
        doc=mark(
            "true mobility and redundant constraints of a mechanism in its position, by the rank of its constraints"
        ),
        source=SOURCE,
        takes=(FRAME, JOINTS, *LINKS),
        returns=(
            gives("moving_links", mark("moving links n")),
            gives("loops", mark("independent loops k")),
            gives("sum_constraints", mark("Σs")),
            gives("rank", mark("how many constraints differ")),
            gives("W", mark("true mobility")),
            gives("q", mark("redundant constraints")),
            gives("W_formula", mark("mobility by counting, W - q")),
            gives("local_mobilities", mark("motions in which neither input nor output moves")),
            gives("parasitic_mobilities", mark("other motions left while the input stands still")),
            gives("rank_certain", mark("whether the singular values fall into two groups far apart")),
            gives("strained_joints", mark("joints that parts which are off can strain")),
        ),
        answer=_instantaneous,
        check=_two_links,
    ),
    Calculation(
        name="release_analysis",
        doc=mark("what one more freedom at a joint does to redundant constraints and mobility"),
        source=SOURCE,
        takes=(
            FRAME,
            JOINTS,
            *LINKS,
            record(
                "release",
                mark("the freedom that is added"),
                _word("joint", mark("at which joint")),
                _word("kind", mark("turning or sliding"), choices=("rot", "trans")),
                _way("axis", mark("about or along which direction, through the joint's point")),
            ),
        ),
        returns=(
            gives("delta_q", mark("change of the redundant constraints")),
            gives("delta_W", mark("change of the mobility")),
        ),
        answer=_release,
        check=_two_links,
    ),
    Calculation(
        name="finite_mobility",
        doc=mark("whether the loops of a mechanism close while a joint is driven far"),
        source="closure of the loops by least squares, products of exponentials",
        takes=(
            FRAME,
            JOINTS,
            *LINKS,
            _word("driven_joint", mark("joint that is driven; it turns")),
            given("drive_deg", mark("how far"), "angle"),
            given("closure_tolerance", mark("residual below which loops are closed"), above=0.0, default=CLOSED),
            given("steps", mark("steps on the way; below 4° each by default"), kind="whole", low=1.0, default=None),
        ),
        returns=(
            gives("closes", mark("whether they close at every step")),
            gives("max_residual", mark("largest residual: root of the sum of squares of gaps [m] and turns [rad]")),
            gives("residual_at_end", mark("residual at the last step")),
            gives("max_gap_m", mark("largest gap at a cut joint"), "length"),
            gives("max_turn_deg", mark("largest turn at a cut joint"), "angle"),
        ),
        answer=_finite,
        check=_two_links,
    ),
    Calculation(
        name="structural_partition",
        doc=mark("what counting alone tells of a graph of links: where it is held too much, and its groups"),
        source="Kozhevnikov & Perfil'ev (1978), pp. 12–14, 76-77; minimum over sets of links",
        takes=(
            FRAME,
            _word("input_link", mark("link that is driven")),
            rows(
                "pairs",
                mark("pairs of the graph"),
                given("links", mark("the two links"), kind="word", axes=(1,)),
                given("constraints", mark("how many motions it holds"), kind="whole", low=1.0, high=float(MOST)),
            ),
        ),
        returns=(
            gives("W_formula", mark("6n - Σs")),
            gives("q_structural", mark("constraints too many, whatever the geometry")),
            gives("W_structural", mark("formula and these together")),
            gives("overconstrained_links", mark("links among which they are")),
            gives("removed_groups", mark("groups of links from the output end on, with their mobility")),
        ),
        answer=_partition,
        check=_two_links,
    ),
    Calculation(
        name="zero_groups",
        doc=mark("all zero groups that are simple chains of so many links"),
        source="Kozhevnikov & Perfil'ev (1978), Table 2, restored by enumeration",
        takes=(given("links", mark("links of the group"), kind="whole", low=1.0, high=100.0),),
        returns=(
            gives("count", mark("how many there are")),
            gives("formulas", mark("their strings of constraints, in descending order")),
        ),
        answer=_zero,
    ),
    Calculation(
        name="minus_groups",
        doc=mark("all simple chains that impose so many constraints"),
        source="Kozhevnikov & Perfil'ev (1978), Table 3, restored by enumeration",
        takes=(given("constraints", mark("constraints imposed"), kind="whole", low=1.0, high=float(MOST)),),
        returns=(
            gives("count_by_links", mark("how many there are by number of links")),
            gives("formulas", mark("their strings of constraints by number of links")),
        ),
        answer=_minus,
    ),
    Calculation(
        name="classify_group",
        doc=mark("what a chain of pairs is: zero, minus or plus group"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 2",
        takes=(given("pair_constraints", mark("constraints of each pair along the chain"), kind="whole", axes=(1,)),),
        returns=(
            gives("links", mark("links")),
            gives("W", mark("6m - Σs")),
            gives("kind", mark("zero, minus or plus")),
            gives("net_constraints", mark("constraints that it imposes, -W")),
        ),
        answer=_classify,
    ),
)
