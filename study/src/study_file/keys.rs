//! Keys of a study file, except those of its workspaces.

abbe_spec::tables! {
    FILE: ["the file"], ["study", "workspace", "published", "compensated", "compensation", "figure"];
    STUDY: ["[study]"],
        ["title", "description", "reference", "publisher", "tolerance", "set", "enable", "disable", "not_reproducible"];
    TOLERANCE: ["[study.tolerance]"], ["position", "orientation", "probability"];
    COMPENSATION: ["[compensation]"], ["default"];

    FIGURE: ["[[figure]]"], ["kind", "caption", "paper"];
    GATHERED: ["[[figure]]"], ["source", "workspace"];
    ROWS: ["[[figure]]"], ["rows"];
    OVER: ["[[figure]]"], ["over"];
    UP: ["[[figure]]"], ["up"];

    PUBLISHED: ["[[published]]"], ["norm", "within", "reference"];
    OF_A_SOURCE: ["[[published]]"], ["source", "metric", "x", "y", "z"];
    OF_ALL: ["[[published]]"], ["combined"];
    COMPENSATED: ["[compensated]"], ["residual", "random", "total", "reference"];
}
