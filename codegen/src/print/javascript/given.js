/**
 * Checks the length of an argument, and that its numbers are finite.
 * @param {string} name @param {ArrayLike<number>} numbers @param {number} count @param {boolean} [mayBeInfinite]
 */
function given(name, numbers, count, mayBeInfinite) {
    if (numbers?.length !== count) throw new RangeError(`${name}: expected ${count} numbers, found ${numbers?.length}`);
    for (let k = 0; k < count && !mayBeInfinite; k++) {
        if (!Number.isFinite(numbers[k])) throw new RangeError(`${name}: a number is not finite`);
    }
}

/** Checks inputs and their ranges. @param {ArrayLike<number>} u */
function are_inputs(u) {
    given('u', u, description.inputs.length);
    description.inputs.forEach(({ name, range: [lower, upper] }, k) => {
        if (u[k] < lower || u[k] > upper) throw new RangeError(`input ${name} is outside its range, ${lower} to ${upper}`);
    });
}
