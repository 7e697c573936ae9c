//! Corrected commands in Matlab, by the fixed number of steps of `abbe::compensator`.

use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;

use super::functions::{checks, documentation};
use super::operators::number;
use crate::print::compensated::{Tolerances, numbered, statuses};
use crate::print::layout::Writer;
use crate::program::Routines;

/// Names of the functions in the template.
pub(super) const FUNCTIONS: [&str; 7] =
    ["compensated", "deviation", "weighed", "clamped", "solve", "shortest", "depart"];

pub(super) fn compensated(writer: &mut Writer, class: &str, spec: &Spec, routines: &Routines) {
    if !routines.has_compensated() {
        return;
    }
    let description = &routines.description;
    let [function, helpers] = [COMPENSATE, HELPERS]
        .map(|text| numbered(text, spec, &Tolerances::DOUBLE, number).replace("CLASS", class));
    writer.blank();
    writer.begin(
        "function [corrected, correction, before, after, status] = compensated(q, s, u, last, change, largest, rotations)",
    );
    let statuses = statuses(&Tolerances::DOUBLE);
    documentation(writer, description, &COMPENSATED, Some(["status", &statuses]));
    writer.documentation_line("");
    writer.documentation(WITHOUT_LAST);
    writer.lines(&numbered(DEFAULTS, spec, &Tolerances::DOUBLE, number).replace("CLASS", class));
    checks(writer, class, COMPENSATED.arguments.iter().map(|array| (array.name, array.len(description))));
    writer.lines(function.trim_end());
    writer.close("end");
    writer.blank();
    writer.paragraphs(&helpers);
}

/// Arguments that may be left out.
const WITHOUT_LAST: &str = "Without last, no cycle precedes: corrections have any size. With it, change and largest are those \
     of the class if they are left out, and rotations is the whole pose. Raises an error if an argument has another number \
     of elements, a number is not finite or an input is outside its range.";

const DEFAULTS: &str = "\
if nargin < 4
    [last, change, largest] = deal(zeros(1, COUNT), Inf(1, COUNT), Inf(1, COUNT));
end
if nargin == 4
    change = CLASS.change;
end
if nargin == 4 || nargin == 5
    largest = CLASS.largest;
end
if nargin < 7
    rotations = [1 1 1];
end";

const COMPENSATE: &str = "\
if ~all(isfinite([q(:); s(:); u(:); last(:); rotations(:)]))
    error('abbe:finite', 'an argument is not finite');
end
[limits, command, last] = deal(CLASS.limits', q(:)', last(:)');
start = CLASS.clamped(command, limits(1, :), limits(2, :));
[change, largest] = deal(max(change(:)', 0), max(largest(:)', 0));
lower = CLASS.clamped(start + CLASS.clamped(-largest, last - change, last + change), limits(1, :), limits(2, :));
upper = CLASS.clamped(start + CLASS.clamped(largest, last - change, last + change), limits(1, :), limits(2, :));
target = CLASS.pose(q, s);
axes = target(:, 1:3) .* repmat(rotations(:)', 3, 1);
[real_pose, columns] = CLASS.compensator_step(q, s, u);
before = CLASS.deviation(target, real_pose);
at = CLASS.clamped(start + last, lower, upper);
[real_pose, columns] = CLASS.compensator_step(at, s, u);
now = CLASS.deviation(target, real_pose);
if ~all(isfinite([before, now]))
    error('abbe:finite', 'a result is not finite');
end
[corrected, after] = deal(at, now);
least = sum(CLASS.weighed(axes, now') .^ 2);
cost = sum(CLASS.weighed(axes, before') .^ 2);
if all(command >= lower & command <= upper) && cost < least
    [least, corrected, after] = deal(cost, command, before);
end
for iteration = 1:ITERATIONS
    from = at;
    at = CLASS.depart(axes, start, lower, upper, from, columns, now);
    moved = max(abs(at - from) ./ [UNIT_LIST]);
    [real_pose, columns] = CLASS.compensator_step(at, s, u);
    now = CLASS.deviation(target, real_pose);
    cost = sum(CLASS.weighed(axes, now') .^ 2);
    if cost < least
        [least, corrected, after] = deal(cost, at, now);
    end
end
correction = corrected - start;
left = CLASS.weighed(axes, after');
if any(start ~= command)
    status = 6;
elseif sqrt(sum(left(1:3) .^ 2)) <= REACHED_POSITION && sqrt(sum(left(4:6) .^ 2)) <= REACHED_ROTATION
    status = 0;
elseif any(corrected <= lower | corrected >= upper)
    status = 5;
elseif moved > REST
    status = 4;
else
    status = 7;
end
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

function rows = weighed(axes, rows)
    % Weights the position in metres, and the rotations about the weighted axes of the tool in rad, by columns: 1 rad counts
    % as 1 mm, so that the position has priority.
    rows = [METRE * rows(1:3, :); LEVER * (axes' * rows(4:6, :))];
end

function value = clamped(value, lower, upper)
    % Returns the nearest value of an interval, and its lower end for NaN.
    value = min(max(value, lower), upper);
end

function x = solve(m, b)
    % Iterated Tikhonov regularization by Cholesky factorization of M + lambda, for positive semidefinite M: the first pass
    % solves (M + lambda) x = b, each other one adds lambda (M + lambda)^-1 of the one before.
    count = numel(b);
    x = zeros(count, 1);
    for i = 1:count
        for j = 1:i
            rest = m(i, j) - m(i, 1:j - 1) * m(j, 1:j - 1)';
            if i == j
                m(i, j) = sqrt(max(rest, 0) + DAMPING);
            else
                m(i, j) = rest / m(j, j);
            end
        end
    end
    for pass = 1:PASSES
        for i = 1:count
            b(i) = (b(i) - m(i, 1:i - 1) * b(1:i - 1, 1)) / m(i, i);
        end
        for i = count:-1:1
            b(i) = (b(i) - m(i + 1:count, i)' * b(i + 1:count, 1)) / m(i, i);
        end
        x = x + b;
        b = b * DAMPING;
    end
end

function step = shortest(columns, b)
    % Returns the shortest step: x of (J'J) x = J'b, and for six joints or more J'x of (JJ') x = b.
    if size(columns, 2) < 6
        step = CLASS.solve(columns' * columns, columns' * b)';
    else
        step = (columns' * CLASS.solve(columns * columns', b))';
    end
end

function q = depart(axes, start, lower, upper, q, twists, after)
    % Returns start + step, with variables that exceed a bound held at it, the one with the largest excess first.
    units = [UNIT_LIST];
    columns = CLASS.weighed(axes, twists .* repmat(units, 6, 1));
    wanted = columns * ((q - start) ./ units)' - CLASS.weighed(axes, after');
    for round = 0:COUNT
        step = CLASS.shortest(columns, wanted);
        % Skip variables that are held or do not move the tool.
        moves = any(columns ~= 0, 1);
        q(moves) = start(moves) + step(moves) .* units(moves);
        within = CLASS.clamped(q, lower, upper);
        beyond = abs(q - within) ./ units;
        beyond(~moves) = 0;
        [furthest, held] = max(beyond);
        if ~(furthest > 0)
            break
        end
        q(held) = within(held);
        wanted = wanted + columns(:, held) * ((start(held) - q(held)) / units(held));
        columns(:, held) = 0;
    end
    q = CLASS.clamped(q, lower, upper);
end
";
