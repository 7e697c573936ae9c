"""Reports and their groups of fields, for editors and type checkers.

Units are those of docs/reference/json.md: `length unit` is that of the spec, `coherent` the length unit for lengths, rad
for angles and the unit of the spec for parameters and inputs, and `1` none. Optional fields are None where they do not
apply.
"""

# Generated from the types of the reports and their comments: `UPDATE_EXPECT=1 cargo test -p abbe-tests json_reference`.
from __future__ import annotations

from typing import Literal

from ._abbe import Report
from ._fields import Fields, Named


class AcceptanceVerdict(Fields):
    """Acceptance verdict on rows that were not used for fitting."""

    judged: Literal["machine", "corrected", "model"]
    """Subject."""

    rows: str
    """Name of the rows, such as `the test rows`."""

    limits: list[LimitCheck]
    """Comparisons, one per limit."""

    decision: Literal["rejected", "undecided", "accepted"]
    """The worst of their outcomes."""


class AfterCompensation(Fields):
    """Published residual after compensation, combined with the computed random errors. In the length unit."""

    residual: float
    """Published residual of the repeatable errors.

    Unit: length unit.
    """

    random: float
    """Computed random radius.

    Unit: length unit.
    """

    total: float
    """Sum of both.

    Unit: length unit.
    """

    published: PublishedResidual
    """The published figures."""


class Alarm(Fields):
    """First check at which a chart exceeds its limit."""

    check: int
    """Index of the check, from 0."""

    date: str
    """Date of the check."""

    chart: str
    """Name of the chart that is farthest beyond its limit."""


class AllocateReport(Report):
    """Factors of the error sources with which the study keeps its tolerances at least cost, and with all smaller
    factors, too. Lengths are in the spec's unit, angles in rad.
    """

    __slots__ = ()

    manipulator: str
    """Name of the manipulator."""

    length: str
    """Symbol of the length unit."""

    tolerance: float | None
    """Tolerance of the position error, in the length unit; None if the study has none."""

    orientation_tolerance: float | None
    """Tolerance of the orientation error, in rad; None if the study has none."""

    configurations: int
    """Number of reached configurations, at all of which the tolerances are kept."""

    unreachable: int
    """Number of unreachable configurations."""

    sources: list[AllocatedSource]
    """Enabled sources of the spec, in its order."""

    cost: float
    """Sum of the costs of all factors that are not fixed."""

    one_factor: float
    """Factor of all these sources if they have the same one; with the root sum of squares of the others where draws
    decide.
    """

    one_factor_cost: float
    """Cost with this factor."""

    active: Named[float]
    """Configurations at which a tolerance is reached, by their differences from home, each with its multiplier λ,
    without a unit: the cost falls by λ/100 if the errors there fall by 1 %. The largest is first.
    """

    residual: float
    """Largest relative residual of the conditions for the optimum (Karush, Kuhn and Tucker), without a unit."""


class AllocatedSource(Fields):
    """Error source and its factor."""

    source: str
    """Name of the source."""

    factor: float
    """Factor of its errors."""

    fixed: bool
    """Indicates that the factor is fixed."""

    largest: float
    """Largest norm of its error without its factor, in the length unit or rad: of the position; or of the orientation
    if the study has no tolerance of the position.
    """


class Alternative(Fields):
    """Another error that explains the data as well as the named one (likelihood ratio, 95 %)."""

    number: str
    """Name: `zero of q5`, `a of shoulder`, `e_x of wrist`."""

    value: float
    """Value that replaces the named error, in `unit`."""

    standard_deviation: float
    """Standard deviation of the value, in `unit`."""

    unit: str
    """Unit: the length unit, or rad."""


class AnalyzeReport(Report):
    """Errors of the sources over a workspace. Lengths are in the spec's unit, along the axes of `F_0`; angles are in
    rad.
    """

    __slots__ = ()

    manipulator: str
    """Name of the manipulator."""

    configurations: int
    """Number of configurations that were reached and evaluated."""

    unreachable: int
    """Number of configurations that could not be reached."""

    sources: list[SourceReport]
    """Position errors of each enabled source alone."""

    combined: CombinedReport
    """Position errors of all sources together."""

    study: str
    """Title of the study."""

    workspace: str
    """Description of the workspace in a sentence."""

    length: str
    """Symbol of the length unit."""

    tolerance: float | None
    """Tolerance of the position error, from the study, in the length unit."""

    verdict: Verdicts | None
    """Verdicts on the tolerances; None if the study has none."""

    uncertainty: UncertaintyBudget | None
    """Uncertainty budget of the position after the GUM; None if no random source moves the tool point."""

    orientation: OrientationReport
    """Orientation errors."""

    published: list[Comparison]
    """Published figures compared with the computed ones."""

    after_compensation: AfterCompensation | None
    """Published residual after compensation, combined with the computed random errors."""

    first_order: FirstOrder
    """First-order error."""

    loops: LoopCondition | None
    """Condition of the loops; absent without loops."""

    certified: CertifiedNorms | None
    """Certified upper bounds on the norms; None if the workspace has no enclosing box, or too many names vary."""

    unreachable_reasons: list[UnreachableReason]
    """Reasons for unreachable configurations, most frequent first."""

    not_reproducible: list[str]
    """Published figures that cannot be reproduced, one sentence each."""

    ledger: Ledger
    """Sources by rank, and their sums."""

    factor_for_all: float | None
    """Factor for all sources at which the judged position error as built equals the tolerance; None without a
    tolerance or an error, or if a probability or yield is judged.
    """

    compensation: RemainingErrors | None
    """Errors that remain after the compensation that the study states; None if it states none."""

    monte_carlo: MonteCarloReport | None
    """Monte Carlo draws; None if they were not requested."""

    extrapolated: Extrapolation | None
    """Configurations outside the fitted ranges, and the uncertainty there; None if there are none."""

    record: Named[str] | None
    """Stated date, and the version of abbe; absent if there is no date."""


class ApproachResult(Fields):
    """Approaches of one target position in one direction. Values are in `unit`."""

    count: int
    """Number of approaches."""

    mean: float
    """Mean deviation `x̄_i↑` or `x̄_i↓`.

    Unit: `unit`.
    """

    standard_deviation: float | None
    """Standard deviation `s_i↑` or `s_i↓`; none for a single approach.

    Unit: `unit`.
    """

    repeatability: float | None
    """Repeatability `R_i↑` or `R_i↓`.

    Unit: `unit`.
    """


class Bidirectional(Fields):
    """Characteristics of both directions."""

    accuracy: Characteristic | None
    """Accuracy `A`; none if a position has a single approach."""

    systematic: Characteristic
    """Systematic positioning error `E`."""

    mean: Characteristic
    """Mean positioning error `M`."""

    repeatability: Characteristic | None
    """Repeatability `R`; none if a position has a single approach."""

    reversal: Characteristic
    """Reversal error `B`."""

    mean_reversal: Characteristic
    """Mean reversal error `B̄`."""


class BoundReport(Report):
    """Bounds on the errors over a box of configurations. Lengths are in the spec's unit, angles in rad. To first
    order in the errors of the sources, the true maximum of each error lies between `found` and `certified`.
    """

    __slots__ = ()

    manipulator: str
    """Name of the manipulator."""

    length: str
    """Symbol of the length unit."""

    gap: float
    """Requested gap: largest excess of `certified` over `found`, as a share of `found`."""

    repeatable: ErrorBounds
    """Errors of the repeatable sources, with signs."""

    random: ErrorBounds
    """Errors of the random sources together, each with any value within its bound."""

    total: ErrorBounds
    """Errors of all sources together: the worst case."""

    remainder: Remainder | None
    """First-order error of the repeatable sources; None if there are none."""

    after_one_step: StepResidual | None
    """Error of the repeatable sources after one step of compensation; None without repeatable sources, with fewer
    than three joints, or with branches or loops.
    """

    margin: Margin | None
    """Margin to the position tolerance, in the length unit; None if the study has no such tolerance."""

    orientation_margin: Margin | None
    """Margin to the orientation tolerance, in rad; None if the study has no such tolerance."""

    dexterity: Dexterity | None
    """Smallest motion of the tool per unit of joint motion; None if not requested, or with fewer than three joints."""

    stiffness: LowerBound | None
    """Smallest stiffness at the tool point in any direction, in N/m, from the enabled repeatable beams and
    compliances. None if not requested, or if nothing is compliant.
    """

    box: Named[list[float]]
    """Ranges of all moving joint variables, parameters and inputs, or of given passive variables."""

    contains_more: bool
    """Indicates that the enclosing box is larger than the workspace of the study."""

    boxes: int
    """Number of evaluated boxes, all searches together."""

    complete: bool
    """Indicates that every search reached the requested gap between its bounds."""


class Certainty(Fields):
    """Basis of the standard deviations."""

    configurations: int
    """Number of independent configurations."""

    counted: str
    """Unit of counting for degrees of freedom: `numbers` for every measured value, `points` for one point per
    configuration, or `configurations`.
    """

    freedom: float
    """Residual degrees of freedom; 0 with as many values as unknowns, which leave nothing to test."""

    coverage_freedom: float
    """Degrees of freedom of the standard deviations: those of the residuals, and 2 for the stated uncertainties."""

    factor_95: float
    """Coverage factor for 95 %, from Student's t."""

    p_of_factor: float
    """Probability of an uncertainty factor at least as far from 1 by chance."""


class CertifiedNorms(Fields):
    """Largest norms ‖ΔX‖ of the position errors over the enclosing box of a workspace, in the length unit. The true
    maximum lies between `found` and `certified`.
    """

    repeatable: ErrorBound | None
    """Norm of the sum of the repeatable sources, with signs; None if there are none."""

    random: ErrorBound | None
    """Norm of the sum of the random sources with any values within their bounds; None if there are none."""

    total: ErrorBound | None
    """Norm of the sum of all sources; None unless there are sources of both classes."""

    contains_more: bool
    """Indicates that the enclosing box is larger than the workspace."""


class Chain(Fields):
    """Matrices `A_1 … A_n`, the tool and the tool's pose at home, with nominal parameters."""

    frames: list[Link]
    """Frames, base to tip."""

    tool: list[list[float]]
    """Tool `T`, from the frame that carries it, `F_n` in a chain, to the tool point, a homogeneous matrix, row by
    row.
    """

    pose: list[list[float]]
    """Pose of the tool in `F_0`, a homogeneous matrix, row by row."""


class Change(Fields):
    """Single difference. Joints are indexed from 0 in the order of the spec. Columns are reordered first, then signs,
    couplings and zeros are applied.
    """

    order: list[int] | None = None
    """Different order of the columns: joint `i` is in column `order[i]`."""

    reversed: list[int] | None = None
    """Opposite sign of these joints."""

    coupled: ChangeCoupled | None = None
    """Column relative to another joint: `by` times that joint must be added."""

    zero: ChangeZero | None = None
    """Offset of a joint's zero, in rad or in the spec's length unit."""


