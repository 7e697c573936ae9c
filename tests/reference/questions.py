"""What the command is asked, and what this folder answers."""

import math

import monte_carlo
from identifiable import ranks
from kinematics import Configuration
from uncertainty import DEVIATION, norm, probability_within

DRAWS = 20_000


def jacobian(comparison, place, file, spec, configuration, changes):
    """`abbe jacobian` at a configuration with other values of parameters and inputs."""
    values = ",".join(repr(configuration[variable["name"]]) for variable in spec.variables)
    sets = [f"--set={name}={value!r}{' kg' if name == 'payload' else ''}" for name, value in changes.items()]
    report = comparison.abbe("jacobian", file, f"--q={values}", *sets)
    configuration = Configuration(spec, spec.names(configuration, **changes))
    columns = configuration.error_jacobian()
    size = max(abs(x) for column in columns for x in column)
    comparison.numbers(f"{place}.pose", configuration.pose(), report["pose"][:3], size)
    rows = [list(row) for row in zip(*columns)]
    comparison.numbers(f"{place}.error_jacobian", rows, report["error_jacobian"], size)
    repeatable = [source for source in spec.sources if source.enabled and source.repeatable]
    errors = configuration.equivalent_errors(repeatable)
    comparison.numbers(f"{place}.generalized_errors", errors, report["generalized_errors"], max(map(abs, errors)))


def check(comparison, place, file, spec, configurations):
    """`abbe check`: what the file says, and what can be identified."""
    report = comparison.abbe("check", file)
    for ours, theirs in zip(spec.variables, report["variables"], strict=True):
        comparison.numbers(f"{place}.limits", ours["limits"], theirs["limits"], 1.0)
        comparison.numbers(f"{place}.home", ours["home"], theirs["home"], 1.0)
    for name, value in {**spec.parameters, **spec.inputs}.items():
        theirs = next(x for x in report["parameters"] + report["inputs"] if x["name"] == name)
        comparison.numbers(f"{place}.{name}", value, theirs["nominal"])
        if name in spec.ranges:
            comparison.numbers(f"{place}.{name}.range", spec.ranges[name], theirs["range"], 1.0)
    names = [spec.names(configuration) for configuration in configurations]
    for base in (False, True):
        for measured, ours in zip(("pose", "point"), ranks(spec, names, base)):
            [theirs] = [x for x in report["identifiable"] if (x["measurement"], x["base"]) == (measured, base)]
            comparison.numbers(f"{place}.identifiable {measured} {base}", ours, theirs["rank"])


def budget(comparison, place, sweep, report):
    """`abbe analyze`: every source alone and all together."""
    comparison.numbers(f"{place}.configurations", len(sweep.places), report["configurations"])
    combined = sweep.combined()
    alone(comparison, place, sweep, 0, report["sources"], combined["radius"])
    comparison.numbers(f"{place}.combined", combined, report["combined"], combined["radius"])
    exact = report["first_order"]["largest_difference"]
    comparison.numbers(f"{place}.first_order", sweep.largest_remainder(), exact, combined["radius"])
    turned = sweep.combined(3)
    alone(comparison, f"{place}.orientation", sweep, 3, report["orientation"]["sources"], turned["radius"])
    del turned["rms"], turned["worst_case"]
    comparison.numbers(f"{place}.orientation", turned, report["orientation"], turned["radius"])


def alone(comparison, place, sweep, first, theirs, radius):
    theirs = {source["name"]: source for source in theirs}
    if set(theirs) != {source.name for source in sweep.sources}:
        comparison.failures.append(f"{place}: sources {sorted(theirs)}")
        return
    for k, source in enumerate(sweep.sources):
        ours = sweep.alone(k, first)
        # What is zero but for rounding is so beside all the others.
        size = max(ours["plain_max"]["norm"], 1e-6 * radius)
        comparison.numbers(f"{place}.{source.name}", ours, theirs[source.name], size)


def covered(comparison, place, sweep, report):
    """What figures cover: the budget of the GUM and the verdict, of the position and of the orientation."""
    asked = report["verdict"].get("probability_required")
    for name, first, there in (("position", 0, report), ("orientation", 3, report["orientation"])):
        budgets = [sweep.uncertainty(moves, first) for moves in sweep.moves]
        largest = max(math.sqrt(budget.total) for budget in budgets)
        if largest > 0:
            gum(comparison, f"{place}.{name}.uncertainty", sweep, first, there["uncertainty"], largest)
        verdict(comparison, f"{place}.{name}.verdict", sweep, first, budgets, report["verdict"][name], asked)


