"""What the old program left out, so that its numbers are other ones now, each with the reason."""

from __future__ import annotations

WORST = "the largest loads and joint angles of poses and movements count, not those of the drive as drawn"

TOP = "the speeds in use end where the range is varied to end, so that a lower end is a remedy too"

HELD = "end shafts without a support are held by their machines, as in forces, bending and assembly"

BINS = "bins are as wide as a power of two of the unit, which is per cent now"
ALIKE = (
    "one steady motion is judged, with the structural damping of its main order; disturbances have that of their zone"
)
BANDS = "orders that do not repeat are answered with the joints, side bands and all, and no longer by the straight line"

TOGETHER = "growth at a speed is that of the motion with the orders that do not repeat"

LACKS = "a joint without a cross no longer silences the other joints: what is refused is what the file lacks"

MORE = "the best settings on spline teeth over all poses stand beside those without teeth"

PLANES = "unbalance is judged per tolerance plane, with the shares of ISO 21940-11; the static part is told by itself"

HALVES = "a splined shaft is two bodies: each half's weight along it is held on its own side of the spline"
MADE = "only remedies that were made and with which the mechanism turned all round, three at most"
WOBBLE = "the shaft of a tripod pivots on the next joint, which feels that it nutates"
TOPS = "the tops of a movement between the instants are found by one rule, and all questions tell the same"

DRIFT = "above a resonance a drift of the mean speed under constant torques is no vibration that grows"

BOUNCES = "the wear of a spline slackens the shaft that bows, not the supports on which a line bounces"

KINDS = "joints of every kind count in torsional vibration, each by its law"

RATED = "a size of joint whose torque its maker does not tell is not judged, and not taken"

INSIDE = "the contact pressure of balls and rollers is judged, as advice"

SIGN = "of a shape that is alike both ways the first peak counts; rounding had decided its sign"

SEVERAL = "with open backlash stable motions are found where none was; told is that of the largest alternating torque"

LASTS = "a size lasts over load cases, poses and movements, with the reliability asked, and not at the peak throughout"

GUIDES = "limits and factors of practice stand beside the other tables"

DIGITS = "joint angles at a speed have the digits of Spicer's table, in twelfths of a degree, and no longer tenths"

GREASES = "intervals of lubrication of industrial shafts and of power take-offs stand beside those of the book"

TEETH = "a yoke on a spline is turned from tooth to tooth, so that a remedy is an angle that exists"

SOUGHT = "joints shake a line whatever it carries, so that the torque rating is sought and not found in proportion"

EVEN = "a simulation starts with shafts that turn as rigid ones, not each part at the speed of the input"

TURNED = "gaps are not told to stay closed where torsional vibration turns the torque about; reversals are told instead"

GROWS = "nothing rests on the torque of a motion that is unstable at a speed in use: such limits are not judged"

HEAVIEST = "where the duty has no torque, the answer is of its heaviest load case"

FIRST = "of peaks that repeat the first is told; which one was largest had been decided by rounding"

