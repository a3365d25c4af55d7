//! Triangles that are a line or a point: at poles, where a whole edge of a patch is one point, and where f32 cannot tell neighbours apart.

use glam::DVec3;

/// Removes triangles with equal corners, and makes one vertex of the corners that are equal, so that what was closed stays closed. The
/// normals of those add up. Other vertices at equal places stay apart.
pub(super) fn collapse(positions: &mut Vec<[f32; 3]>, normals: &mut Vec<DVec3>, triangles: &mut Vec<[u32; 3]>) {
    let bits = |vertex: u32| positions[vertex as usize].map(f32::to_bits);
    let mut same: Vec<u32> = (0..positions.len() as u32).collect();
    for &[a, b, c] in triangles.iter() {
        for (v, w) in [(a, b), (b, c), (c, a)] {
            if bits(v) == bits(w) {
                let (v, w) = (find(&mut same, v), find(&mut same, w));
                same[v.max(w) as usize] = v.min(w);
            }
        }
    }
    let first: Vec<u32> = (0..positions.len() as u32).map(|v| find(&mut same, v)).collect();
    if first.iter().zip(0..).all(|(first, v)| *first == v) {
        return;
    }
    let mut numbers = vec![0; positions.len()];
    let mut kept = 0;
    for (v, &first) in first.iter().enumerate() {
        if first as usize == v {
            positions[kept] = positions[v];
            normals[kept] = normals[v];
            numbers[v] = kept as u32;
            kept += 1;
        } else {
            numbers[v] = numbers[first as usize];
            let normal = normals[v];
            normals[numbers[v] as usize] += normal;
        }
    }
    positions.truncate(kept);
    normals.truncate(kept);
    for triangle in triangles.iter_mut() {
        *triangle = triangle.map(|v| numbers[v as usize]);
    }
    triangles.retain(|[a, b, c]| a != b && b != c && c != a);
}

/// The least vertex that is known to be the same.
fn find(same: &mut [u32], mut v: u32) -> u32 {
    while same[v as usize] != v {
        let next = same[same[v as usize] as usize];
        same[v as usize] = next;
        v = next;
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pole_becomes_one_vertex_and_what_only_touches_stays() {
        // Vertices 0, 1, 2 are the pole; 6 lies at the same place but belongs to another surface.
        let pole = [0.0, 1.0, 0.0];
        let mut positions = vec![
            pole,
            pole,
            pole,
            [1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0],
            [-1.0, 0.0, 0.0],
            pole,
            [5.0; 3],
            [6.0, 5.0, 5.0],
        ];
        let mut normals: Vec<DVec3> = (0..9).map(|k| DVec3::X * f64::from(k)).collect();
        let mut triangles = vec![[0, 3, 4], [0, 4, 1], [1, 4, 5], [1, 5, 2], [6, 7, 8]];
        collapse(&mut positions, &mut normals, &mut triangles);
        assert_eq!(triangles, [[0, 1, 2], [0, 2, 3], [4, 5, 6]]);
        assert_eq!(
            (positions.len(), positions[1], positions[4]),
            (7, [1.0, 0.0, 0.0], pole)
        );
        assert_eq!((normals[0], normals[4]), (DVec3::X * 3.0, DVec3::X * 6.0));
    }
}
