% octave run.m CLASS FUNCTIONS INPUT OUTPUT: calls functions of a generated class.
%
% FUNCTIONS has JSON: a name, the names of the arguments and those of the results each. INPUT holds doubles, q, s, u, errors,
% variances and magnitudes of one configuration after the other; OUTPUT gets what every function returns, in the order of the
% names.
given = argv();
[folder, class] = fileparts(given{1});
addpath(folder);
functions = jsondecode(fileread(given{2}));
constant = @(name) eval([class '.' name]);
variables = numel(constant('variables'));
parameters = numel(constant('parameters'));
inputs = numel(constant('inputs'));
file = fopen(given{3});
numbers = fread(file, Inf, 'double');
fclose(file);
file = fopen(given{4}, 'w');
sizes = struct('q', variables, 's', parameters, 'u', inputs);
called = cellfun(@(one) eval(['@(varargin) ' class '.' one{1} '(varargin{:})']), functions, 'UniformOutput', false);
frames = size(called{1}(numbers(1:variables), numbers(variables + (1:parameters))), 3) - 1;
[sizes.errors, sizes.variances] = deal(6 * frames);
% Of sources there are as many as their displacements have columns.
displacements = eval([class '.source_displacements(numbers(1:variables), numbers(variables + (1:parameters)), ' ...
    'numbers(variables + parameters + (1:inputs)))']);
sizes.magnitudes = size(displacements, 2);
names = fieldnames(sizes);
at = 0;
while at < numel(numbers)
    values = struct();
    for k = 1:numel(names)
        count = sizes.(names{k});
        values.(names{k}) = numbers(at + (1:count));
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
