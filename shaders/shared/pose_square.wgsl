// Bounds of bicubic patches and of the roots of Catmull-Clark faces, from control points. Twin: keyleaf-surface `subdivision::bound`.
// For shared use by shaders/passes/pose.wgsl, which has `difference` and `Slopes`.

const POSED_ENTRIES: u32 = 16u;

fn along_u(first: u32, i: u32, j: u32) -> vec3f {
    return difference(first, 4u * j + i + 1u) - difference(first, 4u * j + i);
}

fn along_v(first: u32, i: u32, j: u32) -> vec3f {
    return difference(first, 4u * j + i + 4u) - difference(first, 4u * j + i);
}

// By the control points of the derivatives.
fn patch_slopes(first: u32) -> Slopes {
    var slopes = Slopes(vec2f(0.0), vec3f(0.0));
    for (var j = 0u; j < 4u; j++) {
        for (var i = 0u; i < 4u; i++) {
            if i < 3u {
                slopes.first.x = max(slopes.first.x, length(along_u(first, i, j)));
            }
            if j < 3u {
                slopes.first.y = max(slopes.first.y, length(along_v(first, i, j)));
            }
            if i < 2u {
                slopes.second.x = max(slopes.second.x, length(along_u(first, i + 1u, j) - along_u(first, i, j)));
            }
            if i < 3u && j < 3u {
                slopes.second.y = max(slopes.second.y, length(along_u(first, i, j + 1u) - along_u(first, i, j)));
            }
            if j < 2u {
                slopes.second.z = max(slopes.second.z, length(along_v(first, i, j + 1u) - along_v(first, i, j)));
            }
        }
    }
    return Slopes(3.0 * slopes.first, vec3f(6.0, 9.0, 6.0) * slopes.second);
}

fn patch_area(first: u32) -> vec3f {
    let opposite = difference(first, 15u);
    return cross(difference(first, 3u), opposite) + cross(opposite, difference(first, 12u));
}

// Size and deviation. Domains of faces with another number of corners than four are half as long as the face's own parameters.
fn root_bound(slopes: Slopes, root: u32, corners: u32) -> vec2f {
    let length = select(2.0, 1.0, corners == 4u);
    let bend = slopes.second.x + 2.0 * slopes.second.y + slopes.second.z;
    return vec2f(max(slopes.first.x, slopes.first.y) * length / 2.0, bend * length * length / 8.0);
}
