//! Triangles between two rows of vertices.

/// Which row a strip goes on along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    Upper,
    Lower,
}

/// The steps of a strip between two parallel rows, given where their vertices are along them.
///
/// The row whose next segment has the smaller middle goes first, the lower one if they are equal. On two rows of the
/// uniform pattern this is the zigzag of thesis 4.2; elsewhere it shares out children among parents as the examples of
/// thesis 3.1.3 do.
pub(crate) fn zip(upper: &[f64], lower: &[f64]) -> Vec<Step> {
    let middle = |row: &[f64], i: usize| row.get(i + 1).map(|next| row[i] + next);
    let (mut u, mut l) = (0, 0);
    let mut steps = Vec::new();
    loop {
        let step = match (middle(upper, u), middle(lower, l)) {
            (None, None) => return steps,
            (Some(_), None) => Step::Upper,
            (None, Some(_)) => Step::Lower,
            (Some(up), Some(low)) => {
                if up < low {
                    Step::Upper
                } else {
                    Step::Lower
                }
            }
        };
        match step {
            Step::Upper => u += 1,
            Step::Lower => l += 1,
        }
        steps.push(step);
    }
}

/// The triangles of a strip, counter-clockwise if rows run to the right and the upper one is above. Steps beyond a row
/// are ignored.
pub(crate) fn triangles<T: Copy>(upper: &[T], lower: &[T], steps: &[Step]) -> Vec<[T; 3]> {
    let (mut u, mut l) = (0, 0);
    let mut triangles = Vec::new();
    for step in steps {
        match step {
            Step::Upper if u + 1 < upper.len() => {
                triangles.push([upper[u], lower[l], upper[u + 1]]);
                u += 1;
            }
            Step::Lower if l + 1 < lower.len() => {
                triangles.push([upper[u], lower[l], lower[l + 1]]);
                l += 1;
            }
            _ => {}
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labelled(upper: &[(u32, f64)], lower: &[(u32, f64)]) -> Vec<[u32; 3]> {
        let split = |row: &[(u32, f64)]| row.iter().copied().unzip::<u32, f64, Vec<_>, Vec<_>>();
        let ((up, up_x), (low, low_x)) = (split(upper), split(lower));
        triangles(&up, &low, &zip(&up_x, &low_x))
    }

    #[test]
    fn children_are_shared_out_as_in_figure_3_6() {
        let five_to_six = labelled(&[(5, 0.0), (6, 1.0)], &[(7, -1.5), (9, 0.5), (10, 1.5)]);
        assert_eq!(five_to_six, [[5, 7, 9], [5, 9, 6], [6, 9, 10]]);
        let last = labelled(&[(7, -1.5), (9, 0.5), (10, 1.5)], &[(11, -2.0), (15, 2.0)]);
        assert_eq!(last, [[7, 11, 9], [9, 11, 15], [9, 15, 10]]);
    }
}
