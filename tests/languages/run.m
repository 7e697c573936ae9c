% octave run.m CLASS NAMES INPUT OUTPUT: calls functions of a generated class.
%
% NAMES has JSON: the arrays that are given, and of every function its name, the names of its arguments and those of its
% results. INPUT holds doubles, the arrays of one configuration after the other; OUTPUT gets what every function returns, in the
% order of the names.
given = argv();
[folder, class] = fileparts(given{1});
addpath(folder);
names = jsondecode(fileread(given{2}));
functions = names.functions;
file = fopen(given{3});
numbers = fread(file, Inf, 'double');
fclose(file);
file = fopen(given{4}, 'w');
called = cellfun(@(one) eval(['@(varargin) ' class '.' one{1} '(varargin{:})']), functions, 'UniformOutput', false);
at = 0;
while at < numel(numbers)
    values = struct();
    for k = 1:numel(names.arrays)
        count = prod(names.arrays(k).shape);
        values.(names.arrays(k).name) = numbers(at + (1:count));
        at = at + count;
    end
    for k = 1:numel(functions)
        one = functions{k};
        taken = cellfun(@(name) values.(name), one{2}, 'UniformOutput', false);
        results = cell(1, numel(one{3}));
        [results{:}] = called{k}(taken{:});
        cellfun(@(result) fwrite(file, result(:), 'double'), results);
    end
end
fclose(file);
