//! Strips of vertices: the adaptive triangulation of thesis 3.1.2 and 3.1.3, without surface or view.

use crate::coarse::Lattice;
use crate::strip::{triangles, zip};
use std::collections::{BTreeMap, BTreeSet};

/// Inserted vertices of a coarse triangle in rows from the apex (weight of V1 greatest) to the base, each from left to
/// right.
pub(crate) type Rows = Vec<Vec<Lattice>>;

/// Vertices in rows. Empty rows do not appear.
pub(crate) fn rows(vertices: impl IntoIterator<Item = Lattice>) -> Rows {
    let mut rows: BTreeMap<u32, BTreeSet<(u32, Lattice)>> = BTreeMap::new();
    for w in vertices {
        rows.entry(w[1] + w[2]).or_default().insert((w[2], w));
    }
    rows.into_values()
        .map(|row| row.into_iter().map(|(_, w)| w).collect())
        .collect()
}

/// The triangulation of a coarse triangle with its corners and the inserted vertices.
///
/// Rows are linked two by two. A row without a *limit vertex* on the left (right) edge keeps using that of the rows
/// above, which is linked to nothing but the next limit vertex and the *extreme* vertex of the row above. If the row
/// would then cut off the extreme vertex of the row above, a vertex is incorporated below it, on its diagonal parallel
/// to the edge. So every triangle has a positive area, and together they cover the coarse triangle.
pub(crate) fn triangulate(mut rows: Rows) -> Vec<[Lattice; 3]> {
    let mut result = Vec::new();
    let Some(apex) = rows.first().and_then(|row| row.first()).copied() else {
        return result;
    };
    let (mut left, mut right) = (apex, apex);
    for i in 1..rows.len() {
        let (above, below) = rows.split_at_mut(i);
        let (parents, row) = (&above[i - 1], &mut below[0]);
        let (Some(first), Some(last)) = (parents.first().copied(), parents.last().copied()) else {
            continue;
        };
        incorporate(first, last, row);
        let (opening, closing) = (row[0], row[row.len() - 1]);
        if first[2] != 0 {
            result.push([left, opening, first]);
        }
        let x = |row: &[Lattice]| {
            row.iter()
                .map(|w| f64::from(w[2]) - f64::from(w[1]))
                .collect::<Vec<_>>()
        };
        result.extend(triangles(parents, row, &zip(&x(parents), &x(row))));
        if last[1] != 0 {
            result.push([right, last, closing]);
        }
        if opening[2] == 0 {
            left = opening;
        }
        if closing[1] == 0 {
            right = closing;
        }
    }
    result
}

/// Incorporation of extreme vertices. `first` and `last` are those of the row above.
fn incorporate(first: Lattice, last: Lattice, row: &mut Vec<Lattice>) {
    let (opening, closing) = (row[0], row[row.len() - 1]);
    let apex = opening[0];
    let distance = opening[1] + opening[2];
    if opening[2] > first[2] && first[2] != 0 {
        row.insert(0, [apex, distance - first[2], first[2]]);
    }
    if closing[1] > last[1] && last[1] != 0 {
        row.push([apex, last[1], distance - last[1]]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The vertices of figure 3.2, numbered from 1 row by row, with four segments an edge.
    fn numbered(number: u32) -> Lattice {
        let (mut row, mut first) = (0, 1);
        while first + row < number {
            first += row + 1;
            row += 1;
        }
        [4 - row, row - (number - first), number - first]
    }

    fn numbers(triangles: &[[Lattice; 3]]) -> Vec<[u32; 3]> {
        let number = |w: Lattice| (1..=15).find(|&n| numbered(n) == w).unwrap_or(0);
        triangles.iter().map(|corners| corners.map(number)).collect()
    }

    /// Twice the area in units of the pattern.
    fn area([a, b, c]: [Lattice; 3]) -> i64 {
        let minus = |p: Lattice, q: Lattice, k: usize| i64::from(p[k]) - i64::from(q[k]);
        minus(b, a, 1) * minus(c, a, 2) - minus(b, a, 2) * minus(c, a, 1)
    }

    #[test]
    fn figure_3_6_has_the_triangles_of_the_thesis() {
        let found = triangulate(rows([1, 5, 6, 7, 9, 10, 11, 15].map(numbered)));
        let expected = [
            [1, 5, 6],
            [1, 7, 5],
            [5, 7, 9],
            [5, 9, 6],
            [6, 9, 10],
            [7, 11, 9],
            [9, 11, 15],
            [9, 15, 10],
        ];
        assert_eq!(numbers(&found), expected);
    }

    #[test]
    fn figure_3_5_incorporates_vertex_8() {
        let found = triangulate(rows([1, 3, 5, 6, 9, 11, 12, 13, 14, 15].map(numbered)));
        let used: BTreeSet<u32> = numbers(&found).into_iter().flatten().collect();
        assert_eq!(
            used.into_iter().collect::<Vec<_>>(),
            [1, 3, 5, 6, 8, 9, 11, 12, 13, 14, 15]
        );
        assert_eq!(found.iter().map(|&corners| area(corners)).sum::<i64>(), 16);
    }

    #[test]
    fn mixed_resolutions_cover_the_triangle_without_overlap() {
        // Vertices anywhere in the unified pattern of L_max = 3, from few to many.
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as u32
        };
        for round in 0..3000 {
            let mut vertices = vec![[12, 0, 0], [0, 12, 0], [0, 0, 12]];
            for _ in 0..round % 40 {
                let w0 = random() % 13;
                let w1 = random() % (13 - w0);
                vertices.push([w0, w1, 12 - w0 - w1]);
            }
            let found = triangulate(rows(vertices.iter().copied()));
            assert!(found.iter().all(|&corners| area(corners) > 0), "{vertices:?}");
            assert_eq!(
                found.iter().map(|&corners| area(corners)).sum::<i64>(),
                144,
                "{vertices:?}"
            );
        }
    }

    #[test]
    fn every_choice_of_vertices_covers_the_triangle_without_overlap() {
        // Four segments an edge: 12 candidates between the corners 1, 11 and 15, hence 4096 choices.
        let candidates: Vec<u32> = (2..15).filter(|&n| n != 11).collect();
        for choice in 0..1u32 << candidates.len() {
            let chosen = candidates
                .iter()
                .enumerate()
                .filter(|(bit, _)| choice >> bit & 1 == 1)
                .map(|(_, n)| *n);
            let vertices: Vec<Lattice> = chosen.clone().chain([1, 11, 15]).map(numbered).collect();
            let found = triangulate(rows(vertices.iter().copied()));
            let areas: Vec<i64> = found.iter().map(|&corners| area(corners)).collect();
            assert!(areas.iter().all(|&area| area > 0), "{:?}", numbers(&found));
            assert_eq!(areas.iter().sum::<i64>(), 16, "{:?}", numbers(&found));
            let used: BTreeSet<Lattice> = found.iter().flatten().copied().collect();
            assert!(vertices.iter().all(|w| used.contains(w)));
            // Nothing is incorporated on an edge, where the neighbour would not know of it.
            let on_edge = |w: &&Lattice| w.contains(&0);
            assert!(used.iter().filter(on_edge).all(|w| vertices.contains(w)));
        }
    }
}