class ChangeCoupled(Fields):
    """Column relative to another joint: `by` times that joint must be added."""

    joint: int
    """Joint of the column."""

    to: int
    """Joint to add."""

    by: float
    """Factor, 1 or −1."""


class ChangeZero(Fields):
    """Offset of a joint's zero, in rad or in the spec's length unit."""

    joint: int
    """Joint with the offset."""

    offset: float
    """Value to add.

    Unit: length unit or rad.
    """


class Characteristic(Fields):
    """Value of a characteristic, in `unit`."""

    value: float
    """Value.

    Unit: `unit`.
    """

    uncertainty: float | None
    """Expanded uncertainty, k = 2, from that of the instrument; none if that is not stated.

    Unit: `unit`.
    """


class Chart(Fields):
    """Control chart of one error, or of the residual."""

    name: str
    """Name of the error, or `what is left` for the residual."""

    unit: str
    """Unit of the values; empty for the residual."""

    indistinguishable: list[str]
    """Errors that are indistinguishable from this one at the monitored configurations."""

    values: list[float]
    """Value at every check: the error under the assumption that all others are unchanged, in `unit`; for the
    residual, the root mean square of its deviation from the checks before, in units of the instrument's
    uncertainty.
    """

    average: list[float]
    """EWMA at every check, as a share of the limit. An alarm is a value beyond ±1. None for the residual."""

    single: list[float]
    """Deviation of every check from those before it, as a share of the limit. An alarm is a value beyond ±1."""

    alarm: int | None
    """Index of the first check beyond a limit, from 0."""


class ChartsLimit(Fields):
    """Control limits.

    `["lambda"]`: Weight of a new check in an average, a factor from 0 to 1.
    """

    checks_per_false_alarm: float
    """Smallest mean number of checks between false alarms, over all charts together."""

    limit: float
    """Limit as a factor of the standard deviation of an average."""

    chance: float
    """Probability with which one chart sets a single check apart by chance."""


class CheckReport(Report):
    """Content of a spec, its chain at home, and the results of the self-checks."""

    __slots__ = ()

    name: str
    """Name of the manipulator."""

    title: str
    """Title of the manipulator."""

    spec: str
    """Path of the spec, or name of a shipped manipulator."""

    length: str
    """Symbol of the length unit."""

    orientation: str
    """Convention of rows 4–6: `rotation-vector`, `euler-yzx` or `iec-61217`."""

    frames: list[Frame]
    """Frames, base to tip."""

    variables: list[Variable]
    """Joint variables, in the order of the frames."""

    limits: list[Limit] | None
    """Limits of sums of joint variables; absent without any."""

    parameters: list[NominalValue]
    """Structural parameters."""

    inputs: list[NominalValue]
    """Inputs."""

    sources: list[Source]
    """Error sources, disabled ones included."""

    operations: list[FunctionOperations]
    """Operation counts of the generated functions."""

    iso_axes: list[IsoAxis] | None
    """Names of ISO 230-1 of the errors of each axis, of a machine with slides along X, Y and Z."""

    tree: Tree | None
    """Freedoms and loops; absent if the frames are a chain."""

    home: Chain | None
    """Nominal chain at home; None if its pose is not finite."""

    warnings: list[Warning]
    """Suspicious numbers in the spec."""

    notes: list[str]
    """Properties of the spec that are easily misunderstood, one sentence each."""

    identifiable: list[Identifiable]
    """Identifiability from poses, then from tool points; each with a known and an unknown base frame. Empty if loops
    do not close at home.
    """

    configurations: int
    """Number of configurations at which the laws were checked."""

    laws: list[Law]
    """Results of the self-checks, one per law; empty if loops do not close at home."""


class CircularPath(Fields):
    """Results of one direction. Values are in um, about the centre of the least-squares circle."""

    center: list[float]
    """Coordinates x and y of the centre, in `unit`."""

    circularity: Characteristic
    """Circular deviation `G`, the synchronous error motion of an axis of rotation."""

    largest: Characteristic
    """Largest radial deviation `F_max`."""

    smallest: Characteristic
    """Smallest radial deviation `F_min`."""

    asynchronous: float | None
    """Asynchronous error motion, in `unit`: the largest range of readings at one angle; none unless each has several."""

    total: float | None
    """Total error motion, in `unit`: the range of all readings; none unless each angle has several."""


class CircularResult(Fields):
    """Results of a circular test. Values are in um."""

    forward: CircularPath | None
    """Path in the direction of rising angles, counterclockwise; none without its readings."""

    reverse: CircularPath | None
    """Path clockwise."""

    circularity: Characteristic | None
    """Bidirectional circular deviation `G(b)`; none unless there are both directions."""

    hysteresis: Characteristic | None
    """Circular hysteresis `H`; none unless every angle has both directions."""

    mean: Characteristic | None
    """Mean bidirectional radial deviation `D`."""


class CombinedReport(Fields):
    """Combined position errors over the workspace, along x, y, z of `F_0`, in the length unit."""

    repeatable_radius: float
    """Norm of the sum of the repeatable sources.

    Unit: length unit.
    """

    random_radius: float
    """Norm of the root sum of squares of the random sources at their bounds.

    Unit: length unit.
    """

    radius: float
    """Sum of both norms at one configuration.

    Unit: length unit.
    """

    repeatable: list[float]
    """Absolute value of the sum of the repeatable sources, row by row.

    Unit: length unit.
    """

    random: list[float]
    """Root sum of squares of the random sources, row by row.

    Unit: length unit.
    """

    worst: Named[float]
    """Configuration with the largest radius: joint variables and varying inputs."""

    worst_parameters: Named[float]
    """Parameters of that configuration that vary over the workspace."""

    rms: RootMeanSquares
    """Root mean squares of the norms over the configurations."""

    standard_deviation: list[float]
    """Largest standard deviations along x, y, z.

    Unit: length unit.
    """

    standard_radius: float
    """Largest standard deviation of the position, √(trace of the covariance).

    Unit: length unit.
    """

    worst_case: list[float]
    """Largest errors along x, y, z over all signs: repeatable sources at their values, the others at their bounds.

    Unit: length unit.
    """

    worst_case_radius: float
    """Largest norm over all signs.

    Unit: length unit.
    """

    ellipsoid: LongestEllipsoid
    """Longest of the 95 % ellipsoids."""


class Compared(Fields):
    """Position errors of a set of rows."""

    rows: int
    """Number of rows."""

    configurations: int
    """Number of independent configurations among them."""

    before: Sizes
    """Errors as delivered: with the sources of the spec."""

    base_and_tool: Sizes
    """Errors with base and tool fitted."""

    constant: Sizes | None
    """Errors with constants alone, if the model has richer terms or profiles."""

    after: Sizes
    """Errors with the identified model."""

    gain: Gain
    """Improvement of the identified model over base and tool alone."""

    gain_of_terms: Gain | None
    """Improvement of the identified model over constants alone, if it has richer terms or profiles."""


class Comparison(Fields):
    """A published figure, of one source in one metric or of all sources together."""

    figure: str
    """Name of the source, or `combined`."""

    metric: str
    """Name of the metric, or of the combined figure."""

    x: float | None
    """Published values for x, y, z and norm, in the length unit; None where nothing is printed."""

    y: float | None
    """Published values for x, y, z and norm, in the length unit; None where nothing is printed."""

    z: float | None
    """Published values for x, y, z and norm, in the length unit; None where nothing is printed."""

    norm: float | None
    """Published values for x, y, z and norm, in the length unit; None where nothing is printed."""

    within: float
    """Largest difference that counts as agreement, in the length unit: half a unit of the last printed digit."""

    met: bool
    """True if the computed figure agrees."""

    reference: str
    """Table or page where it is printed."""


class CompensatedVerdicts(Fields):
    """Verdicts on the compensated machine."""

    basis: Literal["stated", "identified", "published"]
    """Origin of what is known of the errors after compensation."""

    checked: int
    """Number of configurations at which the compensated errors were evaluated."""

    position: ToleranceVerdict | None = None
    """Verdict on the position error; None without a position tolerance."""

    orientation: ToleranceVerdict | None = None
    """Verdict on the orientation error; None without an orientation tolerance."""

    yield_estimate: Yield | None = None
    """Share of machines that keep all tolerances at all configurations, if that is the criterion."""


class Compliance(Fields):
    """Probability that the norm of the error is within a limit at one configuration, to first order: the repeatable
    sources are fixed, the random ones vary.
    """

    probability: float
    """Probability."""

    error: float
    """Error of the probability: a bound for an integral, the standard error `√(p (1 − p)/N)` for draws."""

    draws: int | None
    """Number of draws. None for an integral."""


class Counts(Fields):
    """Number of identifiable errors of base and frames, out of how many."""

    rank: int
    """Number of identifiable combinations."""

    unknowns: int
    """Number of unknown errors."""

    base: bool
    """Is true if the errors of the base are among the unknowns."""


class CrossValidation(Fields):
    """Position errors of k-fold cross-validation."""

    folds: int
    """Number of parts."""

    configurations: int
    """Number of independent configurations distributed over the parts."""

    constant: Sizes | None
    """Errors with constants alone, if richer terms were tried."""

    after: Sizes
    """Errors with the complete model."""

    gain: Gain | None
    """Improvement by the richer terms over constants alone, if they were tried."""


class DeadPoint(Fields):
    """Configuration beyond which the loops do not close in the mode of home: passive joints lose their drive there.
    One commanded joint has moved from home.
    """

    joint: str
    """Name of the joint that reaches it."""

    value: float
    """Value of the joint there, in the length unit or rad."""

    distance: float
    """Distance of the joint from home, in the length unit or rad."""


class Dexterity(Fields):
    """Smallest singular value of the joint Jacobian `J_q`, in metres and radians: the smallest motion of the tool for
    a joint motion of root sum of squares 1. It is 0 at a singularity.
    """

    point: LowerBound
    """Dexterity of the tool point, rows 1–3."""

    pose: LowerBound | None
    """Dexterity of the tool, all rows with 1 rad counted as 1 m; None with fewer than six joints."""


class Dh(Fields):
    """Denavit-Hartenberg parameters: lengths in the spec's unit, angles in rad."""

    convention: str
    """Convention, `standard` for `Rz(theta) Tz(d) Tx(a) Rx(alpha)`, `modified` for `Rx(alpha) Tx(a) Rz(theta) Tz(d)`."""

    theta: float
    """Rotation about z.

    Unit: length unit or rad.
    """

    d: float
    """Translation along z.

    Unit: length unit or rad.
    """

    a: float
    """Translation along x.

    Unit: length unit or rad.
    """

    alpha: float
    """Rotation about x.

    Unit: length unit or rad.
    """


class DiagonalResult(Fields):
    """Largest characteristics of all body diagonals."""

    systematic: Characteristic | None
    """Diagonal systematic deviation of positioning `E_d`: the largest `E`; none unless all diagonals have both
    directions.
    """

    reversal: Characteristic | None
    """Diagonal reversal error `B_d`: the largest `B`."""