NUMBERS: tuple[tuple[str, str, str], ...] = (
    (r"torsion simulate examples/truck-supports\.toml --settled", r"elements\.(max|min)_at_s", FIRST),
    (r"catalogue$", r"tables\.rows", GUIDES),
    (r"catalogue (max_bends|max_joint_angles)", r"rows\.max_(bend|joint_angle)_deg", DIGITS),
    (
        r"check examples/(composite-propshaft|six-joints|truck-(duty-cycle|rear-axle|supports)|two-piece-rear-drive"
        r"|w-arrangement)\.toml",
        r"verdicts\.(limit|utilisation)",
        DIGITS,
    ),
    (r"catalogue lubrication", r"rows\.(hours_h|years|distance_km)", GREASES),
    (r"torsion response examples/pto-flywheel\.toml --speeds", r".*", SEVERAL),
    (r"torsion simulate (?!.*--settled)", r"(curves|elements|stations)\..*|steps|imbalance.*", EVEN),
    (r"torsion road examples/pto-baler", r"largest_torque_open_backlash_Nm", SEVERAL),
    (
        r"select examples/(pto-hitch|rolling-mill-(lower|upper)-spindle|truck-rear-axle)\.toml --torque-Nm",
        r"(need|sizes|types)\..*",
        WORST,
    ),
    (r"bending examples/((car|composite)-propshaft|mill-spindle|pto-drive)\.toml", r"modes\.(deflection|slope)", SIGN),
    (r"(motion|phases) examples/front-halfshaft", r".*", WOBBLE),
    (r"mobility examples/", r"(repairs|remedies)\..*", MADE),
    (r"check examples/front-halfshaft", r"verdicts\.(utilisation|value)", WOBBLE),
    (
        r"bending examples/two-piece-rubber-bearing",
        r"modes\.(actual_rpm|half_band_rpm|passing_full_s|passing_half_s|wear_factor|band_rpm|clearance.*)",
        BOUNCES,
    ),
    (r"check examples/two-piece-rubber-bearing", r"(verdicts|limits)\.(limit|utilisation|value)", BOUNCES),
    (
        r"strength examples/(double-cardan-propshaft|propshaft-with-rzeppa|front-halfshaft|tracta-steered-axle)",
        r"dynamic_factor",
        KINDS,
    ),
    (
        r"strength \S+ --size joint --torque-Nm",
        r"((limits|limits_as_made)\.(limit|utilisation|value)|tried\.passed)",
        RATED,
    ),
    (r"select examples/truck-power-unit", r"(need|sizes|types)\..*", BANDS),
    (r"select examples/", r"sizes\.life_h", LASTS),
    (r"select examples/((car|composite)-propshaft|truck-duty-cycle)", r"sizes\.(fits|headroom|reasons\..*)", LASTS),
    (r"select examples/(mill-spindle|pto-drive)", r"sizes\.reasons\.value", LASTS),
    (
        r"(check|strength) examples/(front-halfshaft|propshaft-with-rzeppa)",
        r"(verdicts|limits)\.(advice|limit|utilisation|value)",
        INSIDE,
    ),
    (r"check examples/car-propshaft", r"verdicts\.utilisation", PLANES),
    (r"balance examples/car-propshaft", r"shafts\.unbalance_g_mm", PLANES),
    (r"balance examples/two-piece-rubber-bearing", r"shafts\.allowed_plane_g_mm", PLANES),
    (
        r"forces examples/(truck-supports|two-piece-rubber-bearing)\.toml",
        r"(forces|forces_sliding_back|joints|supports)\..*",
        HALVES,
    ),
    (r"losses examples/truck-supports\.toml", r".*(heat|power|efficiency|torque|journals).*", HALVES),
    (r"rotor examples/\S+ --joint", r"orders\..*", "the angles of yokes, unbalances and cracks count beside a joint"),
    (
        r"rotor examples/double-cardan-propshaft\.toml",
        r"response\..*",
        "a shaft by itself is looked at from the slowest speed in use on",
    ),
    (r"joint$", r"kinds\.steepest_deg", "a mechanism of one's own is a kind more"),
    (r"joint$", r"kinds\.keys\..*", "a tripod has a key more, the far joint on which its shaft pivots"),
    (r"mobility examples/(truck-duty-cycle|two-piece-rubber-bearing)\.toml", r".*", HELD),
    (r"check examples/truck-duty-cycle\.toml --torque-Nm", r"(cures|remedies)\..*", TOP),
    (r"check examples/truck-printed-angles\.toml", r"(most_helpful|remedies)\.(change|value)", TEETH),
    (r"sweep examples/sweeps/tolerance-field\.toml", r"reductions\.histogram irregularity\..*", BINS),
    (r"phases examples/truck-rear-axle\.toml", r"settings\..*", MORE),
    (r"articulation examples/(pto-hitch|truck-rear-axle)\.toml", r"(joints|worst)\..*", TOPS),
    (r"check examples/(pto-hitch|truck-rear-axle)\.toml", r"verdicts\.(utilisation|value)", TOPS),
    (
        r"torsion response examples/truck-power-unit\.toml",
        r"(max_Nm|min_Nm|nonsynchronous\.torque_Nm).*",
        BANDS,
    ),
    (r"check examples/unstable-drive\.toml", r"verdicts\.(limit|utilisation|value)", GROWS),
    (r"strength examples/unstable-drive\.toml", r"(enough|limits\..*|utilisation)", GROWS),
    (r"torsion (response|stability) examples/truck-duty-cycle\.toml", r".*", HEAVIEST),
    (
        r"torsion (response|stability) examples/truck-power-unit\.toml",
        r"(growth_rate_per_s|spectral_radius|order|multipliers.*)",
        TOGETHER,
    ),
    (
        r"strength examples/truck-power-unit\.toml",
        r"((joints|limits|shafts|tried|torsional_vibration)\..*|rated_torque_Nm|torque_factor|utilisation)",
        BANDS,
    ),
    (
        r"torsion (absorber|calm) examples/truck-power-unit\.toml",
        r"(after|before|best|closed_form|curves|history_Nm|largest_\w+|modes_after|reduction|run_peaks_Nm)\b.*",
        BANDS,
    ),
    (
        r"torsion (absorber|calm) examples/truck-power-unit\.toml",
        r"(unstable_before_rpm|values|without)\b.*",
        BANDS,
    ),
    (
        r"strength examples/(cured-drive|pto-flywheel(-absorber)?|unstable-drive)\.toml",
        r"(limits\.limit_torque_Nm|rated_torque_Nm|torque_factor)",
        SOUGHT,
    ),
    (r"check examples/truck-power-unit\.toml", r"verdicts\.(utilisation|value)", BANDS),
    (r"check examples/truck-power-unit\.toml --torque-Nm", r"verdicts\.(advice|limit)", TURNED),
    (
        r"torsion modes examples/truck-power-unit\.toml",
        r"crossings\..*",
        "side bands of the engine's order are among them",
    ),
    (
        r"torsion stability examples/(pto-flywheel(-absorber)?|truck-power-unit)\.toml",
        r"(growth_rate_per_s|spectral_radius|order|multipliers.*)",
        ALIKE,
    ),
    (r"torsion road examples/pto-baler", r"mean_growth_per_s", ALIKE),
    (
        r"torsion absorber examples/(cured-drive|unstable-drive|truck-power-unit)\.toml",
        r"unstable_(before|after)_rpm",
        DRIFT,
    ),
)
"""Pattern at the start of a command line, pattern of a whole old path, why its numbers are others."""

REFUSED: tuple[tuple[str, str], ...] = (
    (r"(losses|forces) examples/truck-duty-cycle\.toml$", "parts of a duty cycle say the torque too: other keys lack"),
    (r"\S+ examples/(front-halfshaft|propshaft-with-rzeppa|double-cardan-propshaft|tracta-steered-axle)\.toml", LACKS),
)
"""Pattern of a command line that is refused for other fields than it was, and why."""
