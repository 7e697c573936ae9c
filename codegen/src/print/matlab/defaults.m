if nargin < 4
    [last, change, largest] = deal(zeros(1, COUNT), Inf(1, COUNT), Inf(1, COUNT));
end
if nargin == 4
    change = CLASS.change;
end
if nargin == 4 || nargin == 5
    largest = CLASS.largest;
end