class Directions(Fields):
    """Configurations that were approached from several directions."""

    configurations: int
    """Number of configurations."""

    fewest: int
    """Smallest number of directions; the standard requires three."""

    fewest_visits: int
    """Smallest number of visits from a direction; the standard requires 30."""

    vap: MeanAndMax
    """`vAP_p`."""

    vap_turns: list[MeanAndMax] | None
    """`vAP_a`, `vAP_b`, `vAP_c`: rad."""


class Distances(Fields):
    """Pairs of configurations with equal numbers of visits."""

    pairs: int
    """Number of pairs."""

    ad: MeanAndMax
    """Absolute value of `AD_p`."""

    ad_turns: list[MeanAndMax] | None
    """Absolute values of `AD_a`, `AD_b`, `AD_c`, in rad."""

    rd: MeanAndMax
    """`RD_p`."""

    rd_turns: list[MeanAndMax] | None
    """`RD_a`, `RD_b`, `RD_c`, in rad."""


class DoctorReport(Report):
    """Units, order and format with which the numbers of a file agree with the spec."""

    __slots__ = ()

    name: str
    """Name of the machine."""

    length: str
    """Symbol of the length unit."""

    rows: int
    """Number of rows that were used."""

    joints: list[str]
    """Names of the columns read as joints."""

    seen: list[str]
    """Names of the columns read as measured values."""

    fits: bool
    """Indicates that at least one interpretation fits."""

    within: float
    """Largest combined residual at which an interpretation fits, in the spec's length unit."""

    found: list[Finding]
    """Interpretations that fit and that the data cannot distinguish, simplest first."""

    simpler: Finding | None
    """Simplification of the first interpretation that is also within the tolerance, but fits significantly worse."""

    others: list[Finding]
    """Best of the interpretations that do not fit."""

    still: list[str]
    """Names of the joints that do not move in these rows."""

    moved: list[str]
    """Names of the joints that move in these rows."""

    map: str | None
    """Map of the first interpretation; None if no interpretation fits."""

    of_spec: list[str]
    """Corrections that the map cannot express and that belong in the spec or the file, one sentence each."""


class Drift(Fields):
    """Configurations with at least twenty visits."""

    configurations: int
    """Number of configurations."""

    most: int
    """Largest number of groups of one configuration."""

    dap: MeanAndMax
    """`dAP_p`."""

    dap_turns: list[MeanAndMax] | None
    """`dAP_a`, `dAP_b`, `dAP_c`, in rad."""

    drp: MeanAndMax
    """`dRP_l`."""

    drp_turns: list[MeanAndMax] | None
    """`dRP_a`, `dRP_b`, `dRP_c`, in rad."""


class ErrorBound(Fields):
    """Bounds on the largest magnitude of an error over the box, in the length unit or rad."""

    found: float
    """Lower bound: the value at the configuration `at`.

    Unit: length unit or rad.
    """

    certified: float | None
    """Certified upper bound; None if nothing could be proved.

    Unit: length unit or rad.
    """

    at: Named[float]
    """Configuration of `found`: values of all joint variables, and of the parameters and inputs that move."""

    boxes: int
    """Number of evaluated boxes."""

    complete: bool
    """Indicates that the gap was reached."""


class ErrorBounds(Fields):
    """Bounds on one kind of error."""

    norm: ErrorBound
    """Norm ‖ΔX‖ of the position error, in the length unit."""

    x: ErrorBound
    """Absolute position error along x of `F_0`."""

    y: ErrorBound
    """Absolute position error along y of `F_0`."""

    z: ErrorBound
    """Absolute position error along z of `F_0`."""

    orientation: ErrorBound
    """Norm of rows 4–6, in rad."""


class Exceedance(Fields):
    """Predicted time at which a drift exceeds the tolerance."""

    time: float
    """Time, as counted by the calendar of the checks."""

    date: str
    """Date of that time."""

    standard_deviation: float
    """Standard deviation, as counted by the calendar of the checks."""


class Explained(Fields):
    """Agreement of measurement and prediction. Lengths are in the length unit."""

    left_mean: float
    """Mean norm of the errors minus the repeatable sources, over all measured points.

    Unit: length unit.
    """

    left_rms: float
    """Root mean square of these norms.

    Unit: length unit.
    """

    left_p95: float
    """95th percentile of these norms.

    Unit: length unit.
    """

    left_max: float
    """Maximum of these norms.

    Unit: length unit.
    """

    share: float
    """Share of the sum of squares explained by the repeatable sources; negative if they increase it."""

    inside: float | None
    """Share of the rows within the 95 % prediction region of the spec: random sources drawn anew in each row, and the
    noise of the instrument.

    None for readings, or if the map states no uncertainty.
    """

    likely: list[float] | None
    """99 % interval of that share of the points for a machine as specified, with as many rows."""

    repeatable: int
    """Number of repeatable sources."""

    random: int
    """Number of random sources."""


class ExportReport(Report):
    """Files in another format, and the differences between poses with and without them."""

    __slots__ = ()

    name: str
    """Name of the machine."""

    format: str
    """Name of the format and its variant."""

    length: str
    """Unit of length of the differences."""

    files: list[ExportedFile]
    """The file, or several files that belong together."""

    changes: list[str]
    """Changes in a file that was given, as hunks of a diff."""

    left_out: list[str]
    """Sentences about the errors that the format cannot hold."""

    compared: list[str]
    """Names of the differences `before` and `remains`."""

    before: PoseDifference
    """Difference without the files."""

    at_nodes: PoseDifference | None
    """Difference with the files at the nodes of a table; `remains` is between the nodes."""

    remains: PoseDifference
    """Difference with the files."""

    placed: PoseDifference | None
    """Difference with the files and with rotary axes of the workpiece placed in the control; None without such axes."""

    turned: list[RotaryAxis]
    """Rotary axes of the workpiece."""

    configurations: int
    """Number of random configurations of the differences."""

    seed: int
    """Seed of the configurations."""

    sign: str
    """Sentence that explains the sign by a number of this machine."""


class ExportedFile(Fields):
    """Text of one file."""

    name: str
    """File name without a folder."""

    text: str
    """Complete text."""


class Extrapolation(Fields):
    """Configurations outside the ranges on which the errors of a spec were fitted."""

    count: int
    """Number of configurations outside the ranges."""

    all: int
    """Number of all configurations."""

    standard_deviation: ToolPointDeviation | None
    """Standard deviation of the tool point; None if the spec states no covariance."""


class Figure(Fields):
    """Statistics of a difference, in the length unit or rad."""

    largest: float
    """Largest value.

    Unit: length unit or rad.
    """

    rms: float
    """Root mean square.

    Unit: length unit or rad.
    """


class Figures(Fields):
    """Figure per axis, and of the norm: positions along the axes of `F_0` in the length unit, or orientations (rows
    4–6) in rad.
    """

    x: float
    """Figure along x.

    Unit: length unit or rad.
    """

    y: float
    """Figure along y.

    Unit: length unit or rad.
    """

    z: float
    """Figure along z.

    Unit: length unit or rad.
    """

    norm: float
    """Norm.

    Unit: length unit or rad.
    """


class Finding(Fields):
    """An interpretation and its residual."""

    interpretation: Interpretation
    """The interpretation."""

    words: str
    """Description of the interpretation."""

    residual: float
    """Root mean square residual of the positions, in the spec's length unit."""

    angle: float | None
    """Root mean square residual of the orientations, in rad; None if the data have no orientations."""

    spread: float
    """Root mean square distance of the positions from their mean, as this interpretation reads them, in the spec's
    length unit.
    """

    both: float
    """Combined root mean square residual, in the spec's length unit, which is compared with `within`. Angles are
    multiplied by a lever of 0.3 × the spread of the positions. Corrected for the degrees of freedom that fitted
    numbers take.
    """


class FirstOrder(Fields):
    """Largest distance between first order and the exact chain, over at most 2000 configurations spread evenly over
    the workspace.

    Compares all sources: the random ones at their bounds, each with the sign with which it adds to those before
    it.
    """

    configurations: int
    """Number of configurations that were compared."""

    largest_difference: float
    """Largest difference in the tool point's position, in the length unit."""


class FoundInstrument(Fields):
    """Identified fixture and zero of an instrument."""

    name: str
    """Name of the instrument."""

    position: list[float] | None
    """Position of its fixture in `F_0`, in the length unit; none if the fixture is a direction, or if there is none."""

    direction: list[float] | None
    """Unit vector of its direction in `F_0`; none if the fixture is a point, or if there is none."""

    zero: float | None
    """Offset of its readings, in the length unit or rad; for a sphere, minus its radius. None if it was known."""

    intrinsics: list[float] | None = None
    """Fitted intrinsic parameters `fx fy cx cy k1 k2 p1 p2 k3` of a camera, in pixels and 1; none if they were known."""

    is_angle: bool
    """Is true if the readings are angles."""

    covariance: list[list[float]]
    """Covariance of x, y, z of the position or of the two tilts of the direction, followed by the zero, or of the
    intrinsic parameters, in products of the units.
    """


class FoundPlacement(Fields):
    """Identified placement of stations, tool and instruments."""

    stations: list[FoundStation]
    """Poses of the machine, one per station."""

    targets: list[list[float]]
    """Positions of the targets in the tool frame, in the length unit; empty if whole poses were measured, or if each
    station has its own.
    """

    mounting: list[list[float]] | None
    """Pose of the measured frame in the tool frame, as rows of a homogeneous matrix; none if points were measured, or
    if each station has its own.
    """

    at_stations: list[PlacementAtStation] | None = None
    """Placements on the tool if each station has its own; absent otherwise."""

    instruments: list[FoundInstrument]
    """Fixtures and zeros of the instruments."""

    covariance: list[list[float]]
    """Covariance of all coordinates of the targets, target by target, or of the six errors of the mounting, in
    products of the units; empty if each station has its own.
    """


class FoundStation(Fields):
    """Identified station."""

    name: str
    """Name; empty for the only station."""

    pose: list[list[float]]
    """Pose of `F_0` in the frame of the instrument, as rows of a homogeneous matrix."""

    covariance: list[list[float]]
    """Covariance of its six errors `e_x e_y e_z e_s e_r e_p` in the axes of `F_0`, in the length unit and rad."""


class Frame(Fields):
    """Frame of the chain."""

    name: str
    """Name of the frame."""

    variable: str | None
    """Name of its joint variable; None for a frame without a drive."""

    passive: str | None = None
    """Name of its passive variable; absent if it has none."""

    parent: str | None = None
    """Name of the frame that it hangs on, `base` for `F_0`; absent if all frames are a chain."""


class Free(Fields):
    """Direction in which passive variables can move by themselves."""

    passive: list[str]
    """Names of the passive variables that move."""

    motion: list[float]
    """Motion of each, relative to the fastest, without a unit: lengths relative to those of the loops."""

    loops: list[str]
    """Names of the loops whose equations depend on each other."""


