//! Rows with virtual vertices and the triangle strips between them (thesis 4.2), without surface or view.

use crate::coarse::Lattice;
use crate::strip::{Step, zip};

/// The candidates on the edges of a coarse triangle of `segments` segments: whether number 1..segments of each is
/// inserted. Entry 0 and the last are the corners and count as inserted.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    pub left: Vec<bool>,
    pub right: Vec<bool>,
    pub base: Vec<bool>,
}

/// A vertex of a row: its own, or a virtual one in place of an end that is missing.
#[derive(Clone, Copy, Debug)]
struct RowVertex {
    w: Lattice,
    is_virtual: bool,
}

/// The triangle strips of a coarse triangle, as lists of vertices in which every three in sequence are a triangle, even
/// ones clockwise, and those with a vertex twice are none.
///
/// A row is there if either of its ends is inserted, and then with all vertices inside. A missing end is replaced by
/// the *virtual vertex*: the nearest inserted one on the same edge, the lower one of two. The row above a gap supplies
/// the vertices of the rows in it. Virtual vertices are used once.
///
/// Departure: a virtual vertex far down or up the edge can lie beyond the row that it is linked to. Where the strip of
/// the thesis would then fold over, it begins with the row above instead of the row below.
pub(crate) fn strips(pattern: &Pattern) -> Vec<Vec<Lattice>> {
    let segments = (pattern.left.len() - 1) as u32;
    let present = |row: u32| pattern.left[row as usize] || pattern.right[row as usize];
    let rows: Vec<u32> = (0..segments).filter(|&row| present(row)).collect();
    let mut strips = Vec::new();
    for (i, &upper) in rows.iter().enumerate() {
        let lower = match rows.get(i + 1) {
            Some(&lower) => row(pattern, segments, lower),
            None => base(pattern, segments),
        };
        strips.push(strip(row(pattern, segments, upper), lower));
    }
    strips
}

/// The triangles of a strip, counter-clockwise.
pub(crate) fn triangles(strip: &[Lattice]) -> Vec<[Lattice; 3]> {
    let turn = |(i, w): (usize, &[Lattice])| {
        if i % 2 == 0 {
            [w[1], w[0], w[2]]
        } else {
            [w[0], w[1], w[2]]
        }
    };
    let whole = |[a, b, c]: &[Lattice; 3]| a != b && b != c && c != a;
    strip.windows(3).enumerate().map(turn).filter(whole).collect()
}

fn row(pattern: &Pattern, segments: u32, row: u32) -> Vec<RowVertex> {
    let mut vertices: Vec<RowVertex> = (0..=row)
        .map(|k| RowVertex {
            w: [segments - row, row - k, k],
            is_virtual: false,
        })
        .collect();
    if !pattern.left[row as usize] {
        let nearest = nearest(&pattern.left, row);
        vertices[0] = RowVertex {
            w: [segments - nearest, nearest, 0],
            is_virtual: true,
        };
    }
    if !pattern.right[row as usize] {
        let nearest = nearest(&pattern.right, row);
        vertices[row as usize] = RowVertex {
            w: [segments - nearest, 0, nearest],
            is_virtual: true,
        };
    }
    vertices
}

/// The base. Its missing vertices are left out: the nearest inserted one in place of each would be there twice.
fn base(pattern: &Pattern, segments: u32) -> Vec<RowVertex> {
    let inserted = (0..=segments).filter(|&k| pattern.base[k as usize]);
    inserted
        .map(|k| RowVertex {
            w: [0, segments - k, k],
            is_virtual: false,
        })
        .collect()
}

fn nearest(edge: &[bool], row: u32) -> u32 {
    let last = edge.len() as u32 - 1;
    let at = |row: u32| edge[row as usize];
    (1..=last)
        .find_map(|away| {
            let below = (row + away <= last && at(row + away)).then_some(row + away);
            below.or_else(|| (away <= row && at(row - away)).then_some(row - away))
        })
        .unwrap_or(0)
}

fn strip(mut upper: Vec<RowVertex>, mut lower: Vec<RowVertex>) -> Vec<Lattice> {
    let opening = end(&mut upper, &mut lower, 2);
    upper.reverse();
    lower.reverse();
    let mut closing = end(&mut upper, &mut lower, 1);
    upper.reverse();
    lower.reverse();
    closing.reverse();

    let used = |steps: &[Step], which: Step| steps.iter().filter(|&&step| step == which).count();
    let middle = |row: &[RowVertex], which: Step| {
        let range = used(&opening, which)..row.len().saturating_sub(used(&closing, which));
        let inner = row.get(range).unwrap_or(&[]);
        inner
            .iter()
            .map(|v| f64::from(v.w[2]) - f64::from(v.w[1]))
            .collect::<Vec<_>>()
    };
    let between = zip(&middle(&upper, Step::Upper), &middle(&lower, Step::Lower));
    let steps = opening.iter().chain(&between).chain(&closing);

    let (mut u, mut l) = (0, 0);
    let mut list = vec![lower[0].w, upper[0].w];
    let mut ends_above = true;
    for &step in steps {
        let above = step == Step::Upper;
        if above == ends_above {
            // Two vertices of one row in sequence: that of the other row is repeated between them.
            list.push(if above { lower[l].w } else { upper[u].w });
        }
        if above {
            u += 1;
            list.push(upper[u].w);
        } else {
            l += 1;
            list.push(lower[l].w);
        }
        ends_above = above;
    }
    list
}

