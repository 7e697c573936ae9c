/** Checks the length of an argument, and that its numbers are finite. */
function given(name, numbers, count, mayBeInfinite) {
    if (numbers.length !== count) throw new RangeError(`${name}: expected ${count} numbers, found ${numbers.length}`);
    if (!mayBeInfinite && !numbers.every(Number.isFinite)) throw new RangeError(`${name}: a number is not finite`);
}
