const { variables, parameters, inputs } = description;
const either = (list, name) => list ?? variables.map((one) => (last === undefined ? Infinity : one[name]));
[change, largest] = [either(change, 'change'), either(largest, 'largest')];
last ??= variables.map(() => 0);
[['q', q, variables], ['s', s, parameters], ['u', u, inputs], ['last', last, variables]].forEach(
    ([name, numbers, list]) => given(name, numbers, list.length),
);
given('rotations', rotations, 3);
[['change', change], ['largest', largest]].forEach((one) => given(...one, variables.length, true));
inputs.forEach(({ name, range: [lower, upper] }, k) => {
    if (u[k] < lower || u[k] > upper) throw new RangeError(`input ${name} is outside its range, ${lower} to ${upper}`);
});
