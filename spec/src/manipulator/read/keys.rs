//! Keys of a spec file.

crate::tables! {
    FILE: ["the file"],
        ["manipulator", "parameters", "inputs", "tables", "frame", "tool", "source", "load", "gravity", "fitted",
            "covariance",
        ];
    MANIPULATOR: ["[manipulator]"],
        ["name", "title", "description", "reference", "length", "orientation", "gravity"];
    PARAMETER: ["[parameters.NAME]"], ["value", "description", "reference"];
    INPUT: ["[inputs.NAME]"], ["value", "range", "description", "reference"];

    LOOKUP: ["[tables.NAME]"], ["file", "x", "y", "interpolation", "outside", "description", "reference"];
    AXIS: ["[tables.NAME.x]", "[tables.NAME.y]"], ["column", "values", "unit"];

    FRAME: ["[[frame]]"], ["name", "variable"];
    DESCRIBED: ["[[frame]]", "[tool]"], ["description", "reference"];
    TRANSFORM: ["[[frame]]", "[tool]"], ["transform", "matrix", "dh", "mdh", "origin", "axis"];
    VARIABLE: ["[frame.variable]"], ["name", "kind", "limits", "home", "description"];
    DENAVIT_HARTENBERG: ["[frame.dh]", "[frame.mdh]"], ["theta", "d", "a", "alpha"];
    ORIGIN: ["[frame.origin]"], ["xyz", "rpy"];

    SOURCE: ["[[source]]"],
        [
            "name", "class", "distribution", "degrees_of_freedom", "enabled", "magnitude", "description", "reference",
            "effect",
        ];
    PLACE: ["[[source]]", "[[source.effect]]"], ["frame", "at"];
    CAUSE: ["[[source]]", "[[source.effect]]"],
        ["e_x", "e_y", "e_z", "e_s", "e_r", "e_p", "beam", "compliance"];
    DEVIATION: ["[[source]]", "[[source.effect]]"], ["joint", "parameter", "error", "dh"];
    NUMBERS: ["[source.dh]", "[source.effect.dh]"], ["theta", "d", "a", "alpha"];
    MAGNITUDE: ["[source.magnitude]"], ["value", "standard_deviation", "degrees_of_freedom"];
    BEAM: ["[source.beam]", "[source.effect.beam]"],
        ["length", "axis", "EI_y", "EI_z", "GJ", "EA", "mass_per_length"];
    COMPLIANCE: ["[source.compliance]", "[source.effect.compliance]"], ["diagonal", "matrix"];
    COVARIANCE: ["[covariance]"], ["of", "rows"];
    COVARIANCE_OF: ["[covariance.of]"], ["source", "error"];
    LOAD: ["[[load]]"],
        ["name", "mass", "force", "moment", "axes", "frame", "point", "description", "reference"];
}
