// Clears the table and enters every leaf again: at the start, and when live entries and tombstones together fill too much of it.
// requires: shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl, shared/table_change.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read_write> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read_write> table: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read_write> control: Control;

@compute @workgroup_size(64)
fn clear_table(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let first = ((group.x + group.y * groups.x) * 64u + lane) * 4u;
    for (var i = first; i < first + 4u; i++) {
        if i <= frame.table_mask {
            atomicStore(&table[i], EMPTY);
        }
    }
}

@compute @workgroup_size(64)
fn enter_leaves(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let slot = (group.x + group.y * groups.x) * 64u + lane;
    if slot < control.leaves {
        leaves[slot].entry = insert_leaf(leaf_place(leaves[slot]), slot);
    }
}