class FunctionOperations(Fields):
    """Operation counts of one generated function."""

    function: str
    """Name of the function."""

    mul: int
    """Multiplications."""

    add: int
    """Additions and subtractions."""

    neg: int
    """Negations."""

    div: int
    """Divisions."""

    sincos: int
    """Sines, cosines, or both of one angle together."""

    sqrt: int
    """Square roots."""

    other: int
    """Other functions."""


class Gain(Fields):
    """Difference between the position errors of two models at the same points."""

    mean: float
    """Mean reduction of the error, in the length unit; negative if the second model is worse."""

    standard_error: float | None
    """Standard error of the mean, in the length unit, with configurations as independent samples; none for a single
    configuration.
    """

    p: float
    """Probability of a mean at least as far from 0 by chance if both models are equally good: paired t-test."""


class Home(Fields):
    """Loops at home."""

    state: Literal["closed", "open", "far", "singular"]
    """State of the loops."""

    condition: float | None
    """Condition number of φ_p in the 2-norm, with lengths relative to those of the loops; null if it is not finite."""

    smallest_singular: float | None
    """Smallest singular value of φ_p, without a unit; null if it is not finite."""

    dead_point: DeadPoint | None = None
    """Nearest dead point that one joint reaches alone from home; absent if there is none within the limits of the
    joints, or unless closed.
    """

    modes: list[LoopModes] | None = None
    """Assembly modes of the loops, where these do not depend on each other one by one; empty unless closed."""

    free: list[Free] | None = None
    """Directions in which the passive variables can move by themselves; empty unless singular."""


class Identifiable(Fields):
    """Identifiability for one kind of measurement."""

    measurement: str
    """Kind of measurement: `pose` or `point`."""

    base: bool
    """Indicates that the six errors of an unknown base frame count as unknowns."""

    rank: int | None
    """Number of identifiable combinations of errors: the rank of the observation matrix. None if a sample could not
    be evaluated.
    """

    unknowns: int
    """Number of unknown errors."""


class IdentifyReport(Report):
    """Identified errors, their uncertainty, and the accuracy of the identified machine."""

    __slots__ = ()

    name: str
    """Name of the machine."""

    length: str
    """Length unit of all values."""

    title: str
    """Title of the map."""

    rank: int
    """Number of combinations of unknowns that the data determine."""

    unknowns: int
    """Number of unknowns."""

    machine: Counts
    """Number of identifiable errors of base and frames alone, without targets on the tool."""

    gap: float | None
    """Ratio of the smallest significant singular value to the largest insignificant one; none if all are significant."""

    condition: float | None
    """Condition number of the kept columns of the design matrix, each scaled to unit length."""

    groups: list[Indistinguishable]
    """Combinations of unknowns that cannot be distinguished, with the reason."""

    unexplained: int
    """Number of undetermined combinations that `groups` and `weakly_determined` do not explain; normally 0."""

    parameters: list[Parameter]
    """Kept unknowns, which stand for the identifiable combinations."""

    joint_errors: list[JointError]
    """Significant errors expressed as errors of joint zeros, parameters and Denavit-Hartenberg numbers."""

    target_on_axis: str | None
    """Last revolute joint, if all targets are on its axis; some errors cannot be distinguished then."""

    prior: float | None
    """Prior standard deviation of errors of frames, as a share of the size of the machine, and in rad; None if it is
    that of the spec, or if they are not fitted.
    """

    weakly_determined: list[WeaklyDetermined]
    """Errors that these data determine poorly compared with their prior."""

    magnitudes: list[Magnitude]
    """Magnitudes of sources of the spec that were unknown."""

    redundant: list[Redundant]
    """Unknowns that act as others in every configuration, which stand for them."""

    correlations: list[Pair]
    """Pairs of parameters with an absolute correlation above 0.9."""

    uncertainty_factor: float
    """Factor of the stated uncertainty that explains the residuals."""

    certainty: Certainty
    """Basis of all standard deviations."""

    instruments: list[InstrumentFit]
    """Instruments that are read one by one, with statistics of their residuals."""

    known_distances: list[KnownDistanceFit] | None
    """Known distances between instruments, with their residuals; absent if there are none."""

    coordinates: list[InstrumentFit]
    """Positions and rotations, with statistics of their residuals, where poses are measured or their uncertainty was
    estimated from the data; otherwise empty.
    """

    base: list[list[float]]
    """Initial pose of `F_0` in the frame of the instrument at the first station, without identified errors of the
    base, as rows of a homogeneous matrix.
    """

    placed: FoundPlacement
    """Identified placement of the machine and of what is mounted on its tool."""

    fit: Compared
    """Position errors of the fitted rows, without outliers."""

    test: Compared | None
    """Position errors of the test rows."""

    test_rows_of_the_fit: int
    """Number of test rows that are identical to fitted rows. They cannot assess the fit."""

    extrapolated: TestExtrapolation | None
    """Test rows outside the fitted ranges of joints and inputs; none if there are no such rows."""

    cross_validation: CrossValidation
    """Position errors of cross-validation."""

    accepted: AcceptanceVerdict | None
    """Verdict on the declared limits, if there are any."""

    terms: list[TermGain]
    """Richer terms that were accepted, in the order of acceptance."""

    tried: int
    """Number of groups of terms that were tried."""

    families: str
    """Families that have them, by their names in `--terms`."""

    profiles: JointProfiles | None
    """Profiles of joints; none if they were not tried, or do not reduce the cross-validation error significantly."""

    drift: ResidualDrift | None
    """Drift of the residuals with the row order; none if there are too few rows for the test, or where a place moved
    between two rows.
    """

    unusable: list[LeftOut]
    """Rows that cannot be used."""

    rejected: list[int]
    """Lines rejected as outliers by a robust loss."""

    notes: list[str]
    """Notes for the user."""

    record: Named[str] | None
    """Stated date, persons and instruments, and the version of abbe; absent if nothing is stated."""


class ImportReport(Report):
    """Spec of an imported robot."""

    __slots__ = ()

    manipulator: str
    """Name of the manipulator."""

    length: str
    """Unit of lengths."""

    base: str
    """Link that is `F_0`, or `F_0`."""

    tip: str
    """Link whose frame is the tool point, or the last frame."""

    frames: list[ImportedFrame]
    """Frames from base to tip."""

    loads: int
    """Number of masses that became loads."""

    largest_difference: float
    """Largest difference of an entry of `A_T` between the file and the spec, in the unit of length of the spec and
    rad.
    """

    configurations: int
    """Number of configurations that were compared."""

    spec: str
    """Text of the spec."""


class ImportedFrame(Fields):
    """Frame of an imported spec."""

    joint: str
    """Name of the frame, which is that of its joint."""

    link: str | None
    """Link that the frame belongs to; tables of numbers have none."""

    variable: str | None
    """Variable that moves the frame; None for a fixed one."""

    follows: bool
    """The variable belongs to another joint."""


class Indistinguishable(Fields):
    """Combination of unknowns that is equivalent to another, or that has no effect on the measurement."""

    these: list[list[str | float]]
    """Combination: names and factors."""

    act_as: list[list[str | float]]
    """Equivalent combination; empty if these unknowns have no effect on the measurement."""

    reason: Literal["unknown_mounting", "single_target", "unknown_placement"] | IndistinguishableReason
    """Reason."""


class IndistinguishableReason(Fields):
    """Reason why errors cannot be distinguished."""

    revolute: str | None = None
    """Errors about and along the axis of this revolute joint act as those of the next frame."""

    prismatic: str | None = None
    """Translations, and rotations about the axis of this prismatic joint, act as those of the next frame."""

    not_moved: str | None = None
    """This joint does not move in these data."""

    fixed: IndistinguishableReasonFixed | None = None
    """No joint moves this frame relative to the previous one."""


class IndistinguishableReasonFixed(Fields):
    """No joint moves this frame relative to the previous one."""

    frame: int
    """Number of the frame, from 1."""

    name: str
    """Name of the frame."""


class Input(Fields):
    """Range of an input over the rows of a plan."""

    name: str
    """Name of the input."""

    unit: str
    """Coherent unit; empty for a pure number or an angle."""

    between: list[float]
    """Smallest and largest value, in `unit`; equal for a constant input."""


class InstrumentErrors(Fields):
    """An instrument, and its readings minus prediction."""

    name: str
    """Name in the map."""

    unit: str
    """Unit of the figures, that of its column."""

    count: int
    """Number of readings."""

    configurations: int
    """Number of independent configurations."""

    uncertainty: float | None
    """Stated standard deviation of a reading, in `unit`; none if it was estimated from the data."""

    ideal: ReadingErrors
    """Reading minus the ideal machine."""

    left: ReadingErrors
    """Reading minus the machine with the repeatable sources of the spec."""


class InstrumentFit(Fields):
    """Instrument, or positions or rotations, and its residuals."""

    name: str
    """Name in the map, `positions` or `rotations`."""

    numbers: int
    """Number of values that it measured."""

    freedom: float
    """Degrees of freedom of its residuals."""

    uncertainty: float
    """Standard deviation used in the fit, in `unit`."""

    unit: str
    """Unit: the length unit, rad or px."""

    estimated: bool
    """Is true if the uncertainty was estimated from these data."""

    factor: float
    """Factor of the uncertainty that explains its residuals."""


class Interpretation(Fields):
    """Units, format and differences from the spec with which the numbers of a file are read."""

    joints_in_degrees: bool | None
    """Is true if revolute joints are in degrees, false for radians; none if there are no revolute joints."""

    slides_in: str | None
    """Unit of prismatic joints; none if there are none."""

    lengths_in: str
    """Unit of positions."""

    layout: Literal["position"] | PoseFormat
    """Format of the poses."""

    changes: list[Literal["convention", "tool_inverted", "tool_left_out", "base_inverted", "base_left_out", "ends_exchanged", "pose_inverted", "base_elsewhere", "tool_elsewhere", "mirrored", "orientation_inverted"] | Change]
    """Differences from the spec."""


class IsoAxis(Fields):
    """Axis of a machine tool, and the names of its errors."""

    frame: int
    """Frame of the axis, from 1."""

    name: str
    """Name of the frame."""

    letter: str
    """Letter of the axis."""

    carries_workpiece: bool
    """The axis carries the workpiece: the errors of the frame have the opposite sign of those that ISO 230-1 names."""

    errors: list[str]
    """Names of `e_x e_y e_z e_s e_r e_p`, with a minus sign on the side of the workpiece."""


class JointError(Fields):
    """Identified error of a number of the chain."""

    in_place_of: str
    """Error of a frame that it replaces, such as `e_r1`."""

    number: str
    """Name of the number: `zero of q2`, `reach`, `a of shoulder`."""

    value: float
    """Actual minus nominal value, in `unit`."""

    standard_deviation: float
    """Standard deviation of the value, in `unit`."""

    unit: str
    """Unit: the length unit, or rad."""

    alternatives: list[Alternative]
    """Other errors that explain the data as well in place of this one."""


