if ~all(isfinite([NUMBERS]))
    error('abbe:finite', 'an argument is not finite');
end
[NAMES] = deal(ROWS);
