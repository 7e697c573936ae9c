//! Keys of a plan file, except those of its workspaces.

abbe_spec::tables! {
    FILE: ["the file"], ["plan", "set", "inputs"];
    PLAN: ["[plan]"], ["title", "description", "repeat"];
    SET: ["[[set]]"], ["name", "workspace", "axes"];
}