class JointProfile(Fields):
    """Profile of a joint."""

    joint: str
    """Name of the joint."""

    unit: str
    """Unit of the error: rad, or the length unit."""

    range: list[float]
    """Range of the joint that the profile covers, in `unit`; beyond it the value at the end holds."""

    rms: float
    """Error by the profile, root mean square over the fitted rows, in `unit`."""

    standard_deviation: float
    """Standard deviation of that error, root mean square over the fitted rows, in `unit`."""

    without: float
    """Factor of the root mean square of the cross-validation without this profile."""


class JointProfiles(Fields):
    """Profiles of joints, and the accuracy with and without them."""

    before: Sizes
    """Position errors of the cross-validation without profiles."""

    after: Sizes
    """Position errors of the cross-validation with them."""

    gain: Gain
    """Improvement by the profiles at the same held-out rows."""

    effective: float
    """Number of coefficients that the data determine, of all profiles together, without a unit."""

    standard_deviation: float
    """Standard deviation of the tool point by the profiles alone, root mean square over the fitted rows, in the
    length unit.
    """

    joints: list[JointProfile]
    """Profile of each joint that has one."""


class KnownDistanceFit(Fields):
    """Known distance between the points of two instruments, and its residual in the fit."""

    between: list[str]
    """Names of the instruments."""

    value: float
    """Stated distance, in the length unit."""

    uncertainty: float
    """Its stated standard deviation, in the length unit."""

    found: float
    """Distance of the identified points, in the length unit."""

    residual: float
    """Found minus stated distance, in units of the uncertainty."""


class Law(Fields):
    """Result of checking one law."""

    law: str
    """Statement of the law."""

    value: float | None
    """Relative discrepancy, or slope, without a unit; None if it is not finite."""

    expected: float
    """Expected value, without a unit."""

    tolerance: float
    """Permitted difference from the expected value, without a unit."""

    holds: bool
    """Indicates that the law holds within its tolerance."""

    failure: str | None = None
    """Reason of a failure: the discrepancy and its configuration, or why the law could not be evaluated."""


class Ledger(Fields):
    """Ledger of the position errors: norms in the length unit."""

    sources: list[LedgerEntry]
    """Sources, largest maximum first."""

    sums: list[LedgerEntry]
    """Sums over the sources: repeatable, random, all, worst case."""


class LedgerEntry(Fields):
    """Row of the ledger: a source, or a sum over the sources. Norms are in the length unit.

    `["class"]`: Class of the source; None for sums.
    """

    name: str
    """Name of the source or sum."""

    max: float
    """Largest norm over the workspace.

    Unit: length unit.
    """

    rms: float | None = None
    """Root mean square of the norm over the configurations; None for the worst case.

    Unit: length unit.
    """

    share_of_tolerance: float | None = None
    """Largest norm as a share of the tolerance, which the source alone would use up at one over this factor; None
    without a tolerance.
    """

    share: float | None = None
    """Share of the source in the judged error at the configuration of the verdict, of which a source that is 1 %
    smaller takes 1 % away: negative if it counteracts the others; None for sums.
    """

    factor: float | None = None
    """Factor with which, and with those of all other sources, the study keeps its tolerances; and with all smaller
    ones. None for sums, and if the study keeps them, is not judged as built by the worst case or the root sum of
    squares, or has more than 20,000 configurations.
    """

    rank: int | None = None
    """Rank of the source by its largest norm, 1 for the largest; None for sums."""


class LeftOut(Fields):
    """Row that cannot be used."""

    file: str
    """File of the row."""

    line: int
    """Line of the row in the file."""

    reason: str
    """Reason, in words."""


class Limit(Fields):
    """Limits of a sum of joint variables, in the length unit or rad."""

    sum: str
    """Sum, as the spec writes it."""

    limits: list[float]
    """Smallest and largest sum, without the constants in it.

    Unit: length unit or rad.
    """


class LimitCheck(Fields):
    """A limit compared with its figure."""

    figure: str
    """Name of the figure: `mean`, `rms`, `p95` or `max`."""

    limit: float
    """Largest permitted value, in the length unit."""

    value: float
    """Actual value, in the length unit."""

    uncertainty: float
    """Expanded uncertainty of the value, one-sided with 95 %, in the length unit; 0 where none is counted."""

    decision: Literal["rejected", "undecided", "accepted"]
    """Outcome: a value is accepted if it conforms beyond its uncertainty."""


class Link(Fields):
    """One matrix `A_i` at home."""

    name: str
    """Name of the frame."""

    dh: Dh | None = None
    """Denavit-Hartenberg parameters, if the spec states them, or a product of motions in their order."""

    matrix: list[list[float]]
    """Matrix from `F_i` coordinates to those of the frame that it hangs on, `F_{i-1}` in a chain, a homogeneous
    matrix, row by row.
    """


class LongestEllipsoid(Fields):
    """Longest of the 95 % ellipsoids of the random errors."""

    semi_axes: list[float]
    """Semi-axes, longest first, in the length unit."""

    axes: list[list[float]]
    """Directions of the semi-axes, unit vectors in `F_0`."""

    worst: Named[float]
    """Configuration with this ellipsoid."""


class Loop(Fields):
    """A loop."""

    name: str
    """Name of the loop."""

    frames: list[str]
    """Names of its two frames, `base` for `F_0`."""

    equations: int
    """Number of its equations."""

    passive: list[str]
    """Names of the passive variables that move it."""

    gap: float | None
    """Distance by which it stays open at home, in the length unit: root of the sum of squares of its equations of
    lengths; null without one.
    """

    angular_gap: float | None
    """Angle by which it stays open at home, in rad; null without equations of angles."""


class LoopCondition(Fields):
    """Condition number and singular values of `φ_p`, the derivative of the equations of the loops with respect to the
    passive variables, with lengths relative to those of the loops. It is singular where the machine can move
    although all commanded joints are held.
    """

    configurations: int
    """Number of configurations that were evaluated, spread evenly over the workspace."""

    largest: float
    """Condition number in the 2-norm, the largest of them."""

    at: str
    """Its configuration: differences from home."""

    smallest_singular: float
    """Smallest singular value of the configurations, without a unit."""

    smallest_at: str
    """Its configuration: differences from home."""

    dead_point: DeadPoint | None = None
    """Nearest dead point that one joint reaches alone from home; absent if there is none within the limits of the
    joints.
    """


class LoopModes(Fields):
    """Loops that do not depend on the passive variables of others, and their assembly modes."""

    loops: list[str]
    """Names of the loops."""

    starts: int
    """Number of random starts of the search."""

    found: list[Mode]
    """Modes that it found within the limits of the passive variables: that of the spec, then the others in the order
    of their values.
    """


class LowerBound(Fields):
    """Bounds on a smallest value over the box, in N/m for a stiffness, in metres and radians for a dexterity."""

    certified: float
    """Certified lower bound.

    Unit: N/m, or m and rad.
    """

    found: float | None
    """Upper bound: the value at the configuration `at`; None if no evaluated value was finite.

    Unit: N/m, or m and rad.
    """

    at: Named[float]
    """Configuration of `found`: values of all joint variables, and of the parameters and inputs that move."""

    boxes: int
    """Number of evaluated boxes."""

    complete: bool
    """Indicates that the gap was reached, or that `found` is nearly zero."""


class Magnitude(Fields):
    """Identified magnitude of a source of the spec."""

    source: str
    """Name of the source."""

    declared: float
    """Magnitude declared in the spec, in coherent units."""

    declared_deviation: float | None
    """Standard deviation declared in the spec, in coherent units; None if there is none."""

    value: float
    """Identified magnitude, in coherent units; the declared one if it has no effect of its own."""

    standard_deviation: float | None
    """Standard deviation of the magnitude, in coherent units; None if it has no effect of its own."""

    sum: MagnitudeSum | None
    """Sum of this magnitude and of those that act as it; None if there are none."""

    prior_dominated: bool
    """Is true if the standard deviation exceeds half of the declared one: the data contribute little."""


class MagnitudeSum(Fields):
    """Sum of magnitudes that act alike."""

    of: list[list[str | float]]
    """Names of the sources and their factors."""

    value: float
    """Identified value, in coherent units."""

    standard_deviation: float
    """Standard deviation of the value, in coherent units."""


class Margin(Fields):
    """Margin between the largest error and a tolerance, to first order, in the length unit or rad. The error is that
    of all sources in the worst case; a negative margin exceeds the tolerance.
    """

    tolerance: float
    """Tolerance: the length unit, or rad."""

    certified: float | None
    """Certified lower bound on the margin over the box; None if nothing could be proved.

    Unit: length unit or rad.
    """

    found: float
    """Smallest margin that was found, an upper bound.

    Unit: length unit or rad.
    """

    in_study: float | None
    """Smallest margin at the configurations of the study; None if none was evaluated.

    Unit: length unit or rad.
    """

    after_one_step: float | None
    """Certified lower bound on the margin after one step of compensation of the repeatable sources; None if nothing
    could be proved or nothing is compensated.

    Unit: length unit or rad.
    """


class MeanAndMax(Fields):
    """Mean and maximum over all configurations, in the length unit or rad."""

    mean: float
    """The mean.

    Unit: length unit or rad.
    """

    max: float
    """The maximum.

    Unit: length unit or rad.
    """


class MeasureReport(Report):
    """Errors of measured rows, before and after the predicted errors are subtracted."""

    __slots__ = ()

    name: str
    """Name of the machine."""

    length: str
    """Length unit of all lengths."""

    title: str
    """Title of the map."""

    rows: int
    """Number of usable rows."""

    errors: list[Size]
    """ΔX = measured − ideal: along x, y, z and its norm; for poses, also about x, y, z."""

    instruments: list[InstrumentErrors]
    """Reading minus prediction of each instrument, in its own unit."""

    explained: Explained
    """Comparison with the prediction by the sources of the spec."""

    residual_test: ResidualTest | None
    """Test of the errors minus the repeatable sources against the stated uncertainty; none if the map states none, or
    for too few rows.
    """

    repeated: Repeated
    """Characteristics of repeated visits."""

    accepted: AcceptanceVerdict | None
    """Verdict on the machine by the declared limits, if any."""

    agreed: AcceptanceVerdict | None
    """Comparison of what the repeatable sources of the spec leave with the same limits."""

    extrapolated: Extrapolation | None
    """Rows outside the fitted ranges, and the predicted uncertainty there; none if there are no such rows."""

    configurations: int
    """Number of independent configurations."""

    standard_error: float | None
    """Cluster-robust standard error of the mean norm of ΔX, in the length unit; none for a single configuration."""

    drift: ResidualDrift | None
    """Drift test of the errors minus the repeatable sources; none for too few rows, or where a place moved between
    two rows.
    """

    notes: list[str]
    """Rows that do not say what the map says of them."""

    unusable: int
    """Number of unusable rows."""

    record: Named[str] | None
    """Stated date, persons and instruments, and the version of abbe; absent if nothing is stated."""


class Mode(Fields):
    """Assembly mode at the home of the commanded joints."""

    home: Named[float]
    """Passive variables, in the length unit or rad."""

    starts: int
    """Number of starts that led to it."""

    is_chosen: bool
    """`true` for the mode of the spec."""


