//! Corrected commands in Matlab, by the fixed number of steps of `abbe::compensator`.

use abbe_core::function::{COMPENSATED, CONVERGED};
use abbe_spec::Spec;

use super::functions::{checks, documentation};
use super::operators::number;
use crate::print::compensated::{Tolerances, numbered};
use crate::print::layout::Writer;
use crate::program::Routines;

/// Names of the functions in the template.
pub(super) const FUNCTIONS: [&str; 6] =
    ["compensated", "deviation", "weights", "solve", "shortest", "depart"];

pub(super) fn compensated(writer: &mut Writer, class: &str, spec: &Spec, routines: &Routines) {
    if spec.variables.is_empty() {
        return;
    }
    let description = &routines.description;
    let [function, helpers] = [COMPENSATE, HELPERS]
        .map(|text| numbered(text, spec, &Tolerances::DOUBLE, number).replace("CLASS", class));
    writer.blank();
    writer.begin("function [corrected, before, after, converged] = compensated(q, s, u)");
    documentation(writer, description, &COMPENSATED, Some(["converged", CONVERGED]));
    checks(writer, class, COMPENSATED.arguments.iter().map(|array| (array.name, array.len(description))));
    writer.lines(function.trim_end());
    writer.close("end");
    writer.blank();
    writer.paragraphs(&helpers);
}

const COMPENSATE: &str = "\
start = q(:)';
weights = CLASS.weights();
limits = CLASS.limits';
target = CLASS.pose(q, s);
[real_pose, columns] = CLASS.compensator_step(q, s, u);
before = CLASS.deviation(target, real_pose);
[at, corrected, now, after] = deal(start, start, before, before);
least = Inf;
if all(start >= limits(1, :) & start <= limits(2, :))
    least = sum((before .* weights) .^ 2);
end
for iteration = 1:ITERATIONS
    from = at;
    at = CLASS.depart(start, from, columns, now);
    moved = max(abs(at - from) ./ [UNIT_LIST]);
    [real_pose, columns] = CLASS.compensator_step(at, s, u);
    now = CLASS.deviation(target, real_pose);
    cost = sum((now .* weights) .^ 2);
    if cost < least
        [least, corrected, after] = deal(cost, at, now);
    end
end
converged = moved <= REST;
";

const HELPERS: &str = "\
function rows = deviation(ideal, found)
    % Deviation of the real from the ideal pose: position in F_0, and the rotation vector of R_real R_ideal'.
    turn = found(:, 1:3) * ideal(:, 1:3)';
    v = [turn(3, 2) - turn(2, 3), turn(1, 3) - turn(3, 1), turn(2, 1) - turn(1, 2)];
    twice_sine = sqrt(sum(v .^ 2));
    scale = 0.5;
    if ~(twice_sine < LEAST_SINE)
        scale = atan2(twice_sine, turn(1, 1) + turn(2, 2) + turn(3, 3) - 1) / twice_sine;
    end
    rows = [found(:, 4)' - ideal(:, 4)', v * scale];
end

function factors = weights()
    % Weights of the rows in metres and rad: 1 rad counts as 1 mm, so that the position has priority.
    factors = [METRE * [1 1 1], LEVER * [1 1 1]];
end

function x = solve(m, b)
    % Solves (M + lambda) x = b by Cholesky factorization, for positive semidefinite M.
    count = numel(b);
    x = b;
    for i = 1:count
        for j = 1:i
            rest = m(i, j) - m(i, 1:j - 1) * m(j, 1:j - 1)';
            if i == j
                m(i, j) = sqrt(max(rest, 0) + DAMPING);
            else
                m(i, j) = rest / m(j, j);
            end
        end
        x(i) = (x(i) - m(i, 1:i - 1) * x(1:i - 1, 1)) / m(i, i);
    end
    for i = count:-1:1
        x(i) = (x(i) - m(i + 1:count, i)' * x(i + 1:count, 1)) / m(i, i);
    end
end

function step = shortest(columns, b)
    % Returns the shortest step, (J'J + lambda)^-1 J'b; for more than six joints J'(JJ' + lambda)^-1 b.
    if size(columns, 2) <= 6
        step = CLASS.solve(columns' * columns, columns' * b)';
    else
        step = (columns' * CLASS.solve(columns * columns', b))';
    end
end

function q = depart(start, q, twists, after)
    % Returns start + step, with variables that exceed a limit held at it, the one with the largest excess first.
    units = [UNIT_LIST];
    limits = CLASS.limits';
    weights = CLASS.weights()';
    columns = (twists .* repmat(units, 6, 1)) .* repmat(weights, 1, COUNT);
    wanted = columns * ((q - start) ./ units)' - weights .* after';
    for round = 0:COUNT
        step = CLASS.shortest(columns, wanted);
        % Skip variables that are held or do not move the tool.
        moves = any(columns ~= 0, 1);
        q(moves) = start(moves) + step(moves) .* units(moves);
        clamped = min(max(q, limits(1, :)), limits(2, :));
        beyond = abs(q - clamped) ./ units;
        beyond(~moves) = 0;
        [furthest, held] = max(beyond);
        if ~(furthest > 0)
            break
        end
        q(held) = clamped(held);
        wanted = wanted + columns(:, held) * ((start(held) - q(held)) / units(held));
        columns(:, held) = 0;
    end
    q = min(max(q, limits(1, :)), limits(2, :));
end
";
