function y = only_real(y)
    % Replaces a complex number by NaN.
    if ~isreal(y)
        y = NaN;
    end
end

function is_given(name, value, count)
    % Raises an error if an argument has the wrong number of elements.
    if numel(value) ~= count
        error('abbe:size', '%s: expected %d numbers, found %d', name, count, numel(value));
    end
end