class MonitorFinding(Fields):
    """Change of one error that explains the measurements best."""

    name: str
    """Name of the error."""

    as_well: list[str]
    """Errors that explain the measurements equally well."""

    may_be_outside: bool
    """Is true if this error, or an equally good one, belongs to the station or to what is mounted on the tool instead
    of the machine.
    """

    kind: str
    """Kind of change: `drift`, `jump` or `excursion`, a jump that went back."""

    since: float
    """Time of the change, or of the beginning of the drift, as counted by the calendar."""

    since_date: str
    """Date of that time."""

    between: list[float | None]
    """Interval of that time with 95 % coverage, as counted by the calendar; an end is none if it lies before the
    first check.
    """

    between_dates: list[str | None]
    """Dates of the interval."""

    size: float
    """Rate per day (or check) of a drift, or height of a jump, in `unit`."""

    standard_deviation: float
    """Standard deviation of the size, in `unit`."""

    unit: str
    """Unit of the error: the length unit, or rad."""

    effect: float
    """Largest displacement of the tool point per unit of the error, in the length unit."""

    moved: float
    """Displacement of the tool point at that configuration until the last check, in the length unit."""

    until_date: str | None
    """Date at which an excursion was over."""

    farthest: float
    """Largest displacement of the tool point at that configuration at any check, in the length unit."""

    farthest_date: str
    """Date of that check."""

    leaves: Exceedance | None
    """Time at which the tolerance is exceeded, if there are a tolerance and a drift."""


class MonitorReport(Report):
    """Result of monitoring: charts, alarm and the change found."""

    __slots__ = ()

    name: str
    """Name of the machine."""

    length: str
    """Length unit of all lengths."""

    title: str
    """Title of the map."""

    calendar: Literal["dates", "days", "checks"]
    """Calendar of the times."""

    times: list[float]
    """Time of every check, as counted by the calendar."""

    dates: list[str]
    """Dates of the checks."""

    configurations: int
    """Number of configurations common to all checks."""

    left_out: int
    """Number of configurations that are not in all checks and therefore unused."""

    numbers: int
    """Number of independent values per check once the station is known."""

    fixed_station: bool
    """Is true if the instrument stays in place between checks; otherwise its pose is unknown at each check."""

    limit: ChartsLimit
    """Control limit of the charts."""

    charts: list[Chart]
    """Charts of the errors, one per group of indistinguishable errors."""

    left: Chart
    """Chart of the distance of each check from the checks before it, whatever the cause."""

    unseen: list[str]
    """Errors that are indistinguishable from a displacement of the instrument."""

    alarm: Alarm | None
    """First alarm, if there is one."""

    finding: MonitorFinding | None
    """Change found, if there is an alarm."""

    tolerance: float | None
    """Permitted displacement of the tool point, in the length unit; none if not given."""

    record: Named[str] | None
    """Stated date, persons and instruments, and the version of abbe; absent if nothing is stated."""


class MonteCarloErrors(Fields):
    """Errors drawn at one configuration."""

    at: Named[float]
    """Joint variables and varying inputs of the configuration."""

    at_parameters: Named[float]
    """Parameters of the configuration that vary over the workspace."""

    quantiles: list[Quantile]
    """The 50, 95 and 99 % quantiles of the norm of the total error."""

    largest: float
    """Largest norm of a draw.

    Unit: length unit.
    """

    mean: list[float]
    """Mean error: the repeatable sources, and second-order effects of random rotations.

    Unit: length unit.
    """

    covariance: list[list[float]]
    """Covariance of the draws, in the squared length unit."""

    covariance_standard_error: list[list[float]]
    """Standard error of each entry of the covariance, `√(Var(d_i d_j) / N)`, in the squared length unit."""

    first_order_covariance: list[list[float]]
    """Covariance to first order, `J_e Σ J_eᵀ`, in the squared length unit."""

    inside_ellipsoid: float | None = None
    """Share of the draws within the first-order 95 % ellipsoid about the error without random sources, 0.95 only for
    normal sources. None if the ellipsoid is flat.
    """


class MonteCarloReport(Fields):
    """Errors drawn at the worst configuration and at home."""

    draws: int
    """Number of draws at each configuration."""

    seed: int
    """Seed of the draws."""

    worst: MonteCarloErrors
    """Errors at the configuration with the largest radius."""

    home: MonteCarloErrors
    """Errors at home."""


class NominalValue(Fields):
    """Structural parameter or input."""

    name: str
    """Name of the parameter or input."""

    nominal: float
    """Nominal value, in `unit`."""

    unit: str
    """Coherent unit; empty for a plain number."""

    range: list[float | None] | None = None
    """Range of an input, in `unit`, with None for a missing end. Parameters have no range."""

    levels: list[float] | None = None
    """Values of an input that are used, in `unit`; absent if it may have any in its range."""


class OrientationReport(Fields):
    """Orientation errors over the workspace, in rad."""

    rows: list[str]
    """Names of rows 4–6."""

    configurations: int
    """Number of configurations at which these rows exist: all reached ones but those where Euler angles are singular."""

    sources: list[OrientationSource]
    """Errors of each source alone."""

    repeatable_radius: float
    """Norm of the sum of the repeatable sources.

    Unit: rad.
    """

    random_radius: float
    """Norm of the root sum of squares of the random sources at their bounds.

    Unit: rad.
    """

    radius: float
    """Sum of both norms at one configuration.

    Unit: rad.
    """

    repeatable: list[float]
    """Absolute value of the sum of the repeatable sources, row by row.

    Unit: rad.
    """

    random: list[float]
    """Root sum of squares of the random sources, row by row.

    Unit: rad.
    """

    worst_case_radius: float
    """Largest norm over all signs.

    Unit: rad.
    """

    standard_deviation: list[float]
    """Largest standard deviations, row by row.

    Unit: rad.
    """

    standard_radius: float
    """Largest standard deviation of the norm.

    Unit: rad.
    """

    worst: Named[float]
    """Configuration with the largest radius: joint variables and varying inputs."""

    tolerance: float | None = None
    """Tolerance of the norm, from the study.

    Unit: rad.
    """

    factor_for_all: float | None = None
    """Factor for all sources at which the judged orientation error as built equals the tolerance; None without a
    tolerance or an error, or if a probability or yield is judged.
    """

    uncertainty: UncertaintyBudget | None = None
    """Uncertainty budget after the GUM; None if no random source rotates the tool."""


class OrientationSource(Fields):
    """Orientation errors of one source alone over the workspace: rows 4–6 and their norm, in rad."""

    name: str
    """Name of the source."""

    plain_max: Figures
    """Largest absolute error. Random sources count at their bounds."""

    half_peak_to_peak: Figures
    """Half of the peak-to-peak variation; of the norm, the norm of these halves."""

    relative_to_home: Figures | None = None
    """Largest difference from the error at home; None if the rows are singular at home."""

    rms: float
    """Root mean square of the norm over the configurations.

    Unit: rad.
    """

    share: float
    """Share of the source in the judged orientation error, as in the ledger."""

    worst: Named[float]
    """Configuration with the largest norm."""


class Pair(Fields):
    """Two correlated parameters."""

    of: list[str]
    """Names of the parameters."""

    correlation: float
    """Correlation coefficient."""


class Parameter(Fields):
    """Kept unknown, which stands for an identifiable combination."""

    name: str
    """Name: `e_x1`, or `e_x0` for the base."""

    written: Written | None = None
    """Number that is written in its place, with its own value; None if it is the unknown itself."""

    kind: Literal["machine", "station", "placement"]
    """Object that the unknown belongs to."""

    frame: int | None
    """Frame of an error, from 1; 0 is the base. None for other unknowns."""

    frame_name: str | None
    """Name of that frame."""

    iso: str | None = None
    """Name of the error by ISO 230-1, of a machine with slides along X, Y and Z; with a minus sign where the frame
    has the opposite one.
    """

    value: float
    """Identified value, in `unit`."""

    standard_deviation: float
    """Standard deviation of the value, in `unit`."""

    unit: str
    """Unit: the length unit, rad, or empty."""

    prior_dominated: bool
    """Is true if the standard deviation exceeds half of the prior's: the data contribute little."""


class Passive(Fields):
    """Passive joint variable, in the length unit or rad."""

    name: str
    """Name of the variable."""

    frame: str
    """Name of the frame that it moves."""

    kind: str
    """Kind of the joint: `revolute` or `prismatic`."""

    start: float
    """Value at home in the spec, from which its value is found.

    Unit: length unit or rad.
    """

    value: float
    """Value at home for which the loops close, or for which they are nearest to closing.

    Unit: length unit or rad.
    """


class PlacementAtStation(Fields):
    """Identified placement on the tool at one station."""

    station: str
    """Name of the station."""

    targets: list[list[float]]
    """Positions of the targets in the tool frame, in the length unit; empty if whole poses were measured."""

    mounting: list[list[float]] | None
    """Pose of the measured frame in the tool frame, as rows of a homogeneous matrix; none if points were measured."""

    covariance: list[list[float]]
    """Covariance of all coordinates of the targets, target by target, or of the six errors of the mounting, in
    products of the units.
    """


class PlanReport(Report):
    """Planned measurement, and the uncertainty predicted for it."""

    __slots__ = ()

    name: str
    """Name of the machine."""

    length: str
    """Length unit of all lengths."""

    title: str
    """Title of the plan."""

    rows: int
    """Number of rows to measure."""

    sets: list[SetSize]
    """Number of rows of each set."""

    inputs: list[Input]
    """Range of each variable input over the rows."""

    rank: int
    """Rank of the identification Jacobian: the number of identifiable combinations of unknowns."""

    unknowns: int
    """Number of unknowns."""

    machine: Counts
    """Number of identifiable errors of base and frames alone, without targets on the tool."""

    weakly_determined: list[WeaklyDetermined]
    """Errors that these rows will determine poorly compared with their prior."""

    condition: float | None
    """Condition number of the kept columns of the design matrix, each scaled to unit length."""

    log_det: float
    """`ln det` of the information matrix of columns scaled to unit length."""

    exchanges: int
    """Number of exchanges of the optimization."""

    model_error: float
    """Assumed error of the identified model itself: root mean square position error in the length unit."""

    used: int
    """Number of evaluated configurations of use."""

    predicted: Predicted
    """Predicted standard deviation of the identified tool point at these configurations, with the model error, in the
    length unit.
    """

    unseen: list[UndeterminedError]
    """Errors that move the tool point at these configurations but that the rows cannot determine. `predicted`
    excludes them.
    """

    sums: list[Redundant]
    """Magnitudes that others stand for: the rows determine only their sum."""


class PoseDifference(Fields):
    """Size of the differences of many pairs of poses."""

    position: Figure
    """Distance of the tool points, in the unit of length."""

    angle: Figure
    """Angle between the orientations, in rad."""


