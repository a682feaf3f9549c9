import node::specialization::{GROUP, SumsStorage};

// What the columns of a tile are written to: one layer.

@group(GROUP) @binding(1) var target_map: SumsStorage;
