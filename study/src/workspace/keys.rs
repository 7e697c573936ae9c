//! Keys of a workspace.

abbe_spec::tables! {
    WORKSPACE: ["[workspace]"], ["presented", "grid", "joints", "random", "box", "path"];
    BESIDE: ["[workspace]"], ["inputs"];
    PRESENTED: ["[workspace.presented]"], ["point", "tool_points", "approaches", "solve"];
    SAMPLES: ["[workspace.joints]", "[workspace.random]"], ["samples", "moved"];
    RANDOM: ["[workspace.random]"], ["seed"];
    BOX: ["[workspace.box]"], ["x", "y", "z", "orientation", "solve"];
    PATH: ["[workspace.path]"], ["file"];
    VALUES: ["[workspace.grid.NAME]"], ["from", "to", "count", "step"];
}