class PoseFormat(Fields):
    """Format of a pose."""

    difference: PoseFormatDifference | None = None
    """Target position followed by a position difference."""

    euler: PoseFormatEuler | None = None
    """Position and three angles."""

    rotation_vector: PoseFormatRotationVector | None = None
    """Position and a rotation vector (axis times angle)."""

    quaternion: PoseFormatQuaternion | None = None
    """Position and a quaternion."""

    matrix: PoseFormatMatrix | None = None
    """Position and a rotation matrix."""

    homogeneous: PoseFormatHomogeneous | None = None
    """Upper three rows, or all four, of a homogeneous matrix."""


class PoseFormatDifference(Fields):
    """Target position followed by a position difference."""

    target_minus_actual: bool
    """Is true if the difference is target − actual, false for actual − target."""


class PoseFormatEuler(Fields):
    """Position and three angles."""

    axes: list[int]
    """Axes, 0 = x, in the order of the columns."""

    fixed: bool
    """Is true for fixed axes, false for moving axes: `R = R_1 R_2 R_3`."""

    degrees: bool
    """Is true if the angles are in degrees, false for radians."""


class PoseFormatHomogeneous(Fields):
    """Upper three rows, or all four, of a homogeneous matrix."""

    by_rows: bool
    """Is true for row-major order, false for column-major."""


class PoseFormatMatrix(Fields):
    """Position and a rotation matrix."""

    by_rows: bool
    """Is true for row-major order, false for column-major."""


class PoseFormatQuaternion(Fields):
    """Position and a quaternion."""

    scalar_first: bool
    """Is true if the scalar is the first component, false for the last."""


class PoseFormatRotationVector(Fields):
    """Position and a rotation vector (axis times angle)."""

    degrees: bool
    """Is true if the angle is in degrees, false for radians."""


class PositionResult(Fields):
    """Results at one target position. Deviations are in `unit`."""

    position: float
    """Target position `P_i`, in the `position_unit`."""

    forward: ApproachResult | None
    """Approaches from below, ↑; none if there are none."""

    reverse: ApproachResult | None
    """Approaches from above, ↓."""

    mean: float | None
    """Mean bidirectional deviation `x̄_i`; none unless there are both directions.

    Unit: `unit`.
    """

    reversal: float | None
    """Reversal error `B_i`.

    Unit: `unit`.
    """

    repeatability: float | None
    """Bidirectional repeatability `R_i`.

    Unit: `unit`.
    """


class PositioningLine(Fields):
    """Results of an axis or a diagonal."""

    name: str
    """Name of the diagonal; empty for an axis."""

    positions: list[PositionResult]
    """Results by position, ascending."""

    forward: Unidirectional | None
    """Characteristics of the approaches from below; none unless every position has them."""

    reverse: Unidirectional | None
    """Characteristics of the approaches from above."""

    bidirectional: Bidirectional | None
    """Characteristics of both directions."""


class PositioningReport(Report):
    """Results of one axis, or of several diagonals. Positions are in mm or deg, deviations in um or arcsec."""

    __slots__ = ()

    file: str
    """Name of the file, or of columns in memory."""

    unit: str
    """Unit of deviations and characteristics: `um` or `arcsec`."""

    position_unit: str
    """Unit of positions: `mm` or `deg`."""

    approaches: list[int]
    """Smallest and largest number of approaches of a position in one direction."""

    instrument: list[float] | None
    """Standard uncertainties of the instrument: of a reading in `unit`, of the scale in `unit` by `position_unit`;
    none if they are not stated.
    """

    lines: list[PositioningLine]
    """Results of the axis, or of each diagonal."""

    diagonals: DiagonalResult | None
    """Results of all diagonals together; none for an axis."""

    circle: CircularResult | None
    """Results of a circular test; none for positions."""

    accepted: AcceptanceVerdict | None
    """Verdict by the limits, in `unit`; none without limits."""


class Predicted(Fields):
    """Statistics of a standard deviation over the configurations of use, in the length unit."""

    mean: float
    """Mean.

    Unit: length unit.
    """

    rms: float
    """Root mean square.

    Unit: length unit.
    """

    max: float
    """Maximum.

    Unit: length unit.
    """

    p95: float
    """95 % quantile.

    Unit: length unit.
    """


class PublishedResidual(Fields):
    """Published errors after compensation, in the length unit."""

    residual: float
    """Repeatable residual after compensation.

    Unit: length unit.
    """

    random: float
    """Random errors.

    Unit: length unit.
    """

    total: float
    """Sum of both.

    Unit: length unit.
    """


class Quantile(Fields):
    """Quantile of a sample."""

    probability: float
    """Probability: the share of the values at or below the quantile."""

    value: float
    """Value, in the length unit."""

    standard_error: float
    """Standard error of the value, in the length unit."""


class ReadingErrors(Fields):
    """Figures of reading minus prediction; of the norm where an instrument reads three coordinates. They are in the
    `unit` of the instrument.
    """

    mean: float
    """The mean.

    Unit: `unit` of the instrument.
    """

    standard_error: float | None
    """Cluster-robust standard error of the mean; none for a single configuration.

    Unit: `unit` of the instrument.
    """

    rms: float
    """The root mean square.

    Unit: `unit` of the instrument.
    """

    max: float
    """The largest absolute value.

    Unit: `unit` of the instrument.
    """


class Redundant(Fields):
    """Unknown that others stand for, and the combination that it is equivalent to."""

    name: str
    """Name of the unknown."""

    acts_as: list[list[str | float]]
    """Names and factors of the equivalent combination of parameters; empty if the unknown has no effect."""


class Remainder(Fields):
    """First-order error: distance of the tool point between the exact chain `A_1 E_1 … A_n E_n T` and `ΔX = J_e ε` of
    the repeatable sources.
    """

    certified: float | None
    """Certified upper bound over the box, in the length unit; None if nothing could be proved."""

    boxes: int
    """Number of evaluated boxes."""


class RemainingErrors(Fields):
    """Errors that remain after compensation: the largest norms over the evaluated configurations, in the length unit."""

    residual: float
    """Norm of the sum of the repeatable errors that are not compensated, + the root sum of squares of the residuals
    of the others.

    Unit: length unit.
    """

    total: float
    """Residual + norm of the random bounds.

    Unit: length unit.
    """


class Repeated(Fields):
    """Characteristics of configurations with more than one visit."""

    configurations: int
    """Number of configurations."""

    visits: int
    """Number of visits."""

    fewest: int
    """Smallest number of visits of a configuration; the standard requires 30."""

    ap: MeanAndMax | None
    """Pose accuracy AP_p, 7.2.1; none without repeated visits."""

    ap_turns: list[MeanAndMax] | None
    """Absolute values of AP_a, AP_b, AP_c, 7.2.1, in rad; none without measured orientations."""

    rp: MeanAndMax | None
    """Pose repeatability RP_l, 7.2.2."""

    rp_turns: list[MeanAndMax] | None
    """RP_a, RP_b, RP_c, 7.2.2, in rad."""

    three_sigma: list[float] | None
    """Three standard deviations about the barycentres, along x, y, z, in the length unit."""

    directions: Directions | None
    """Multi-directional pose accuracy variation, 7.2.3; none without several directions of approach."""

    distances: Distances | None
    """Distance accuracy and repeatability, 7.3."""

    drift: Drift | None
    """Drift of pose characteristics, 7.6."""


class ResidualDrift(Fields):
    """Autocorrelation and drift of the residuals over time."""

    lag_1: float
    """Autocorrelation of the residuals of consecutive rows."""

    p_of_lag_1: float
    """Two-sided p-value of the autocorrelation, from random orders."""

    follows: str
    """Component that correlates most with time: the error along `x`, `y` or `z`, or the `distance` between model and
    measurement.
    """

    settling: float | None
    """Time constant of the best exponential, as a share of the duration; none for a straight line."""

    change: float
    """Fitted change of the residuals from the first interval to the last, in the length unit: what the regressions on
    the joints do not explain.
    """

    p: float
    """p-value of the correlation, from random orders."""

    ends: list[float]
    """Mean distances of the first and of the last tenth of the rows, in the length unit."""

    is_drift: bool
    """Is true if `p` is at most the false-alarm rate."""

    false_alarms: float
    """False-alarm rate of the test."""


class ResidualTest(Fields):
    """Test of the errors minus the repeatable sources against the uncertainty of the instrument: the χ² test by which
    `identify` assesses its own residuals.
    """

    factor: float
    """Factor of the stated uncertainty that explains the residuals."""

    freedom: float
    """Degrees of freedom, counted as in an identification."""

    p: float
    """Probability of a factor at least as far from 1 by chance."""


class RootMeanSquares(Fields):
    """Root mean squares of three norms over the configurations, in the length unit."""

    repeatable: float
    """Sum of the repeatable sources.

    Unit: length unit.
    """

    random: float
    """Root sum of squares of the random sources at their bounds.

    Unit: length unit.
    """

    both: float
    """Sum of both norms.

    Unit: length unit.
    """


class RotaryAxis(Fields):
    """Mean displacement of a rotary axis of the workpiece from its nominal pose."""

    variable: str
    """Name of its variable."""

    position: list[float]
    """Displacement of its origin along X, Y and Z of its base, in the unit of length of the spec."""

    angles: list[float]
    """Rotation about X, Y and Z of its base, in rad; the part about the axis itself is an error of its zero."""


class SetSize(Fields):
    """Number of rows of a set."""

    name: str
    """Name of the set."""

    rows: int
    """Number of rows."""


class SimulateReport(Report):
    """Simulated measurements."""

    __slots__ = ()


class Size(Fields):
    """One component of ΔX over all rows. Values are in `unit`."""

    name: str
    """`x`, `norm`, `about x`."""

    unit: str
    """The length unit, or rad."""

    mean: float
    """The mean.

    Unit: `unit`.
    """

    rms: float
    """The root mean square.

    Unit: `unit`.
    """

    max: float
    """The largest absolute value.

    Unit: `unit`.
    """

    three_sigma: float
    """Three standard deviations about the mean.

    Unit: `unit`.
    """


class Sizes(Fields):
    """Statistics of the norms of position errors, in the length unit."""

    mean: float
    """Mean norm.

    Unit: length unit.
    """

    standard_error: float | None
    """Standard error of the mean, by the number of configurations; None if there is only one.

    Unit: length unit.
    """

    rms: float
    """Root mean square.

    Unit: length unit.
    """

    max: float
    """Largest norm.

    Unit: length unit.
    """

    p95: float
    """95th percentile.

    Unit: length unit.
    """


class Source(Fields):
    """Error source.

    `["class"]`: Class of the source: `repeatable`, or `tolerance` or `random` with its distribution.
    """

    name: str
    """Name of the source."""

    at: str
    """Element of the chain that the source acts on."""

    effects: int
    """Number of generalized errors that the source causes."""

    enabled: bool
    """Indicates that the source is switched on."""


