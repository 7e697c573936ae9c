const { variables } = description;
const either = (list, name) => list ?? variables.map((one) => (last === undefined ? Infinity : one[name]));
[change, largest] = [either(change, 'change'), either(largest, 'largest')];
last ??= variables.map(() => 0);
given('last', last, variables.length);
[['change', change], ['largest', largest]].forEach((one) => given(...one, variables.length, true));