def gum(comparison, place, sweep, first, theirs, largest):
    """Where the combined standard uncertainty of the norm is largest."""
    configuration = Configuration(sweep.spec, {**sweep.home_names, **theirs["at"]})
    ours = sweep.uncertainty(sweep.moves_at(configuration), first)
    combined, expanded = ours.combined(), ours.expanded()
    comparison.numbers(f"{place}, where it is largest", largest, theirs["standard_uncertainty"][3])
    comparison.numbers(f"{place}.combined", combined, theirs["standard_uncertainty"], combined[3])
    freedoms = [None if freedom == math.inf else freedom for freedom in ours.freedom()]
    comparison.optional(f"{place}.freedom", freedoms, theirs["effective_degrees_of_freedom"])
    comparison.numbers(f"{place}.expanded", expanded, theirs["expanded_uncertainty"], expanded[3])
    comparison.numbers(f"{place}.coverage_factor", ours.factors(), theirs["coverage_factor"])
    comparison.numbers(f"{place}.bias", [*ours.bias, norm(ours.bias)], theirs["bias"], combined[3])
    by_name = {source["source"]: source for source in theirs["sources"]}
    for (source, move), standard, share in zip(ours.random, ours.standard, ours.shares()):
        there, entry = f"{place}.{source.name}", by_name.pop(source.name, None)
        if entry is None:
            comparison.failures.append(f"{there} is missing")
            continue
        size = max(norm(standard), 1e-6 * combined[3])
        comparison.numbers(f"{there}.u", [*map(abs, standard), norm(standard)], entry["standard_uncertainty"], size)
        comparison.numbers(f"{there}.share", share, entry["share"], 1.0)
        freedom = None if source.freedom == math.inf else source.freedom
        comparison.optional(f"{there}.freedom", [freedom], [entry["degrees_of_freedom"]])
        comparison.numbers(f"{there}.divisor", 1 / DEVIATION[source.distribution], entry["divisor"])
        value = value_of(comparison, there, source, configuration, entry["value"])
        sensitivity = [abs(x / value) for x in move]
        size = max(norm(sensitivity), 1e-6 * combined[3])
        comparison.numbers(f"{there}.sensitivity", [*sensitivity, norm(sensitivity)], entry["sensitivity"], size)
    if by_name:
        comparison.failures.append(f"{place}: {sorted(by_name)} have no part in it")
    count, coverage = DRAWS // 10, theirs["coverage"]
    share = ours.share_within(expanded[3], [0.0] * 3, count, seed=3)
    comparison.share(f"{place}.coverage", share, count, coverage["probability"], coverage["error"])


def value_of(comparison, place, source, configuration, theirs):
    """The value of a source is that of its only error, and otherwise 1: the magnitude of all of them."""
    if theirs is None:
        return 1.0
    if source.value is not None:
        comparison.numbers(f"{place}.value", source.value, theirs)
        return source.value
    [effect] = source.effects
    number = configuration.effects[id(effect)]
    numbers = number.values() if effect.dh else number[0] if isinstance(number, tuple) else [number]
    [only] = [x for x in numbers if x]
    comparison.numbers(f"{place}.value", abs(only), abs(theirs))
    return only


def verdict(comparison, place, sweep, first, budgets, theirs, asked):
    """Met or not, by the worst case or by the least probability."""
    configuration = Configuration(sweep.spec, {**sweep.home_names, **theirs["at"]})
    row = sweep.moves_at(configuration)
    tolerance, budget = theirs["tolerance"], sweep.uncertainty(row, first)
    worst = max(budget.worst_case() for budget in budgets)
    certain = all(budget.is_bounded() for budget in budgets) and worst <= tolerance
    comparison.numbers(f"{place}.worst_case", worst, theirs["worst_case"])
    probability, count = (1.0, None) if certain else budget.probability(tolerance, DRAWS // 10, seed=4)
    if not certain and asked is not None:
        # As if all were normal, which tells one configuration from another well enough.
        likely = [probability_within(tolerance, other.bias, other.covariance) for other in [budget, *budgets]]
        room = 1e-6 if all(other.is_normal() for other in budgets) else 0.02
        comparison.compared += 1
        if likely[0] > min(likely) + room:
            comparison.failures.append(f"{place}.at: {likely[0]} there, {min(likely)} elsewhere")
    if asked is not None:
        comparison.share(f"{place}.probability", probability, count, theirs["probability"], theirs["error"])
    elif abs(budget.worst_case() / worst - 1) > 1e-9:
        comparison.failures.append(f"{place}.at: {budget.worst_case()} there, {worst} elsewhere")
    expected = "met" if (worst <= tolerance if asked is None else theirs["probability"] >= asked) else "not-met"
    if theirs["verdict"] != expected:
        comparison.failures.append(f"{place}: {theirs['verdict']}, expected {expected}")


def drawn(comparison, place, sweep, report):
    """`abbe analyze --monte-carlo`: two independent samples, three standard errors of their difference apart at most."""
    for where in ("worst", "home"):
        theirs = report["monte_carlo"][where]
        configuration = Configuration(sweep.spec, {**sweep.home_names, **theirs["at"]})
        drawn_there(comparison, f"{place}.monte_carlo.{where}", configuration, sweep.sources, theirs)


def drawn_there(comparison, place, configuration, sources, theirs):
    errors = monte_carlo.draws(configuration, sources, DRAWS // 2, seed=5)
    ours = monte_carlo.summary(errors, [quantile["probability"] for quantile in theirs["quantiles"]])
    size = norm(ours["mean"])
    for i in range(3):
        error = math.hypot(ours["mean_error"][i], math.sqrt(theirs["covariance"][i][i] / DRAWS))
        comparison.drawn(f"{place}.mean[{i}]", ours["mean"][i], theirs["mean"][i], error, size)
        for j in range(3):
            error = math.hypot(ours["covariance_error"][i][j], theirs["covariance_standard_error"][i][j])
            pair = ours["covariance"][i][j], theirs["covariance"][i][j]
            comparison.drawn(f"{place}.covariance[{i}][{j}]", *pair, error, 1e-9 * size**2)
    for (value, error), quantile in zip(ours["quantiles"], theirs["quantiles"]):
        error = math.hypot(error, quantile["standard_error"])
        comparison.drawn(f"{place}.quantile {quantile['probability']}", value, quantile["value"], error, size)