class SourceReport(Fields):
    """Position errors of one source alone over the workspace: along x, y, z of `F_0` and their norm, in the length
    unit. Random sources count at their bounds.

    `["class"]`: Class of the source: `repeatable`, `tolerance` or `random`.
    """

    name: str
    """Name of the source."""

    at: str
    """Element of the chain that the source acts on."""

    plain_max: Figures
    """Largest absolute error."""

    half_peak_to_peak: Figures
    """Half of the peak-to-peak variation; of the norm, the norm of these halves. For a random source, its largest
    bound.
    """

    relative_to_home: Figures
    """Largest difference from the error at home. For a random source, the largest difference of two draws."""

    worst: Named[float]
    """Configuration with the largest norm: joint variables and varying inputs."""

    distribution: str | None = None
    """Distribution of a random source; None for a repeatable one."""

    worst_parameters: Named[float]
    """Parameters of that configuration that vary over the workspace."""

    orientation: list[float]
    """Largest absolute orientation errors, rows 4–6, in rad."""


class SourceUncertainty(Fields):
    """Contribution of one random source. Arrays hold three rows and the norm. Lengths are in the spec's unit, angles
    in rad.
    """

    source: str
    """Name of the source."""

    distribution: str
    """Distribution of its error."""

    value: float | None
    """Value of the source in coherent units; None if it causes several errors, whose common factor is 1."""

    divisor: float
    """Divisor of the value: `u = value × sensitivity / divisor`."""

    sensitivity: list[float]
    """Sensitivity `|∂ΔX / ∂value|`, in products of the units."""

    standard_uncertainty: list[float]
    """Standard uncertainties u.

    Unit: length unit or rad.
    """

    degrees_of_freedom: float | None
    """Degrees of freedom of the standard uncertainty; infinite if it is exact."""

    share: float
    """Share of the variance of the norm, from 0 to 1."""


class StepResidual(Fields):
    """Error of the repeatable sources after one step of compensation, `q′ = q − J_q⁻¹ J_e ε`: the exact chain at q′
    compared with the ideal chain at q.
    """

    position: float | None
    """Certified upper bound on the distance of the tool point over the box, in the length unit; None if nothing could
    be proved.
    """

    orientation: float | None
    """Certified upper bound on the rotation of the tool over the box, in rad. None if nothing could be proved, or
    with fewer than six joints, which correct the tool point alone.
    """

    boxes: int
    """Number of evaluated boxes."""


class Table(Fields):
    """A table of numbers for a CSV file."""

    heading: list[str]
    """Names of the columns."""

    rows: list[list[float | None]]
    """Rows, in the units of the map; a missing number is an empty cell."""

    labels: list[str] | None = None
    """Texts of a first column, such as the station of each row; empty if there is none."""


class TermGain(Fields):
    """Accepted group of terms."""

    name: str
    """Name of the group."""

    lines: list[str]
    """Terms of the group as lines of a spec with the identified magnitudes, one source effect each."""

    written: bool
    """Is true if a spec can contain these terms."""

    before: float
    """Root mean square residual of a coordinate in cross-validation without the group, in the length unit."""

    after: float
    """Root mean square residual of a coordinate in cross-validation with the group, in the length unit."""

    f: float | None
    """F statistic of the group, with configurations as independent samples."""

    p: float
    """Probability of an F at least as large by chance."""


class TestExtrapolation(Fields):
    """Test rows outside the fitted ranges of joints and inputs."""

    count: int
    """Number of such rows."""

    standard_deviation: ToolPointDeviation | None
    """Standard deviation of the tool point; `null` if the spec cannot be written."""


class ToleranceVerdict(Fields):
    """Verdict on the position or orientation error. Lengths are in the spec's unit, angles in rad.

    One criterion decides: the largest error over all signs, the radius, the probability, or the lower end of the
    confidence interval of the yield. The probability is the smallest over the evaluated configurations: the one
    with the largest radius (norm of the repeatable errors + norm of the random bounds), those that an
    approximation ranks least likely to meet the tolerance, and the one where it has the largest error at 95 %. To
    first order; random sources are distributed. Repeatable sources have their nominal values. On the compensated
    machine they are replaced by residuals with their full norm, of unknown sign or direction; the uncertainty of
    the calibration and of the inputs is a random error.
    """

    verdict: Literal["met", "not-met"]
    """Verdict on the tolerance."""

    tolerance: float
    """Largest permitted norm of the error.

    Unit: length unit or rad.
    """

    radius: float
    """Norm of the repeatable errors, or of what compensation leaves of them, + norm of the random bounds; the largest
    over the configurations.

    Unit: length unit or rad.
    """

    probability: float
    """Probability."""

    error: float
    """Error of the probability: a bound for an integral, the standard error `√(p (1 − p)/N)` for draws."""

    draws: int | None
    """Number of draws. None for an integral."""

    u95: float
    """Norm that contains the error with a probability of 95 %, the largest over the evaluated configurations."""

    worst_case: float
    """Largest error over all signs and the configurations: repeatable errors at their values, all others at their
    bounds, normal ones at 3σ.

    Unit: length unit or rad.
    """

    is_bounded: bool
    """Indicates that no draw exceeds the worst case: no source is normal."""

    at: Named[float]
    """Configuration with the largest worst case or radius, or the smallest probability, whichever is the criterion."""

    configurations: int
    """Number of configurations at which the probability was evaluated."""


class ToolPointDeviation(Fields):
    """Standard deviation of the tool point (√trace of its covariance) caused by the covariance of the identified
    errors and by the random sources, in the length unit.
    """

    within: float
    """Root mean square over configurations within the ranges.

    Unit: length unit.
    """

    extrapolated: float
    """Root mean square over the configurations outside the ranges.

    Unit: length unit.
    """

    extrapolated_max: float
    """Largest value outside the ranges.

    Unit: length unit.
    """


class Tree(Fields):
    """Machine whose frames are not a chain."""

    tool: str
    """Name of the frame that carries the tool."""

    commanded: int
    """Number of commanded variables: the freedoms of the machine."""

    passive: list[Passive]
    """Passive variables, which the loops determine."""

    equations: int
    """Number of equations of all loops; as many as passive variables."""

    loops: list[Loop]
    """Loops."""

    home: Home | None = None
    """Conditioning of the loops at home; absent without loops."""


class UncertaintyBudget(Fields):
    """Uncertainty budget at the configuration with the largest combined standard uncertainty of the norm. Arrays hold
    three rows and the norm; lengths are in the spec's unit, angles in rad.
    """

    at: Named[float]
    """Joint variables and varying inputs of the configuration."""

    at_parameters: Named[float]
    """Parameters of the configuration that vary over the workspace."""

    sources: list[SourceUncertainty]
    """Random sources that contribute, largest share first."""

    bias: list[float]
    """Sum of the repeatable sources, with signs, and its norm.

    Unit: length unit or rad.
    """

    standard_uncertainty: list[float]
    """Combined standard uncertainties u.

    Unit: length unit or rad.
    """

    effective_degrees_of_freedom: list[float | None]
    """Effective degrees of freedom; infinite if all standard uncertainties are exact."""

    coverage_probability: float
    """Coverage probability of U."""

    coverage_factor: list[float]
    """Coverage factors k."""

    expanded_uncertainty: list[float]
    """Expanded uncertainties `U = k u`.

    Unit: length unit or rad.
    """

    coverage: Compliance
    """Probability that the deviation from the bias has a norm within U, with the actual distributions."""


class UndeterminedError(Fields):
    """Error that moves the tool point where the machine is used, but that the rows cannot determine."""

    name: str
    """Name: `e_r3`."""

    moves: float
    """Root mean square displacement of the tool point per `per`, beyond the equivalent kept errors, in the length
    unit.
    """

    per: str
    """Unit of the error: `mrad`, the length unit, or empty for a magnitude."""


class Unidirectional(Fields):
    """Characteristics of one direction."""

    accuracy: Characteristic | None
    """Accuracy `A↑` or `A↓`; none if a position has a single approach."""

    systematic: Characteristic
    """Systematic positioning error `E↑` or `E↓`."""

    repeatability: Characteristic | None
    """Repeatability `R↑` or `R↓`; none if a position has a single approach."""


class UnreachableReason(Fields):
    """Reason why configurations are unreachable, with its count."""

    reason: str
    """Description of the reason."""

    count: int
    """Number of configurations with this reason."""


class Variable(Fields):
    """Joint variable, in the length unit or rad."""

    name: str
    """Name of the variable."""

    kind: str
    """Kind of the joint: `revolute` or `prismatic`."""

    limits: list[float | None]
    """Lower and upper limit; None where there is no limit.

    Unit: length unit or rad.
    """

    home: float
    """Value at home.

    Unit: length unit or rad.
    """


class Verdicts(Fields):
    """Verdicts on the tolerances of a study."""

    verdict: Literal["met", "not-met"]
    """Worst of the verdicts on the machine that counts."""

    machine: Literal["as-built", "compensated"]
    """Machine whose verdict counts: `as-built` or `compensated`."""

    criterion: Literal["worst-case", "rss", "probability", "yield"]
    """Criterion of the verdict: `worst-case`, `rss`, `probability` or `yield`."""

    probability_required: float | None = None
    """Required probability of meeting each tolerance, if that is the criterion or part of it."""

    yield_required: float | None = None
    """Required share of machines, if that is the criterion."""

    unreachable: int | None = None
    """Number of unreachable configurations, if they are more than the study permits: the tolerance is then not met."""

    position: ToleranceVerdict | None = None
    """Verdict on the position error; None without a position tolerance."""

    orientation: ToleranceVerdict | None = None
    """Verdict on the orientation error; None without an orientation tolerance."""

    yield_estimate: Yield | None = None
    """Share of machines that keep all tolerances at all configurations, if that is the criterion."""

    compensated: CompensatedVerdicts | None = None
    """Verdicts on the compensated machine; None if nothing says what compensation leaves."""


class Warning(Fields):
    """A suspicious number in the spec."""

    line: int | None
    """Line of the spec, from 1; None if only its name is known."""

    message: str
    """Description of the number, with a suggested correction."""


class WeaklyDetermined(Fields):
    """Error whose standard deviation from the data alone exceeds half of the prior's."""

    name: str
    """Name of the error."""

    standard_deviation: float
    """Standard deviation from the data alone, beside all kept unknowns, in `unit`."""

    expected: float
    """Standard deviation of the prior about zero, in `unit`."""

    unit: str
    """Unit: the length unit, rad, or empty."""


class Written(Fields):
    """Number that is written in place of a kept unknown."""

    name: str
    """Name: `zero of q2`, `a of shoulder`, `e_x1`; `inner + outer` for magnitudes that act alike."""

    value: float
    """Identified value, in `unit`."""

    standard_deviation: float
    """Standard deviation of the value, in `unit`."""

    unit: str
    """Unit: the length unit, rad, or empty."""


class Yield(Fields):
    """Share of the machines that keep their tolerances."""

    machines: int
    """Number of machines drawn."""

    configurations: int
    """Number of configurations at which they must keep the tolerances."""

    share: float
    """Share of them that keep all tolerances at all configurations."""

    interval: list[float]
    """Confidence interval of 95 % for the share of all machines."""