/// The first steps of a strip where a row begins with a virtual vertex. If both rows begin with the same one, it is
/// removed from one of them. `inward` is the weight that counts the distance from the edge.
fn end(upper: &mut Vec<RowVertex>, lower: &mut Vec<RowVertex>, inward: usize) -> Vec<Step> {
    let (above, below) = (upper[0], lower[0]);
    if above.w == below.w {
        if !above.is_virtual {
            lower.remove(0);
            return Vec::new();
        }
        upper.remove(0);
        return if below.is_virtual {
            vec![Step::Lower]
        } else {
            Vec::new()
        };
    }
    if above.is_virtual {
        return if lower[1].w[inward] == upper[1].w[inward] {
            vec![Step::Lower, Step::Upper]
        } else {
            vec![Step::Upper]
        };
    }
    if below.is_virtual {
        vec![Step::Lower]
    } else {
        Vec::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pattern(segments: usize, left: u32, right: u32, base: u32) -> Pattern {
        let flags = |bits: u32| {
            (0..=segments)
                .map(|k| k == 0 || k == segments || bits >> (k - 1) & 1 == 1)
                .collect::<Vec<_>>()
        };
        Pattern {
            left: flags(left),
            right: flags(right),
            base: flags(base),
        }
    }

    /// Vertices numbered from 1 row by row, as in figure 4.3.
    fn numbers(list: &[Lattice], segments: u32) -> Vec<u32> {
        let number = |w: &Lattice| {
            let row = segments - w[0];
            row * (row + 1) / 2 + w[2] + 1
        };
        list.iter().map(number).collect()
    }

    fn lists(pattern: &Pattern) -> Vec<Vec<u32>> {
        strips(pattern).iter().map(|list| numbers(list, 3)).collect()
    }

    #[test]
    fn strips_of_figure_4_3_are_those_of_the_thesis() {
        assert_eq!(
            lists(&pattern(3, 3, 3, 3)),
            [vec![2, 1, 3], vec![4, 2, 5, 3, 6], vec![7, 4, 8, 5, 9, 6, 10]],
            "equation 4.1"
        );
        assert_eq!(
            lists(&pattern(3, 3, 1, 3)),
            [vec![2, 1, 3], vec![4, 2, 5, 3, 10], vec![7, 4, 8, 5, 9, 5, 10]],
            "(a): vertex 6 missing"
        );
        assert_eq!(
            lists(&pattern(3, 1, 1, 3))[1],
            [7, 2, 8, 2, 9, 3, 10],
            "(b): row of 4, 5, 6 missing"
        );
        assert_eq!(
            lists(&pattern(3, 0, 1, 3))[1],
            [7, 1, 8, 3, 9, 3, 10],
            "(c): vertex 2 missing as well"
        );
    }

    fn area([a, b, c]: &[Lattice; 3]) -> i64 {
        let minus = |p: &Lattice, q: &Lattice, k: usize| i64::from(p[k]) - i64::from(q[k]);
        minus(b, a, 1) * minus(c, a, 2) - minus(b, a, 2) * minus(c, a, 1)
    }

    #[test]
    fn the_greatest_resolution_covers_the_triangle_without_overlap() {
        let mut state = 1_u64;
        let mut random = || {
            let mut bits = 0x7fff;
            // Few and many candidates alike.
            for _ in 0..=state % 3 {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                bits &= (state >> 33) as u32;
            }
            bits
        };
        for _ in 0..3000 {
            let pattern = pattern(16, random(), random(), random());
            let found: Vec<_> = strips(&pattern).iter().flat_map(|list| triangles(list)).collect();
            assert!(found.iter().all(|corners| area(corners) > 0), "{pattern:?}");
            assert_eq!(found.iter().map(area).sum::<i64>(), 256, "{pattern:?}");
        }
    }

    #[test]
    fn every_choice_of_edge_vertices_covers_the_triangle_without_overlap() {
        for segments in 1..=6_u32 {
            let choices = 1_u32 << (segments - 1);
            for (left, right) in (0..choices).flat_map(|left| (0..choices).map(move |right| (left, right))) {
                for base in [0, 1, choices / 2, choices - 1, 0b1010 % choices] {
                    let pattern = pattern(segments as usize, left, right, base);
                    let found: Vec<_> = strips(&pattern).iter().flat_map(|list| triangles(list)).collect();
                    assert!(found.iter().all(|corners| area(corners) > 0), "{pattern:?}");
                    assert_eq!(
                        found.iter().map(area).sum::<i64>(),
                        i64::from(segments * segments),
                        "{pattern:?}"
                    );
                    let on_edges = found.iter().flatten().filter(|w| w.contains(&0));
                    assert!(on_edges.into_iter().all(|w| {
                        let [a, b, c] = w.map(|w| w as usize);
                        let (edge, at) = match (a, b, c) {
                            (_, _, 0) => (&pattern.left, b),
                            (_, 0, _) => (&pattern.right, c),
                            _ => (&pattern.base, c),
                        };
                        edge[at]
                    }));
                }
            }
        }
    }
}
