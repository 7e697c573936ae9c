if ~all(isfinite([q(:); s(:); u(:); last(:); rotations(:)]))
    error('abbe:finite', 'an argument is not finite');
end
[q, last, change, largest] = deal(q(:)', last(:)', change(:)', largest(:)');
