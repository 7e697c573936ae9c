/** Checks the length of an argument, and that its numbers are finite. */
function given(name, numbers, count, mayBeInfinite) {
    if (numbers.length !== count) throw new RangeError(`${name}: expected ${count} numbers, found ${numbers.length}`);
    if (!mayBeInfinite && !numbers.every(Number.isFinite)) throw new RangeError(`${name}: a number is not finite`);
}

/** Checks joints, parameters and inputs. */
function are_given(q, s, u) {
    const { variables, parameters, inputs } = description;
    given('q', q, variables.length);
    given('s', s, parameters.length);
    given('u', u, inputs.length);
    inputs.forEach(({ name, range: [lower, upper] }, k) => {
        if (u[k] < lower || u[k] > upper) throw new RangeError(`input ${name} is outside its range, ${lower} to ${upper}`);
    });
}
